// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/las_point_reader.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;
constexpr std::size_t kMostNodes = 64;  ///< read at once; each may be decoded by a thread

}  // namespace

LasPointReader::LasPointReader(const std::filesystem::path& path, const PointWindow& window,
                               OtherCoordinates other, unsigned fields)
    : file_(path,
            fields | LasChannel::lazFields(window.channel_field) |
                (window.extra_field.empty() ? 0U : kLazExtraBytes),
            window.keep_readable ? LasDamage::keep_intact : LasDamage::refuse),
      compatibility_(LasCompatibility::of(file_)),
      window_(window),
      info_(file_.info()) {
  if (other == OtherCoordinates::refuse) requireMapCoordinates(info_);
  if (compatibility_) info_.format += ", LAS 1.4 compatibility mode";
  if (LasChannel::lazFields(window.channel_field) != 0)
    channel_.emplace(file_, window.channel_field);
  if (!window.extra_field.empty())
    if (const auto* field =
            findLasExtraField(file_.extraFields(), window.extra_field, path.string()))
      extra_field_ = *field;
  const Eigen::Vector3d metres = info_.units.metres();
  scaling_ = {file_.header().scale.cwiseProduct(metres),
              file_.header().offset.cwiseProduct(metres)};
  LasWindow part;
  part.resolution = window.resolution / metres.x();
  if (window.bounds)
    part.bounds.emplace(window.bounds->min() / metres.x(), window.bounds->max() / metres.x());
  ranges_ = file_.recordsWithin(part);
  whole_ = window.everything() || (!file_.isCopc() && !window.keep_readable);
  if (window.keep_readable && ranges_.empty() && file_.header().point_count > 0)
    throw InputError(path.string() +
                     ": none of its points can be read: " + file_.intact().describe());
  info_ = within(window, info_);
  std::uint64_t candidates = 0;
  for (const LasRecordRange& range : ranges_) candidates += range.count;
  info_.point_count = std::min(info_.point_count, candidates);
}

void LasPointReader::fillExtra(PointChunk& chunk) {
  if (window_.extra_field.empty()) return;
  if (extra_field_)
    decodeLasExtraField(records(), chunk.size(), file_.header().record_length, *extra_field_,
                        chunk.extra);
  else
    chunk.extra.assign(chunk.size(), std::numeric_limits<double>::quiet_NaN());
}

std::string LasPointReader::damage() const {
  if (!window_.keep_readable || file_.intact().complete()) return {};
  return file_.path().string() + ": " + file_.intact().describe();
}

std::string LasPointReader::boxRemark(const Eigen::AlignedBox3d& points) const {
  const PointFileInfo stated = file_.info();
  if (!window_.everything() && headerBoxContains(stated, points)) return {};
  return headerBoxRemark(stated, points);
}

/// Moves the records inside the bounds to the front of the buffer; returns their number.
std::size_t LasPointReader::keepInside(std::size_t count) {
  const std::size_t length = file_.header().record_length;
  const Eigen::Vector2d scale = scaling_.scale.head<2>(), offset = scaling_.offset.head<2>();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* record = &buffer_[i * length];
    // As in decodeLasRecords(), so that the coordinates are compared that a reader sees.
    const Eigen::Vector2d place(LasRecordLayout::coordinateOf(record, 0) * scale.x() + offset.x(),
                                LasRecordLayout::coordinateOf(record, 1) * scale.y() + offset.y());
    if (!window_.bounds->contains(place)) continue;
    if (kept != i) std::memcpy(&buffer_[kept * length], record, length);
    ++kept;
  }
  return kept;
}

/// The next records of a file that is read as a whole.
std::size_t LasPointReader::readBlock() {
  const LasHeader& header = file_.header();
  // Records may have up to 64 kB; a block of those is shorter.
  const std::size_t most = std::min(kChunk, kMostBytes / header.record_length);
  const std::size_t count = std::min<std::uint64_t>(most, header.point_count - position_);
  buffer_.resize(count * header.record_length);
  file_.readRecords(position_, count, buffer_.data());
  position_ += count;
  return count;
}

/// The next nodes of an octree, enough of them for several threads.
std::size_t LasPointReader::readNodes() {
  const std::size_t length = file_.header().record_length;
  std::vector<LasRecordRange> nodes;
  std::size_t count = 0;
  const std::size_t most = kMostBytes / length;
  while (range_ < ranges_.size() && nodes.size() < kMostNodes) {
    LasRecordRange& next = ranges_[range_];
    if (count > 0 && next.count > most - count) break;
    // A node that is too large for the memory is read in pieces.
    const std::uint64_t part = std::min<std::uint64_t>(next.count, most);
    nodes.push_back({next.first, part});
    count += part;
    next = {next.first + part, next.count - part};
    if (next.count == 0) ++range_;
  }
  buffer_.resize(count * length);
  file_.readRanges(nodes, buffer_.data());
  return count;
}

/// Reads until there are records inside; false at the end.
bool LasPointReader::fetch() {
  held_ = next_ = 0;
  while (held_ == 0) {
    const std::size_t count = whole_ ? readBlock() : readNodes();
    if (count == 0) return false;
    held_ = window_.bounds ? keepInside(count) : count;
  }
  return true;
}

bool LasPointReader::read(PointChunk& chunk) {
  const bool more = next_ < held_ || fetch();
  given_ = next_;
  next_ = more ? std::min(held_, given_ + kChunk) : given_;
  decodeLasRecords(records(), next_ - given_, file_.header().record_length, file_.layout(),
                   scaling_.scale, scaling_.offset, chunk);
  if (compatibility_) compatibility_->restore(records(), file_.header().record_length, chunk);
  if (channel_)
    channel_->decode(records(), chunk.size(), file_.header().record_length, chunk.channel.data());
  fillExtra(chunk);
  return more;
}

}  // namespace pcl_als
