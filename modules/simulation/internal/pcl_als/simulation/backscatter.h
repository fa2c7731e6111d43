// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/simulation/scene.h>

namespace pcl_als::simulation {

/// What one surface sends back of one sub-ray of a pulse.
struct Backscatter {
  double range = 0.0;        ///< metres from the firing point
  double share = 0.0;        ///< of the pulse's energy that arrives at the surface and stays there
  double signal = 0.0;       ///< share * reflectance * cos(incidence)^exponent
  double reflectance = 0.0;  ///< of the surface
  double tangent = 0.0;      ///< of the incidence, at most 3; leaves: 0
  LandCover cover = LandCover::grass;
};

}  // namespace pcl_als::simulation
