// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/processing/strip_positions.h>
#include <pcl_als/survey/surveyed_file.h>

namespace pcl_als {
namespace {

constexpr std::uint8_t kLowNoise = 7, kHighNoise = 18;

/// The last return of its pulse, neither vegetation nor noise.
bool isSurface(const PointChunk& chunk, std::size_t i) {
  const std::uint8_t code = chunk.classification[i];
  return chunk.return_number[i] >= chunk.number_of_returns[i] && (code < 3 || code > 5) &&
         code != kLowNoise && code != kHighNoise && (chunk.flags[i] & kWithheld) == 0;
}

}  // namespace

StripPart StripPart::ofStrip(std::shared_ptr<const SurveyReader> survey, int strip,
                             const Eigen::AlignedBox3d& box) {
  StripPart part;
  part.name = "strip " + survey->strips()[static_cast<std::size_t>(strip)];
  part.reading.strip = strip;
  part.box = box;
  part.survey = std::move(survey);
  return part;
}

StripPart StripPart::ofFile(std::shared_ptr<const SurveyReader> survey, std::size_t file) {
  StripPart part;
  const PointFileInfo& info = survey->files()[file].sources.info;
  part.name = info.path.string();
  part.reading.files = {file};
  if (info.point_count > 0) part.box = {info.minimum, info.maximum};
  part.survey = std::move(survey);
  return part;
}

std::vector<PointFileInfo> StripPart::files() const {
  std::vector<PointFileInfo> files;
  if (reading.files.empty())
    for (const SurveyedFile& file : survey->files()) files.push_back(file.sources.info);
  for (const std::size_t file : reading.files) files.push_back(survey->files()[file].sources.info);
  return files;
}

PointView StripPoints::view() const {
  PointView view;
  view.first = reinterpret_cast<const std::byte*>(positions.data());
  view.stride = sizeof(Eigen::Vector3f);
  view.count = positions.size();
  view.origin = origin;
  return view;
}

StripPoints readStripPoints(const StripPart& strip, const Eigen::AlignedBox2d& box,
                            const Eigen::Vector3d& origin) {
  StripPoints points;
  points.origin = origin;
  Eigen::AlignedBox3d all;
  // One after the other: several strips of a file are one here.
  SurveyReader::Reading reading = strip.reading;
  reading.threads = 1;
  strip.survey->read(
      [&](const SurveyReader::Run& run) {
        all.extend(boxOf(run.chunk, run.from, run.to));
        points.read += run.to - run.from;
        for (std::size_t row = run.from; row < run.to; ++row) {
          const Eigen::Vector3d p = run.position(row);
          if (box.contains(p.head<2>()) && isSurface(run.chunk, row))
            points.positions.emplace_back((p - origin).cast<float>());
        }
      },
      reading);
  if (points.read == 0) throw InputError(strip.name + ": has no points");
  PointFileInfo known = strip.files().front();
  known.minimum = strip.box.min(), known.maximum = strip.box.max();
  points.box_right = headerBoxIsRight(known, all);
  return points;
}

}  // namespace pcl_als
