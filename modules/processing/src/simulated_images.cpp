// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/processing/simulated_images.h>

namespace pcl_als {
namespace {

constexpr double kExactSigma = 0.001;  ///< metres, of lines and points without errors

std::string pointsText(const std::vector<ControlPoint>& points) {
  std::string text = "id,x,y,z,sigma\n";
  for (const ControlPoint& point : points) {
    char line[160];
    std::snprintf(line, sizeof line, ",%.5f,%.5f,%.5f,%.4f\n", point.position.x(),
                  point.position.y(), point.position.z(),
                  point.sigma > 0.0 ? point.sigma : kExactSigma);
    text += point.id + line;
  }
  return text;
}

}  // namespace

simulation::ImageFlightOptions imageFlightOver(const simulation::SimulationOptions& options) {
  simulation::ImageFlightOptions flight;
  double highest = 0.0;
  for (const simulation::PlannedLine& line : options.lines)
    highest = std::max(highest, line.height);
  flight.height = std::min(flight.height, 2.0 * highest);
  flight.tie_spacing *= flight.height / 1000.0;
  if (options.noise.range <= 0.0) flight.noise = flight.line_noise = 0.0;
  return flight;
}

std::string writeImageFiles(const simulation::SimulatedImages& images,
                            const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<ObjectLine> ridges = images.ridges;
  for (ObjectLine& ridge : ridges)
    ridge.covariance = kExactSigma * kExactSigma * Eigen::Matrix4d::Identity();
  writeCamera(folder / "camera.json", images.camera);
  writeImages(folder / "images.csv", images.approximate);
  writeMeasurements(folder / "measurements.csv", images.camera, images.measurements);
  writeFile(folder / "checkpoints.csv", pointsText(images.check_points));
  writeImages(folder / "true_images.csv", images.truth);
  writeFile(folder / "true_points.csv", pointsText(images.true_points));
  writeLines(folder / "true_lines.csv", ridges);
  return grouped(images.truth.size()) + " images, " + grouped(images.measurements.size()) +
         " image coordinates, " + grouped(images.check_points.size()) + " check points, " +
         grouped(images.ridges.size()) + " ridges";
}

}  // namespace pcl_als
