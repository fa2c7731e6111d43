// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// pipeline A.las B.las trajectory.csv calibration.json OUT.pcd: takes the system biases out of two
// overlapping strips and measures what is left between them, with PCL's filters and ICP around
// pcl_als's correction and point-to-patch correspondences.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

#include <pcl/features/normal_3d.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/icp.h>

#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>
#include <pcl_als/registration/correspondence_rejection_patch.h>
#include <pcl_als/trajectory/trajectory.h>

using pcl_als::PointLidar;
using Cloud = pcl::PointCloud<PointLidar>;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;
using Strip = pcl_als::Strip<PointLidar>;

/// Eq. (13) of Habib et al. 2011 on a strip; every other field keeps its bits.
Strip corrected(const Strip& strip, const std::shared_ptr<const pcl_als::Trajectory>& trajectory,
                const pcl_als::CalibrationResult& calibration) {
  pcl_als::SystemBiasCorrection<PointLidar> correction;
  correction.setTrajectory(trajectory);
  correction.setCalibration(calibration);
  correction.setLocalFrame(strip.frame);
  correction.setInputCloud(strip.cloud);
  Strip result;
  result.id = strip.id;
  result.frame = strip.frame;
  correction.filter(*result.cloud);
  return result;
}

/// Single returns, one point per cubic metre, with normals from PCL, in the frame \a frame.
NormalCloud::Ptr surfaceOf(const Strip& strip, const pcl_als::LocalFrame& frame) {
  Cloud::Ptr single(new Cloud), thinned(new Cloud);
  pcl::PassThrough<PointLidar> pass;
  pass.setInputCloud(strip.cloud);
  pass.setFilterFieldName("intensity");  // any float field of PointLidar will do
  pass.setFilterLimits(1.0F, 65535.0F);
  pass.filter(*single);
  pcl::VoxelGrid<PointLidar> grid;
  grid.setInputCloud(single);
  grid.setLeafSize(1.0F, 1.0F, 1.0F);
  grid.filter(*thinned);

  NormalCloud::Ptr surface(new NormalCloud);
  pcl::copyPointCloud(*thinned, *surface);
  const Eigen::Vector3f shift = (strip.frame.origin - frame.origin).cast<float>();
  for (pcl::PointNormal& point : *surface) point.getVector3fMap() += shift;
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  normals.setInputCloud(surface);
  normals.setKSearch(12);
  normals.setViewPoint(0.0F, 0.0F, 10000.0F);
  NormalCloud::Ptr oriented(new NormalCloud(*surface));
  normals.compute(*oriented);
  return oriented;
}

/// The shift that remains between two strips, metres.
Eigen::Vector3d remainingShift(const NormalCloud::Ptr& source, const NormalCloud::Ptr& target) {
  using Estimation =
      pcl_als::CorrespondenceEstimationPointToPatch<pcl::PointNormal, pcl::PointNormal, double>;
  pcl::shared_ptr<Estimation> estimation(new Estimation);
  pcl::shared_ptr<pcl_als::CorrespondenceRejectorPatch> rejector(
      new pcl_als::CorrespondenceRejectorPatch);
  rejector->setMatchProvider(estimation);
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal, double> icp;
  icp.setCorrespondenceEstimation(estimation);
  icp.addCorrespondenceRejector(rejector);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  NormalCloud aligned;
  icp.align(aligned);
  if (!icp.hasConverged()) throw std::runtime_error("ICP did not converge");
  Eigen::Vector4d centre;
  pcl::compute3DCentroid(*source, centre);
  return (icp.getFinalTransformation() * centre - centre).head<3>();
}

int main(int argc, char** argv) try {
  if (argc != 6) {
    std::cerr << "usage: pipeline A.las B.las trajectory.csv calibration.json OUT.pcd\n";
    return EXIT_FAILURE;
  }
  const pcl_als::CalibrationResult calibration = pcl_als::readCalibration(argv[4]);
  const auto trajectory = std::make_shared<const pcl_als::Trajectory>(
      pcl_als::readTrajectory(argv[3]), pcl_als::trajectoryOptions(calibration));
  const Strip a = pcl_als::loadStrips({argv[1]}).front(),
              b = pcl_als::loadStrips({argv[2]}).front();
  const Strip good_a = corrected(a, trajectory, calibration);
  const Strip good_b = corrected(b, trajectory, calibration);
  const double before = remainingShift(surfaceOf(b, a.frame), surfaceOf(a, a.frame)).norm();
  const double after =
      remainingShift(surfaceOf(good_b, a.frame), surfaceOf(good_a, a.frame)).norm();
  std::cout << "shift between the strips: " << before << " m before, " << after << " m after\n";
  pcl_als::savePcd(argv[5], good_a);
  return after < before ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::cerr << "pipeline: " << error.what() << '\n';
  return EXIT_FAILURE;
}
