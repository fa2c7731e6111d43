// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>

#include <pcl_als/crs/crs.h>
#include <pcl_als/io/las_point_reader.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;

}  // namespace

LasPointReader::LasPointReader(const std::filesystem::path& path, const PointWindow& window,
                               OtherCoordinates other, unsigned fields)
    : file_(path, fields), window_(window), info_(within(window, file_.info())) {
  if (other == OtherCoordinates::refuse) requireMapCoordinates(info_);
  const Eigen::Vector3d metres = info_.units.metres();
  scaling_ = {file_.header().scale.cwiseProduct(metres),
              file_.header().offset.cwiseProduct(metres)};
}

/// Moves the records inside the bounds to the front of the buffer; returns their number.
std::size_t LasPointReader::keepInside(std::size_t count) {
  const std::size_t length = file_.header().record_length;
  const Eigen::Vector2d scale = scaling_.scale.head<2>(), offset = scaling_.offset.head<2>();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* record = &buffer_[i * length];
    // As in decodeLasRecords(), so that the coordinates are compared that a reader sees.
    const Eigen::Vector2d place(loadLas<std::int32_t>(record) * scale.x() + offset.x(),
                                loadLas<std::int32_t>(record + 4) * scale.y() + offset.y());
    if (!window_.bounds->contains(place)) continue;
    if (kept != i) std::memcpy(&buffer_[kept * length], record, length);
    ++kept;
  }
  return kept;
}

bool LasPointReader::read(PointChunk& chunk) {
  const LasHeader& header = file_.header();
  // Records may have up to 64 kB; a chunk of those is shorter.
  const std::size_t most = std::min(kChunk, kMostBytes / header.record_length);
  std::size_t kept = 0;
  do {
    const std::size_t count = std::min<std::uint64_t>(most, header.point_count - position_);
    buffer_.resize(count * header.record_length);
    file_.readRecords(position_, count, buffer_.data());
    position_ += count;
    kept = window_.bounds ? keepInside(count) : count;
  } while (kept == 0 && position_ < header.point_count);
  decodeLasRecords(buffer_.data(), kept, header.record_length, file_.layout(), scaling_.scale,
                   scaling_.offset, chunk);
  return kept > 0;
}

}  // namespace pcl_als
