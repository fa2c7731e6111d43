// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pcl_als {

/// Whether the biases of a calibration may be applied to points; the most serious reason against it
/// last.
enum class CalibrationStatus {
  usable,
  parameters_affected,  ///< errors that the model does not describe have changed the estimates
  no_improvement,       ///< the misfit between the strips is not smaller after the calibration
  not_determined,       ///< no parameter, or not every requested one, can be estimated
  not_converged,        ///< the iteration ended without a solution
};

/** \brief The verdict on a calibration: a status and the reason in one sentence.
 *
 * A check that finds a reason against applying a result adds it with downgrade(). Tools that apply
 * a calibration refuse one that is not usable() unless the user insists.
 */
struct CalibrationVerdict {
  CalibrationStatus status = CalibrationStatus::usable;
  std::string reason;  ///< why; may be empty for a usable calibration

  bool usable() const { return status == CalibrationStatus::usable; }
  /// Adds a reason against applying the result. The most serious status is kept; the reasons follow
  /// one another, separated by semicolons. A reason for being usable is replaced.
  void downgrade(CalibrationStatus against, const std::string& why);
  /// "not converged: the adjustment did not converge in 20 iterations"
  std::string text() const;
};

/** \brief Misfit between overlapping strips before and after a calibration, at the same points.
 *
 * Points are chosen in the data as delivered, each without its own height; those with an acceptable
 * patch of the other strip both before and after are compared. Distances beyond \a limit count as
 * \a limit, before and after alike. The standard deviation of the change is that of a sum over
 * areas as clusters.
 */
struct MisfitChange {
  std::size_t points = 0, areas = 0;
  double rms_before = 0.0, rms_after = 0.0;  ///< metres, along the normals
  double limit = 0.0;                        ///< metres
  double change_std = 0.0;                   ///< metres, of change(); NaN for a single area

  double change() const { return rms_after - rms_before; }  ///< metres
};

std::string_view toString(CalibrationStatus status);
std::optional<CalibrationStatus> calibrationStatusNamed(std::string_view name);

}  // namespace pcl_als
