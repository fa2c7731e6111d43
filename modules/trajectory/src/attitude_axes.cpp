// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/attitude_form.h>
#include <pcl_als/trajectory/attitude_axes.h>

namespace pcl_als {
namespace {

constexpr auto kFromNorth = HeadingReading::heading;
constexpr auto kFromEast = HeadingReading::from_east_counter_clockwise;

/// Whether headings read in one way leave the course, in turns, so much less often than those read
/// in the other that slips and sideward drift do not explain the difference.
bool clearlyBetter(const HeadingCheck& check, HeadingReading one, HeadingReading other) {
  constexpr double kFewest = 20.0, kLeastShare = 0.01, kRatio = 4.0;
  const double beyond = check.shareBeyondCrab(one), other_beyond = check.shareBeyondCrab(other);
  return other_beyond >= kLeastShare &&
         other_beyond * static_cast<double>(check.count()) >= kFewest &&
         other_beyond > kRatio * beyond;
}

}  // namespace

AxesByCourse axesByCourse(const HeadingCheck& check) {
  if (check.count() == 0) return AxesByCourse::undecided;
  const bool north = check.deviation(kFromNorth) <= HeadingCheck::kLargestCrab;
  const bool east = check.deviation(kFromEast) <= HeadingCheck::kLargestCrab;
  if (north && (!east || clearlyBetter(check, kFromNorth, kFromEast)))
    return AxesByCourse::north_east_down;
  if (east && (!north || clearlyBetter(check, kFromEast, kFromNorth)))
    return AxesByCourse::east_north_up;
  return AxesByCourse::undecided;
}

std::vector<AxesByCourse> settleAxes(const std::vector<OpenAttitude>& attitudes) {
  HeadingCheck yaw, quaternion;
  for (const OpenAttitude& each : attitudes) {
    if (each.form == AttitudeForm::heading) continue;
    (each.form == AttitudeForm::yaw ? yaw : quaternion).merge(headingCheck(each.samples));
  }
  std::vector<AxesByCourse> found;
  for (const OpenAttitude& each : attitudes) {
    AxesByCourse axes = AxesByCourse::north_east_down;
    if (each.form == AttitudeForm::quaternion) axes = axesByCourse(quaternion);
    if (each.form == AttitudeForm::yaw && axesByCourse(yaw) == AxesByCourse::east_north_up)
      axes = AxesByCourse::east_north_up;
    found.push_back(axes);
    if (axes != AxesByCourse::east_north_up) continue;
    for (std::size_t i = 0; i < each.samples.size(); ++i)
      takeAsEastNorthUp(each.samples[i], each.form, each.turns.empty() ? 0.0 : each.turns[i]);
  }
  return found;
}

std::string describe(AxesByCourse axes, AttitudeForm form) {
  if (form == AttitudeForm::heading) return {};
  if (form == AttitudeForm::yaw) {
    return axes == AxesByCourse::east_north_up ? "yaw is counter-clockwise from east, as the "
                                                 "course shows: heading = 90 degrees - yaw"
                                               : "";
  }
  switch (axes) {
    case AxesByCourse::north_east_down:
      return "quaternions turn forward, right, down to north, east, down, as the course shows";
    case AxesByCourse::east_north_up:
      return "quaternions turn forward, left, up to east, north, up, as the course shows";
    case AxesByCourse::undecided:
      break;
  }
  return "the course does not show whether its quaternions turn the body to north, east, down or "
         "to east, north, up";
}

}  // namespace pcl_als
