// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// An angle in [0, 2 pi).
inline double wholeTurn(double angle) {
  const double turn = 2.0 * kPi, rest = std::fmod(angle, turn);
  return rest < 0.0 ? rest + turn : rest;
}

/** \brief Takes an attitude that was read as one of north, east, down as one of east, north, up.
 *
 * Both are rotations about z, y and x in this order. The x axis points forward in both: roll stays.
 * The y axis points left instead of right: pitch changes its sign, but for a yaw, beside which
 * pitch is nose up. The z axis points up: yaw is counter-clockwise from east.
 * \param turn what the heading was turned by since it was read (meridian convergence)
 */
inline void takeAsEastNorthUp(TrajectorySample& sample, AttitudeForm form, double turn) {
  if (form != AttitudeForm::yaw) sample.pitch = -sample.pitch;
  sample.heading = wholeTurn(0.5 * kPi - (sample.heading - turn) + turn);
}

}  // namespace pcl_als
