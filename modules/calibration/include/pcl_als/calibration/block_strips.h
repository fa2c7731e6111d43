// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/calibration/pair_observation.h>

namespace pcl_als {

/// The strips of a block and the surfaces that they are compared with, by index.
struct BlockStrips {
  /// A reference surface, or the fixed strips together.
  struct Held {
    ReferenceSurface surface;
    bool is_reference = false;
  };

  std::vector<std::string> ids;  ///< of strips, and names of reference surfaces
  std::vector<bool> used;        ///< false: left out
  std::vector<int> held_of;      ///< index in held; -1: the strip is not held fixed
  std::vector<Held> held;

  std::size_t size() const { return ids.size(); }
  /// Returns the index.
  int add(const std::string& id);
  /// UsageError for a standard deviation that is not positive, or a name of a strip.
  int addReference(const ReferenceSurface& surface);

  bool isHeld(int strip) const { return held_of[static_cast<std::size_t>(strip)] >= 0; }
  bool isHeld(const PairObservation& o) const {
    return o.a != PairObservation::kControl && (isHeld(o.a) || isHeld(o.b));
  }
  bool isReference(int strip) const;
  /// Whether a strip is used and was flown.
  bool isFlown(int strip) const {
    return used[static_cast<std::size_t>(strip)] && !isReference(strip);
  }
  /// The strips that are, in increasing order.
  std::vector<int> flown() const;
  /// By strip, whether it is used and not held fixed.
  std::vector<bool> corrected() const;
  /// The index of a strip; UsageError for an unknown id.
  int named(const std::string& id) const;
};

/** \brief Holds the strips fixed that the settings name, and gives each held surface a system that
 * has no unknowns.
 *
 * \param systems those of all strips; those of the held surfaces are added
 * UsageError for a strip that does not exist, or where nothing is left to be calibrated.
 */
void holdSurfaces(const CalibrationSettings& settings, BlockStrips& strips, StripSystems& systems);

}  // namespace pcl_als
