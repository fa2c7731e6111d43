// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_window.h>

namespace pcl_als {
namespace {

/// "x 84900 to 84950 m, y 447500 to 447600 m"
std::string placeText(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return "x " + shortText(low.x()) + " to " + shortText(high.x()) + " m, y " + shortText(low.y()) +
         " to " + shortText(high.y()) + " m";
}

}  // namespace

std::string describe(const PointWindow& window) {
  std::string text = "all points";
  if (window.bounds)
    text = "the points at " + placeText(window.bounds->min(), window.bounds->max());
  if (window.resolution > 0.0) text += ", " + shortText(window.resolution) + " m apart";
  if (window.keep_readable) text += ", of damaged files what is intact";
  return text;
}

void refuseEmptyWindow(const std::vector<std::filesystem::path>& files, const PointWindow& window) {
  PointWindow whole;
  whole.keep_readable = window.keep_readable;
  const auto reader =
      PointReader::open(files.at(0), whole, PointReader::OtherCoordinates::as_stored);
  const PointFileInfo& info = reader->info();
  if (!window.bounds) throw InputError(files[0].string() + ": no point can be read");
  const bool has_header = info.format.rfind("PCD", 0) != 0;
  throw InputError("no point lies within the bounds; " + files[0].string() + " covers " +
                   (has_header ? "by its header " : "") +
                   placeText(info.minimum.head<2>(), info.maximum.head<2>()));
}

void keepInside(const Eigen::AlignedBox2d& bounds, PointChunk& chunk) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < chunk.size(); ++i)
    if (bounds.contains(Eigen::Vector2d(chunk.x[i], chunk.y[i]))) rows.push_back(i);
  if (rows.size() == chunk.size()) return;
  chunk = chunk.select(rows);
}

PointFileInfo within(const PointWindow& window, PointFileInfo info) {
  if (!window.bounds) return info;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(info.minimum.head<2>()),
                                Eigen::Vector2d(info.maximum.head<2>()));
  const Eigen::AlignedBox2d part = box.intersection(*window.bounds);
  if (box.isEmpty() || part.isEmpty()) {
    info.minimum.head<2>() = info.maximum.head<2>() = window.bounds->min();
    info.point_count = 0;
    return info;
  }
  info.minimum.head<2>() = part.min();
  info.maximum.head<2>() = part.max();
  const double area = box.volume();
  if (area > 0.0)
    info.point_count = static_cast<std::uint64_t>(
        std::ceil(static_cast<double>(info.point_count) * std::min(1.0, part.volume() / area)));
  return info;
}

}  // namespace pcl_als
