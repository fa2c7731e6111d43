// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// What a correction changed.
enum class CorrectionKind {
  biases_removed,  ///< coordinates: the biases of a calibration were removed
  biases_applied,  ///< coordinates: the biases of a calibration were applied
  rigid_motion,    ///< coordinates: the points were moved onto another strip
  intensity,       ///< intensities: range, incidence angle, atmosphere, gains
  unreadable,      ///< a record of corrections that this version cannot read
};

/** \brief One correction of the points of a file, as the file records it.
 *
 * A LAS file records its corrections in a VLR (user "pcl_als", record 1), a PCD file in a comment
 * line; both hold the same JSON text:
 * \code
 * {"corrections":[{"kind":"biases_removed","id":"5f0c…","strip_corrections":true,
 *                  "values":"boresight_roll -90 arcsec, range_bias 0.12 m"}]}
 * \endcode
 */
struct AppliedCorrection {
  CorrectionKind kind = CorrectionKind::biases_removed;
  /// What must not be corrected twice: calibrationId() for biases; of intensities "terms" (of the
  /// radar equation) or "gains".
  std::string id;
  bool strip_corrections = false;  ///< trajectory errors of the strip were corrected as well
  std::string values;              ///< in words, for messages

  /// "the biases of calibration 5f0c… were removed (boresight_roll -90 arcsec)".
  std::string describe() const;
};
using AppliedCorrections = std::vector<AppliedCorrection>;  ///< in order of their application

/// The corrections of a record (PointFileInfo::corrections); none for an empty text. A text that
/// cannot be read is one correction of kind unreadable.
AppliedCorrections parseCorrections(const std::string& record);
/// The record as one line of JSON; empty for no corrections. The oldest corrections are omitted
/// where a VLR could not hold all of them.
std::string correctionsRecord(const AppliedCorrections& corrections);

/// Identifier of what a calibration changes in points, a name-based UUID (RFC 4122, version 5):
/// equal for a calibration and for the one that is read from its file, whatever else they state.
std::string calibrationId(const CalibrationResult& calibration);
/// Such an identifier of any text.
std::string contentId(const std::string& text);

}  // namespace pcl_als
