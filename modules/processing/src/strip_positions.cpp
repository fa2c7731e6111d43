// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/io/measured_box.h>
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

/// Adds points [from, to) of a chunk.
void addRun(const PointChunk& chunk, std::size_t from, std::size_t to,
            const Eigen::AlignedBox2d& box, StripPoints& points) {
  points.read += to - from;
  for (std::size_t i = from; i < to; ++i) {
    const Eigen::Vector3d p(chunk.x[i], chunk.y[i], chunk.z[i]);
    if (box.contains(p.head<2>()) && isSurface(chunk, i))
      points.positions.emplace_back((p - points.origin).cast<float>());
  }
}

/// Adds the points of a chunk that belong to the strip by the arrangement.
void addArranged(const StripFiles& strip, StripArrangement::Sorter& sorter, const PointChunk& chunk,
                 const Eigen::AlignedBox2d& box, StripPoints& points) {
  for (std::size_t from = 0; from < chunk.size();) {
    const auto [to, label] = sorter.run(chunk, from);
    const int index = strip.arrangement->labels()[label].index;
    if (index >= 0 && (strip.index < 0 || strip.index == index))
      addRun(chunk, from, to, box, points);
    from = to;
  }
}

}  // namespace

std::string StripFiles::name() const {
  return strip.empty() ? files.front().string() : "strip " + strip;
}

StripFileInfo stripFileInfo(const StripFiles& strip, bool measured) {
  StripFileInfo info;
  for (const std::filesystem::path& file : strip.files) {
    const MeasuredFile known =
        measured ? measureBox(file) : MeasuredFile{PointReader::open(file)->info(), {}};
    const PointFileInfo& one = known.info;
    if (!known.box_remark.empty()) info.remarks.push_back(known.box_remark);
    info.points += one.point_count;
    info.files.push_back(one);
    info.resolution = std::clamp(one.resolution.head<2>().minCoeff(), 1e-4, 0.01);
    if (one.point_count == 0) continue;
    info.box.extend(one.minimum);
    info.box.extend(one.maximum);
  }
  if (!strip.box.isEmpty()) info.box = strip.box;
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
  for (std::size_t file = 0; file < strip.files.size(); ++file) {
    const auto reader = PointReader::open(strip.files[file]);
    std::optional<StripArrangement::Sorter> sorter;
    if (strip.arrangement != nullptr) sorter.emplace(*strip.arrangement, strip.places[file]);
    Eigen::AlignedBox3d all;
    while (reader->read(chunk)) {
      all.extend(boxOf(chunk, 0, chunk.size()));
      if (sorter)
        addArranged(strip, *sorter, chunk, box, points);
      else
        addRun(chunk, 0, chunk.size(), box, points);
    }
    if (strip.box.isEmpty() && !reader->boxRemark(all).empty()) points.headers_right = false;
  }
  if (points.read == 0) throw InputError(strip.name() + ": has no points");
  return points;
}

}  // namespace pcl_als
