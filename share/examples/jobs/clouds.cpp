// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// clouds TRAJECTORY CONTROL.csv MODEL.json PICTURE.png STRIP…: whole jobs on clouds in memory. The
// model is one of pcl_als_classify -save_class_model.
#include <cmath>
#include <exception>
#include <iostream>

#include <pcl/common/common.h>

#include <pcl_als/calibration/system_calibration.h>
#include <pcl_als/classification/land_cover_filter.h>
#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/drawing/point_picture.h>
#include <pcl_als/filters/intensity_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/processing/delivery_check.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/registration/iterative_closest_patch.h>

namespace {

using pcl_als::PointLidar;
using Strip = pcl_als::Strip<PointLidar>;
using Flight = std::shared_ptr<const pcl_als::Trajectory>;

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

void correct(const pcl_als::CalibrationResult& calibration, const Flight& flight, Strip& strip) {
  pcl_als::SystemBiasCorrection<PointLidar> correction;
  correction.setTrajectory(flight);
  correction.setCalibration(calibration);
  correction.setLocalFrame(strip.frame);
  correction.setInputCloud(strip.cloud);
  strip.cloud = std::make_shared<pcl::PointCloud<PointLidar>>();
  correction.filter(*strip.cloud);
}

/// RMS of the offsets of all pairs along the normals, metres.
double misfit(const std::vector<Strip>& strips) {
  pcl_als::DeliveryCheck<PointLidar> check;
  for (const Strip& strip : strips) check.addInputStrip(strip.cloud, strip.frame, strip.id);
  check.check();
  double sum = 0.0;
  for (const auto& pair : check.getResult().pairs)
    sum += pair.assessment.normal.rms * pair.assessment.normal.rms;
  return std::sqrt(sum / static_cast<double>(check.getResult().pairs.size()));
}

void correctIntensity(const Flight& flight, Strip& strip) {
  pcl_als::IntensityCorrection<PointLidar> correction;
  correction.setTrajectory(flight);
  correction.setLocalFrame(strip.frame);
  correction.setInputCloud(strip.cloud);
  strip.cloud = std::make_shared<pcl::PointCloud<PointLidar>>();
  correction.filter(*strip.cloud);
}

void classify(const pcl_als::GaussianModel& model, Strip& strip) {
  PointLidar low, high;
  pcl::getMinMax3D(*strip.cloud, low, high);
  const Eigen::Vector3d origin = strip.frame.origin;
  pcl_als::SurfaceAccumulator surface(
      pcl_als::RasterGrid::covering(origin.x() + low.x, origin.y() + low.y, origin.x() + high.x,
                                    origin.y() + high.y, 1.0, strip.frame.crs),
      pcl_als::SurfaceOptions());
  for (const PointLidar& p : *strip.cloud)
    surface.add({origin.x() + p.x, origin.y() + p.y, origin.z() + p.z, p.intensity, p.return_number,
                 p.number_of_returns, p.classification});
  pcl_als::LandCoverFilter<PointLidar> filter;
  filter.setClassifier(std::make_shared<pcl_als::PointClassifier>(
      std::make_shared<pcl_als::MaximumLikelihood>(model),
      std::make_shared<pcl_als::Raster>(surface.compute().raster)));
  filter.setLocalFrame(strip.frame);
  filter.setInputCloud(strip.cloud);
  strip.cloud = std::make_shared<pcl::PointCloud<PointLidar>>();
  filter.filter(*strip.cloud);
}

double shiftBetween(const Strip& source, const Strip& target) {
  pcl_als::IterativeClosestPatch<PointLidar, PointLidar> icpatch;
  icpatch.setInputSource(source.cloud);
  icpatch.setInputTarget(target.cloud);
  icpatch.setFrames(source.frame, target.frame);
  pcl::PointCloud<PointLidar> aligned;
  icpatch.align(aligned);
  return icpatch.getResult().motion.shift.norm();
}

void draw(const Strip& strip, const char* file) {
  PointLidar low, high;
  pcl::getMinMax3D(*strip.cloud, low, high);
  const Eigen::Vector3d origin = strip.frame.origin;
  pcl_als::PointPicture picture(1200, 800);
  pcl_als::OrthographicCamera camera(30.0, 45.0);
  camera.frame(origin + low.getVector3fMap().cast<double>(),
               origin + high.getVector3fMap().cast<double>(), picture.mapWidth(),
               picture.mapHeight());
  pcl_als::PixelThinning points(camera);
  for (const PointLidar& p : *strip.cloud)
    points.add(origin + p.getVector3fMap().cast<double>(), p.intensity);
  pcl_als::PointColoring coloring;
  coloring.heading = "Corrected intensity";
  coloring.fitScale(points, 0.02, false);
  picture.draw(points, coloring).write(file);
}

}  // namespace

int main(int argc, char** argv) try {
  auto strips = pcl_als::loadStrips({argv + 5, argv + argc});
  const Flight flight = pcl_als::loadTrajectory(argv[1]).trajectory;
  const auto model = pcl_als::readClassModel(argv[3]);
  const auto calibration = calibrated(strips, flight, argv[2]);
  const double before = misfit(strips);
  for (Strip& strip : strips) {
    correct(calibration, flight, strip);
    correctIntensity(flight, strip);
    classify(model, strip);
  }
  draw(strips.front(), argv[4]);
  std::cout << "misfit " << before << " m, corrected " << misfit(strips) << " m, shift "
            << shiftBetween(strips[1], strips[0]) << " m\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
