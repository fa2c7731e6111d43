// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "correction_record.h"

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {
namespace {

bool isInverse(const AppliedCorrection& a, const AppliedCorrection& b) {
  const bool kinds =
      (a.kind == CorrectionKind::biases_removed && b.kind == CorrectionKind::biases_applied) ||
      (a.kind == CorrectionKind::biases_applied && b.kind == CorrectionKind::biases_removed);
  return kinds && a.id == b.id && a.strip_corrections == b.strip_corrections;
}

/// Whether the second correction would be made twice: the same biases, or intensities again.
bool isRepeated(const AppliedCorrection& a, const AppliedCorrection& b) {
  return a.kind == b.kind && (a.kind == CorrectionKind::intensity || a.id == b.id);
}

bool changesIntensity(const AppliedCorrection& correction) {
  return correction.kind == CorrectionKind::intensity;
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
                       Remedy::force);
    if (changesIntensity(earlier) == changesIntensity(correction))
      warnings.push_back(earlier.describe() + " before");
  }
  corrections.push_back(correction);
  return correctionsRecord(corrections);
}

}  // namespace pcl_als::detail
