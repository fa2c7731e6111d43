// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/attitude_form.h>
#include <pcl_als/trajectory/heading_check.h>

namespace pcl_als {

/// Axes of an attitude as the course over ground shows them.
enum class AxesByCourse { north_east_down, east_north_up, undecided };

/** \brief The axes under which the heading follows the course.
 *
 * Those alone under which it does (HeadingCheck::kLargestCrab). Along courses near north-east and
 * south-west both do: then those under which far fewer headings are beyond this limit, as turns
 * show. Undecided where neither holds, and without motion.
 */
AxesByCourse axesByCourse(const HeadingCheck& check);

/// An attitude that leaves its axes open.
struct OpenAttitude {
  AttitudeForm form;
  std::vector<TrajectorySample>& samples;
  const std::vector<double>& turns;  ///< what headings were turned by; empty: nothing
};

/** \brief Decides the axes of attitudes, and changes the samples to those of TrajectorySample.
 *
 * Attitudes of one form are of one delivery: the courses of all decide together. Of a yaw on which
 * the course does not decide, it is a heading, as its name mostly means. A quaternion has no such
 * default: it remains undecided and as it is.
 */
std::vector<AxesByCourse> settleAxes(const std::vector<OpenAttitude>& attitudes);

/// A remark on what was found, or why nothing was; empty where it is what the file says.
std::string describe(AxesByCourse axes, AttitudeForm form);

}  // namespace pcl_als
