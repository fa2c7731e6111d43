// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "attitude_pass.h"

namespace pcl_als {
namespace {

/// A pass of 40 bins with 21 pulses each: of \a far ones every other pulse is \a off radians ahead
/// of the plane that the others lie in.
std::string objection(int far, double off) {
  std::vector<detail::PassBin> bins(40);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].index = static_cast<std::int64_t>(i);
    for (int k = -10; k <= 10; ++k) {
      const double ahead = static_cast<int>(i) < far && k % 2 == 0 ? off : 0.0;
      const Eigen::Vector3d pulse = Eigen::Vector3d(0.03 * k, ahead, -1.0).normalized();
      bins[i].sums.n += 1.0;
      bins[i].sums.sum += pulse;
      bins[i].sums.products += pulse * pulse.transpose();
    }
  }
  detail::smoothPlanes(bins);
  return detail::objectionTo(detail::judgePass(bins));
}

/// The objection states what the pass was refused for: the median of a pass that lies in planes for
/// most of the time is 0.00 degrees.
TEST(AttitudePass, ObjectsWithTheFigureThatDecided) {
  EXPECT_EQ(objection(0, 0.1), "");
  const std::string always = objection(40, 0.1);
  EXPECT_NE(always.find("the pulses lie in no plane (2.8"), std::string::npos) << always;
  const std::string sometimes = objection(10, 0.1);
  EXPECT_NE(sometimes.find("in 25 % of the tenths of a second the pulses lie in no plane (more "
                           "than 1.1 degrees off it)"),
            std::string::npos)
      << sometimes;
  EXPECT_EQ(sometimes.find("0.00 degrees"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
