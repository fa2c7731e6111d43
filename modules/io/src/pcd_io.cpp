// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>

#include "pcd_file.h"
#include "point_fill.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 15;
constexpr std::size_t kRecord = 34;

/// A comment must stay one line.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// " VALUE" once for every column.
std::string repeated(const char* value, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text.append(" ").append(value);
  return text;
}

std::string headerOf(const Strip<PointLidar>& strip, const std::vector<PcdColumn>& columns) {
  const auto& cloud = *strip.cloud;
  const bool organized = std::size_t{cloud.width} * cloud.height == cloud.size();
  const std::size_t width = organized ? cloud.width : cloud.size();
  const std::size_t height = organized ? cloud.height : 1;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "# .PCD v0.7 - Point Cloud Data file format\n";
  if (!strip.id.empty()) text << detail::kPcdStripComment << oneLine(strip.id) << '\n';
  if (!strip.frame.crs.empty()) text << detail::kPcdCrsComment << oneLine(strip.frame.crs) << '\n';
  text << "VERSION 0.7\n"
          "FIELDS x y z gps_time intensity scan_angle point_source_id return_number "
          "number_of_returns classification flags";
  for (const PcdColumn& column : columns) text << ' ' << column.name;
  text << "\nSIZE 4 4 4 8 4 4 2 1 1 1 1" << repeated("4", columns.size())
       << "\nTYPE F F F F F F U U U U U" << repeated("F", columns.size())
       << "\nCOUNT 1 1 1 1 1 1 1 1 1 1 1" << repeated("1", columns.size()) << '\n'
       << "WIDTH " << width << "\nHEIGHT " << height << "\nVIEWPOINT " << strip.frame.origin.x()
       << ' ' << strip.frame.origin.y() << ' ' << strip.frame.origin.z() << " 1 0 0 0\nPOINTS "
       << cloud.size() << "\nDATA binary\n";
  return text.str();
}

template <typename T>
void put(char*& at, const T& value) {
  std::memcpy(at, &value, sizeof value);
  at += sizeof value;
}

void putPoint(char* at, const PointLidar& p) {
  put(at, p.x), put(at, p.y), put(at, p.z);
  put(at, p.gps_time);
  put(at, p.intensity), put(at, p.scan_angle);
  put(at, p.point_source_id);
  put(at, p.return_number), put(at, p.number_of_returns);
  put(at, p.classification), put(at, p.flags);
}

bool hasDoubles(const detail::PcdHeader& header) {
  return header.find("x")->size == 8 || header.find("y")->size == 8 || header.find("z")->size == 8;
}

/// The frame that the file's coordinates are put in: its VIEWPOINT, or the centre of doubles.
LocalFrame frameOf(detail::PcdFile& file) {
  LocalFrame frame{file.header().viewpoint, file.header().crs};
  if (!hasDoubles(file.header())) return frame;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  PointChunk chunk;
  while (file.read(PointReader::kChunk, chunk))
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const Eigen::Vector3d point(chunk.x[i], chunk.y[i], chunk.z[i]);
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  file.rewind();
  if (low.x() > high.x()) return frame;
  return LocalFrame::around(frame.origin + 0.5 * (low + high), frame.crs);
}

std::string idOf(const detail::PcdFile& file, const std::filesystem::path& path,
                 const pcl::PointCloud<PointLidar>& cloud) {
  if (!file.header().strip_id.empty()) return file.header().strip_id;
  const std::uint16_t first = cloud.empty() ? 0 : cloud[0].point_source_id;
  const bool same = std::all_of(cloud.begin(), cloud.end(), [first](const PointLidar& point) {
    return point.point_source_id == first;
  });
  return same && first != 0 ? std::to_string(first) : path.stem().string();
}

}  // namespace

void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip) {
  savePcd(path, strip, {});
}

void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip,
             const std::vector<PcdColumn>& columns) {
  for (const PcdColumn& column : columns) {
    if (column.values.size() != strip.cloud->size())
      throw UsageError(path.string() + ": column " + column.name + " is not as long as the cloud");
  }
  AtomicFile file(path);
  file.write(headerOf(strip, columns));
  const std::size_t length = kRecord + sizeof(float) * columns.size();
  std::vector<char> block;
  const auto& points = strip.cloud->points;
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - first);
    block.resize(count * length);
    for (std::size_t i = 0; i < count; ++i) {
      putPoint(&block[i * length], points[first + i]);
      char* at = &block[i * length + kRecord];
      for (const PcdColumn& column : columns) put(at, column.values[first + i]);
    }
    file.write(block.data(), block.size());
  }
  file.commit();
}

Strip<PointLidar> loadPcd(const std::filesystem::path& path) {
  detail::PcdFile file(path);
  Strip<PointLidar> strip;
  strip.frame = frameOf(file);
  const Eigen::Vector3d shift = strip.frame.origin - file.header().viewpoint;
  strip.cloud->reserve(file.header().points);
  PointChunk chunk;
  while (file.read(PointReader::kChunk, chunk))
    for (std::size_t i = 0; i < chunk.size(); ++i)
      strip.cloud->push_back(detail::pointOf(chunk, i, shift));
  strip.cloud->sensor_origin_.head<3>() = strip.frame.origin.cast<float>();
  strip.id = idOf(file, path, *strip.cloud);
  return strip;
}

}  // namespace pcl_als
