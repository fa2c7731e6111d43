// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "prior_options.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>

#include "flight_options.h"

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;

/// A text has NAME=VALUE:STD; a file may have such a name, too.
bool namesFile(const std::string& text) {
  std::error_code error;
  return text.find('=') == std::string::npos || fs::exists(text, error);
}

std::vector<fs::path> priorFiles(const CommandLine& line) {
  if (!line.given("prior") || !namesFile(line.text("prior"))) return {};
  return {line.text("prior")};
}

bool isSameStrip(const StripErrors& one, const StripErrors& other) {
  constexpr double kEqual = 0.5;  // seconds
  return !one.knots.empty() && !other.knots.empty() &&
         std::abs(one.knots.front().time - other.knots.front().time) < kEqual &&
         std::abs(one.knots.back().time - other.knots.back().time) < kEqual;
}

}  // namespace

void setChanges(std::string_view text, SystemVector& change_std) {
  setBiases(text, change_std);
  for (const SystemParameterInfo& info : systemParameters())
    if (change_std[indexOf(info.parameter)] < 0.0)
      throw UsageError(std::string(info.name) + ": a standard deviation must not be negative");
}

void addPriorOptions(CommandLine& line) {
  const OptionGroup group(line, Group::priors);
  line.addInputFile("prior",
                    "what is known of the biases: boresight_roll=0:5,… (value and standard "
                    "deviation, m, arcsec), or the calibration.json of an earlier flight with the "
                    "system, or the history.json of several",
                    priorFiles);
  line.addText("prior_change",
               "with a file of -prior: boresight_roll=5,… standard deviation of the change of "
               "parameters since (default: that of the history; of a calibration 5 arcsec, heading "
               "10, 0.005 m, scale 1e-5)");
  line.makeDependent("prior_change", "prior");
}

GivenPrior::GivenPrior(const CommandLine& line, CalibrationSettings& settings) {
  if (!line.has("prior")) return;
  const std::string text = line.text("prior");
  if (!namesFile(text)) {
    if (line.has("prior_change"))
      throw UsageError("option -prior_change: -prior gives values, not a file");
    settings.shared_errors.biases =
        line.parsed("prior", [](const std::string& values) { return biasPrior(values); });
    return;
  }
  file_ = readPriorFile(text);
  requireUsable(line, file_->name, file_->earlier.verdict, {"used as a prior", "uses"});
  if (!file_->earlier.systems.empty() && settings.systems.empty())
    throw InputError(file_->name +
                     ": has several systems, and this block is calibrated as one; "
                     "divide its strips with -systems, the first one as the first of the prior");
  if (line.has("prior_change"))
    line.parsed("prior_change", [&](const std::string& changes) {
      setChanges(changes, file_->change_std);
      return true;
    });
  settings.shared_errors.biases = file_->prior();
}

void GivenPrior::warnOfSameStrips(CalibrationResult& result) const {
  if (!file_) return;
  for (const StripErrors& strip : result.strip_errors) {
    const std::vector<StripErrors>& earlier = file_->earlier.strip_errors;
    if (std::none_of(earlier.begin(), earlier.end(),
                     [&](const StripErrors& other) { return isSameStrip(strip, other); }))
      continue;
    result.warnings.push_back(
        "the prior of " + file_->name + " was estimated from strip " + strip.id +
        " of this block: its observations count twice, and standard deviations are too small");
    return;
  }
}

}  // namespace pcl_als::app
