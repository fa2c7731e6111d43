// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/image_orientation.h>

namespace pcl_als {
namespace {

/// Refuses check points of which none is in the images, or one is given twice.
void checkNames(const std::vector<ControlPoint>& check_points, const ImageBlock& block) {
  std::set<std::string> measured, given;
  for (const ImageMeasurement& m : block.measurements)
    if (m.kind == ImageMeasurement::Kind::point) measured.insert(m.feature);
  bool any = check_points.empty();
  for (const ControlPoint& point : check_points) {
    if (!given.insert(point.id).second)
      throw InputError("check point " + point.id + " is given twice");
    any = any || measured.count(point.id) > 0;
  }
  if (!any)
    throw InputError("no check point is measured in the images (the first is " +
                     check_points.front().id + "): points are found by their names");
}

void compare(const std::vector<ControlPoint>& check_points, ImageOrientationResult& result) {
  std::map<std::string, const GroundPoint*> points;
  for (const GroundPoint& point : result.bundle.points) points[point.id] = &point;
  for (const ControlPoint& surveyed : check_points) {
    const auto found = points.find(surveyed.id);
    if (found == points.end()) {
      result.missing_points.push_back(surveyed.id);
      continue;
    }
    ImageCheckPoint& point = result.check_points.emplace_back();
    point.id = surveyed.id;
    point.position = surveyed.position;
    point.difference = found->second->position - surveyed.position;
    point.std = found->second->covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    point.rays = found->second->rays;
  }
}

void findUnknownLines(ImageOrientationResult& result) {
  std::set<std::string> known, unknown;
  for (const ObjectLine& line : result.block.lines) known.insert(line.id);
  for (const ImageMeasurement& m : result.block.measurements) {
    if (m.kind == ImageMeasurement::Kind::line && known.count(m.feature) == 0)
      unknown.insert(m.feature);
  }
  result.unknown_lines.assign(unknown.begin(), unknown.end());
}

}  // namespace

std::filesystem::path ImageBlockFiles::besideImages(const std::filesystem::path& images) {
  return images.parent_path() / "measurements.csv";
}

CheckSummary summaryOf(const std::vector<ImageCheckPoint>& points) {
  CheckSummary summary;
  for (int axis = 0; axis < 3; ++axis) {
    RunningStatistics statistics;
    for (const ImageCheckPoint& point : points) statistics.add(point.difference[axis]);
    summary.mean[axis] = statistics.mean();
    summary.std[axis] = statistics.standardDeviation();
    summary.rmse[axis] = statistics.rms();
  }
  summary.total = summary.rmse.norm();
  return summary;
}

ImageOrientationResult orientImages(ImageBlock block, const std::vector<ControlPoint>& check_points,
                                    const ImageOrientationOptions& options) {
  checkNames(check_points, block);
  ImageOrientationResult result;
  result.block = std::move(block);
  if (options.assign_distance > 0.0)
    result.assignments = assignLines(result.block, options.assign_distance);
  findUnknownLines(result);
  result.bundle = adjustBundle(result.block, options.bundle);
  compare(check_points, result);
  return result;
}

ImageOrientationResult orientImages(const ImageBlockFiles& files,
                                    const ImageOrientationOptions& options,
                                    const ProgressCallback& callback) {
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  progress.begin("Reading the image block");
  ImageBlock block;
  block.camera = readCamera(files.camera);
  block.images = readImages(files.images);
  block.measurements = readMeasurements(files.measurements, block.camera, options.image_sigma);
  block.lines = readLines(files.lines);
  std::vector<ControlPoint> check_points;
  if (files.check_points) check_points = readControl(*files.check_points);
  progress.end(counted(block.images.size(), "image") + ", " + grouped(block.measurements.size()) +
               " measurements, " + counted(block.lines.size(), "line"));
  progress.begin("Adjusting");
  ImageOrientationResult result = orientImages(std::move(block), check_points, options);
  progress.end(grouped(result.bundle.observations) + " observations, " +
               grouped(result.bundle.unknowns) + " unknowns, " +
               counted(result.bundle.blunders.size(), "blunder"));
  if (options.assign_distance > 0.0)
    progress.remark(counted(result.assignments.size(), "line") + " assigned by position");
  return result;
}

}  // namespace pcl_als
