// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Cholesky>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/parameter_covariance.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/prior_file.h>

#include "calibration_json.h"

namespace pcl_als {
namespace {

constexpr const char* kHistoryFormat = "pcl_als history";
constexpr long kHistoryVersion = 1;

void readHistory(const FieldNode& root, PriorFile& file) {
  const long version = root["version"].whole();
  if (version != kHistoryVersion)
    root["version"].refuse("is " + std::to_string(version) + "; this version of pcl_als reads " +
                           std::to_string(kHistoryVersion));
  file.is_history = true;
  file.earlier = detail::instrumentIn(root["instrument"]);
  if (root.has("change_std")) deviationFields().read(file.change_std, root["change_std"]);
}

}  // namespace

BiasPrior PriorFile::prior() const {
  const std::vector<SystemParameter>& order = earlier.correlation_order;
  Eigen::MatrixXd covariance = estimatedCovariance(earlier, name);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    covariance(row, row) += std::pow(change_std[indexOf(order[i])], 2);
  }
  BiasPrior made = biasPrior(order, earlier.biases(), covariance);
  made.source = name;
  made.attitude = earlier.attitude;
  made.of_other_missions = true;
  return made;
}

CalibrationResult PriorFile::calibration() const {
  CalibrationResult changed = earlier;
  if (!is_history) return changed;
  const std::vector<SystemParameter>& order = changed.correlation_order;
  for (std::size_t i = 0; i < order.size(); ++i) {
    double& std = changed[order[i]].std;
    const double with_change = std::hypot(std, change_std[indexOf(order[i])]);
    if (!(with_change > 0.0)) continue;
    const auto row = static_cast<Eigen::Index>(i);
    changed.correlation.row(row) *= std / with_change;
    changed.correlation.col(row) *= std / with_change;
    changed.correlation(row, row) = 1.0;
    std = with_change;
  }
  return changed;
}

PriorFile readPriorFile(const std::filesystem::path& path) {
  PriorFile file;
  file.name = path.string();
  file.change_std = missionChangeStd();
  const FieldValue json = parseJson(readWholeFile(path, kJsonLimits), file.name);
  const FieldNode root(json, file.name);
  const std::string format = root.has("format") ? root["format"].text() : std::string();
  if (format == kHistoryFormat) {
    readHistory(root, file);
  } else if (format == detail::kCalibrationFormat) {
    file.earlier = detail::calibrationIn(root, file.name);
  } else {
    throw InputError(file.name + ": 'format' is neither '" + detail::kCalibrationFormat +
                     "' nor '" + kHistoryFormat + "'; give a calibration.json or a history.json");
  }
  return file;
}

}  // namespace pcl_als
