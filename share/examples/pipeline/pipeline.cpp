// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// pipeline TRAJECTORY CONTROL.csv CALIBRATION.json OUT.pcd STRIP STRIP…: loads strips, selects the
// points of the overlap that lie on surfaces suitable for measurement, calibrates the system from
// the clouds, corrects them, registers the first two, before and after, and saves. PCL's filters
// and ICP around pcl_als's selections, calibration, correction and point-to-patch primitives.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <vector>

#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/icp.h>

#include <pcl_als/calibration/system_calibration.h>
#include <pcl_als/filters/incidence_selection.h>
#include <pcl_als/filters/overlap_selection.h>
#include <pcl_als/filters/surface_selection.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/registration/point_to_patch.h>

using pcl_als::PointLidar;
using Cloud = pcl::PointCloud<PointLidar>;
using Strip = pcl_als::Strip<PointLidar>;
using Flight = std::shared_ptr<const pcl_als::Trajectory>;

/// Points of a strip on surfaces that another strip sees, too, and that the pulse met at less than
/// 60 degrees.
Cloud::Ptr measurable(const Strip& strip, const Strip& other, const Flight& flight) {
  pcl::IndicesPtr indices(new pcl::Indices);
  pcl_als::OverlapSelection<PointLidar> overlap;
  overlap.setInputCloud(strip.cloud);
  overlap.setLocalFrame(strip.frame);
  overlap.addOtherStrip(other.cloud, other.frame);
  overlap.filter(*indices);
  pcl_als::SurfaceSelection<PointLidar> surfaces;
  surfaces.setInputCloud(strip.cloud);
  surfaces.setLocalFrame(strip.frame);
  surfaces.setIndices(indices);
  pcl::IndicesPtr smooth(new pcl::Indices);
  surfaces.filter(*smooth);
  pcl_als::IncidenceSelection<PointLidar> incidence;
  incidence.setInputCloud(strip.cloud);
  incidence.setLocalFrame(strip.frame);
  incidence.setTrajectory(flight);
  incidence.setAngleLimits(0.0, 60.0);
  incidence.setIndices(smooth);
  Cloud::Ptr selected(new Cloud);
  incidence.filter(*selected);
  return selected;
}

/// The biases of the system that measured these strips.
pcl_als::CalibrationResult calibrated(const std::vector<Strip>& strips, const Flight& flight,
                                      const char* control) {
  pcl_als::SystemCalibration<PointLidar> calibration;
  for (const Strip& strip : strips) calibration.addInputStrip(strip.cloud, strip.frame, strip.id);
  calibration.setTrajectory(flight);
  pcl_als::CalibrationOptions options;
  options.control = pcl_als::readControl(control);
  calibration.setOptions(options);
  calibration.calibrate();
  return calibration.getResult();
}

/// Eq. (13) of Habib et al. 2011 on a strip; every other field keeps its bits.
Strip corrected(const Strip& strip, const Flight& trajectory,
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

/// What can be measured of a strip against another, one point per cubic metre, in the frame \a
/// frame.
Cloud::Ptr surfaceOf(const Strip& strip, const Strip& other, const Flight& flight,
                     const pcl_als::LocalFrame& frame) {
  Cloud::Ptr surface(new Cloud);
  pcl::VoxelGrid<PointLidar> grid;
  grid.setInputCloud(measurable(strip, other, flight));
  grid.setLeafSize(1.0F, 1.0F, 1.0F);
  grid.filter(*surface);
  const Eigen::Vector3f shift = (strip.frame.origin - frame.origin).cast<float>();
  for (PointLidar& point : *surface) point.getVector3fMap() += shift;
  return surface;
}

/// The shift that remains between two strips, metres.
Eigen::Vector3d remainingShift(const Cloud::Ptr& source, const Cloud::Ptr& target) {
  pcl::IterativeClosestPoint<PointLidar, PointLidar, double> icp;
  pcl_als::usePointToPatch(icp);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(40);
  icp.setTransformationEpsilon(1e-12);
  Cloud aligned;
  icp.align(aligned);
  if (!icp.hasConverged()) throw std::runtime_error("ICP did not converge");
  Eigen::Vector4d centre;
  pcl::compute3DCentroid(*source, centre);
  return (icp.getFinalTransformation() * centre - centre).head<3>();
}

double shiftBetween(const Strip& a, const Strip& b, const Flight& flight) {
  return remainingShift(surfaceOf(b, a, flight, a.frame), surfaceOf(a, b, flight, a.frame)).norm();
}

int main(int argc, char** argv) try {
  if (argc < 7) {
    std::cerr << "usage: pipeline TRAJECTORY CONTROL.csv CALIBRATION.json OUT.pcd STRIP STRIP...\n";
    return EXIT_FAILURE;
  }
  const Flight flight = pcl_als::loadTrajectory(argv[1]).trajectory;
  const std::vector<Strip> strips = pcl_als::loadStrips({argv + 5, argv + argc});
  const pcl_als::CalibrationResult calibration = calibrated(strips, flight, argv[2]);
  pcl_als::writeCalibration(argv[3], calibration);
  const Strip &a = strips.at(0), &b = strips.at(1);
  const Strip good_a = corrected(a, flight, calibration),
              good_b = corrected(b, flight, calibration);
  const double before = shiftBetween(a, b, flight), after = shiftBetween(good_a, good_b, flight);
  std::cout << "shift between the strips: " << before << " m before, " << after << " m after\n";
  pcl_als::savePcd(argv[4], good_a);
  return after < before ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::cerr << "pipeline: " << error.what() << '\n';
  return EXIT_FAILURE;
}
