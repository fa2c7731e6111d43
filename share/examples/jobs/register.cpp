// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// register SOURCE TARGET: the rigid motion between two strips, by ICPatch.
#include <exception>
#include <iostream>

#include <pcl_als/io/strip_loader.h>
#include <pcl_als/registration/iterative_closest_patch.h>

int main(int, char** argv) try {
  const auto source = pcl_als::loadStrips({argv[1]}).front();
  const auto target = pcl_als::loadStrips({argv[2]}).front();
  pcl_als::IterativeClosestPatch<pcl_als::PointLidar, pcl_als::PointLidar> icpatch;
  icpatch.setInputSource(source.cloud);
  icpatch.setInputTarget(target.cloud);
  icpatch.setFrames(source.frame, target.frame);
  pcl::PointCloud<pcl_als::PointLidar> aligned;
  icpatch.align(aligned);
  std::cout << icpatch.getResult().motion.shift.transpose() << " m\n";
  return icpatch.hasConverged() ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
