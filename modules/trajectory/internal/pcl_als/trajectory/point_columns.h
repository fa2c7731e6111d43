// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

namespace pcl_als {

/// Points as columns: time in the time system of the trajectory, metres in the ground frame.
struct PointColumns {
  const double* time = nullptr;
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  /// Digital numbers; null: none. Needed where a range error depends on it (ErrorSource).
  const float* intensity = nullptr;
  /// Of the mirror: 1 to the left, -1 to the right; null: unknown. Needed for its torsion.
  const std::int8_t* scan_direction = nullptr;
  /// Point source id, and channel of the scanner in the field that divides the strips of a
  /// calibration (SystemLookup::channelField()); null: not recorded. Needed where a calibration has
  /// several systems or fixed strips.
  const std::uint16_t* source = nullptr;
  const std::uint8_t* channel = nullptr;
};

/// Columns that receive an effect on the ground coordinates, metres.
struct EffectColumns {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;
};

}  // namespace pcl_als
