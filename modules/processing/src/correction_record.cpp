// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "correction_record.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/processing/file_correction.h>

namespace pcl_als::detail {
namespace {

bool isInverse(const AppliedCorrection& a, const AppliedCorrection& b) {
  const bool kinds =
      (a.kind == CorrectionKind::biases_removed && b.kind == CorrectionKind::biases_applied) ||
      (a.kind == CorrectionKind::biases_applied && b.kind == CorrectionKind::biases_removed);
  return kinds && a.id == b.id && a.strip_corrections == b.strip_corrections;
}

/// Whether the second correction would be made twice.
bool isRepeated(const AppliedCorrection& a, const AppliedCorrection& b) {
  return a.kind == b.kind && a.id == b.id;
}

bool changesIntensity(const AppliedCorrection& correction) {
  return correction.kind == CorrectionKind::intensity;
}

std::string textOf(const SystemVector& biases) {
  std::ostringstream text;
  for (const SystemParameterInfo& info : systemParameters()) {
    const double value = biases[indexOf(info.parameter)] / info.internal_per_unit;
    if (value == 0.0) continue;
    text << (text.tellp() > 0 ? ", " : "") << info.name << ' ' << value;
    if (info.unit != "1") text << ' ' << info.unit;
  }
  return text.tellp() > 0 ? text.str() : "all biases are zero";
}

}  // namespace

std::string recordWith(const std::string& record, const AppliedCorrection& correction,
                       const std::string& file, bool force, Warnings& warnings) {
  AppliedCorrections corrections = parseCorrections(record);
  if (!corrections.empty() && isInverse(corrections.back(), correction)) {
    corrections.pop_back();
    return correctionsRecord(corrections);
  }
  for (const AppliedCorrection& earlier : corrections) {
    if (isRepeated(earlier, correction) && !force)
      throw InputError(file + ": " + earlier.describe() +
                           " before; give the file as it was before that correction",
                       Hint::force);
    if (changesIntensity(earlier) == changesIntensity(correction))
      warnings.push_back(earlier.describe() + " before");
  }
  corrections.push_back(correction);
  return correctionsRecord(corrections);
}

bool isFixedSurface(const std::filesystem::path& file, const CalibrationResult& calibration) {
  SystemLookup systems(calibration);
  if (calibration.held.empty() || systems.single()) return false;
  systems.setStrip(file.stem().string());
  const std::vector<PointSource> sources = surveySources(file).sources;
  return std::all_of(sources.begin(), sources.end(), [&](const PointSource& source) {
    return systems.of(source.id, 0) == systems.fixed();
  });
}

}  // namespace pcl_als::detail

namespace pcl_als {

std::string describeBiases(const CalibrationResult& calibration) {
  std::string text;
  for (const SystemEstimate& system : calibration.systems)
    text += (text.empty() ? "" : "; ") + system.group.name + ": " +
            detail::textOf(system.values().head<kSystemParameterCount>());
  if (text.empty()) text = detail::textOf(calibration.biases());
  for (const FixedSurface& surface : calibration.held) {
    for (const std::string& strip : surface.strips)
      text +=
          (&strip == &surface.strips.front() ? "; unchanged, because held fixed: strips " : ", ") +
          strip;
  }
  return text;
}

}  // namespace pcl_als
