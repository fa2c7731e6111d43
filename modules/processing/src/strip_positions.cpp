// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/processing/strip_positions.h>

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

std::string StripFiles::name() const {
  return id ? "strip " + std::to_string(*id) : files.front().string();
}

StripFileInfo stripFileInfo(const StripFiles& strip) {
  StripFileInfo info;
  for (const std::filesystem::path& file : strip.files) {
    const PointFileInfo one = PointReader::open(file)->info();
    info.points += one.point_count;
    info.files.push_back(one);
    info.resolution = std::clamp(one.resolution.head<2>().minCoeff(), 1e-4, 0.01);
    if (one.point_count == 0) continue;
    info.box.extend(one.minimum);
    info.box.extend(one.maximum);
  }
  return info;
}

PointView StripPoints::view() const {
  PointView view;
  view.first = reinterpret_cast<const std::byte*>(positions.data());
  view.stride = sizeof(Eigen::Vector3f);
  view.count = positions.size();
  view.origin = origin;
  return view;
}

StripPoints readStripPoints(const StripFiles& strip, const Eigen::AlignedBox2d& box,
                            const Eigen::Vector3d& origin) {
  StripPoints points;
  points.origin = origin;
  PointChunk chunk;
  for (const std::filesystem::path& file : strip.files) {
    const auto reader = PointReader::open(file);
    while (reader->read(chunk)) {
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        if (strip.id && chunk.point_source_id[i] != *strip.id) continue;
        ++points.read;
        const Eigen::Vector3d p(chunk.x[i], chunk.y[i], chunk.z[i]);
        if (box.contains(p.head<2>()) && isSurface(chunk, i))
          points.positions.emplace_back((p - origin).cast<float>());
      }
    }
  }
  if (points.read == 0)
    throw InputError(strip.files.front().string() +
                     (strip.id ? ": has no points of strip " + std::to_string(*strip.id)
                               : std::string(": has no points")));
  return points;
}

}  // namespace pcl_als
