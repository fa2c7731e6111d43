// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstring>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/pcd_io.h>

#include "pcd_file.h"
#include "pcd_layout.h"
#include "point_fill.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 15;

std::string headerOf(const Strip<PointLidar>& strip, const std::vector<PcdColumn>& columns) {
  const auto& cloud = *strip.cloud;
  const bool organized = std::size_t{cloud.width} * cloud.height == cloud.size();
  detail::PcdDescription description;
  description.strip_id = strip.id;
  description.frame = strip.frame;
  description.corrections = strip.corrections;
  for (const PcdColumn& column : columns) description.columns.push_back(column.name);
  description.width = organized ? cloud.width : cloud.size();
  description.height = organized ? cloud.height : 1;
  return detail::pcdHeaderText(description);
}

bool hasDoubles(const detail::PcdHeader& header) {
  return header.find("x")->size == 8 || header.find("y")->size == 8 || header.find("z")->size == 8;
}

/// The frame that the file's coordinates are put in: its VIEWPOINT, or the centre of doubles.
LocalFrame frameOf(detail::PcdFile& file) {
  LocalFrame frame{file.origin(), usableCrs(file.header().crs).crs};
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
  const std::size_t length = detail::kPcdRecord + sizeof(float) * columns.size();
  std::vector<char> block;
  const auto& points = strip.cloud->points;
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - first);
    block.resize(count * length);
    for (std::size_t i = 0; i < count; ++i) {
      char* at = &block[i * length];
      detail::putPcdPoint(points[first + i], at);
      at += detail::kPcdRecord;
      for (const PcdColumn& column : columns) {
        std::memcpy(at, &column.values[first + i], sizeof(float));
        at += sizeof(float);
      }
    }
    file.write(block.data(), block.size());
  }
  file.commit();
}

Strip<PointLidar> loadPcd(const std::filesystem::path& path) {
  PcdFindings ignored;
  return loadPcd(path, {}, ignored);
}

Strip<PointLidar> loadPcd(const std::filesystem::path& path, const std::string& channel_field,
                          PcdFindings& findings) {
  detail::PcdFile file(path, channel_field);
  findings = {file.remarks(),
              file.timeFault(),
              file.header().find("intensity") != nullptr,
              file.header().find("flags") != nullptr,
              {},
              {}};
  Strip<PointLidar> strip;
  strip.frame = frameOf(file);
  const Eigen::Vector3d shift = strip.frame.origin - file.origin();
  strip.cloud->reserve(file.header().points);
  PointChunk chunk;
  while (file.read(PointReader::kChunk, chunk)) {
    for (std::size_t i = 0; i < chunk.size(); ++i)
      strip.cloud->push_back(detail::pointOf(chunk, i, shift));
    if (!channel_field.empty() && file.hasChannels())
      findings.channels.insert(findings.channels.end(), chunk.channel.begin(), chunk.channel.end());
  }
  const detail::PcdField* channel = file.header().named(channel_field);
  if (channel != nullptr && channel->column.empty())
    findings.channel_column = {
        {channel->name, {findings.channels.begin(), findings.channels.end()}}};
  strip.cloud->sensor_origin_.head<3>() = strip.frame.origin.cast<float>();
  strip.corrections = file.header().corrections;
  strip.id = idOf(file, path, *strip.cloud);
  return strip;
}

}  // namespace pcl_als
