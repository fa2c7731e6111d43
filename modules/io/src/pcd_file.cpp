// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pcd_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/time_alignment.h>

#include "ply_header.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

PcdHeader readHeader(const InputFile& file) {
  std::string text(std::min<std::uint64_t>(kLongestHeader, file.size()), '\0');
  file.read(0, text.size(), text.data());
  return lowerExtension(file.name()) == ".ply" ? parsePlyHeader(text, file.size(), file.name())
                                               : parsePcdHeader(text, file.size(), file.name());
}

template <typename T>
double elementAs(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

/// Reads one element of a field as double.
using Element = double (*)(const std::byte*);

Element elementOf(const PcdField& field) {
  if (field.type == 'F') return field.size == 4 ? elementAs<float> : elementAs<double>;
  const bool with_sign = field.type == 'I';
  switch (field.size) {
    case 1:
      return with_sign ? elementAs<std::int8_t> : elementAs<std::uint8_t>;
    case 2:
      return with_sign ? elementAs<std::int16_t> : elementAs<std::uint16_t>;
    case 4:
      return with_sign ? elementAs<std::int32_t> : elementAs<std::uint32_t>;
    default:
      return with_sign ? elementAs<std::int64_t> : elementAs<std::uint64_t>;
  }
}

/// Whether bytes that are no time were taken for one: a number of seconds beyond any clock, or next
/// to nothing.
bool isNoTime(double time) {
  constexpr double kLargest = 1e12, kLeast = 1e-100;
  return std::abs(time) > kLargest || (time != 0.0 && std::abs(time) < kLeast);
}

/** Whether the upper half of a double is the float of the field behind it.
 *
 * pcl::VoxelGrid of pcl::PCLPointCloud2 holds one float for every field. It stores as many bytes of
 * them as the field has: for a double that of the next field, too, whose mean decides what the
 * time seems to be. With intensities of some tens these are times that could be true. In text both
 * are rounded, the half by one step at most, the float by some.
 */
bool endsWithNext(const std::byte* time, const std::byte* next) {
  constexpr std::uint32_t kRounding = 16;
  std::uint64_t bits = 0;
  std::uint32_t value = 0;
  std::memcpy(&bits, time, sizeof bits);
  std::memcpy(&value, next, sizeof value);
  const auto upper = static_cast<std::uint32_t>(bits >> 32U);
  return upper != 0 && value != 0 && std::max(upper, value) - std::min(upper, value) <= kRounding;
}

/// A block of packed records of one file.
struct Block {
  const PcdHeader& header;
  const std::byte* records;
  std::size_t count;
  const std::string& file;

  /// Fills a column from the field that holds it, or with \a missing where the file has none.
  template <typename T>
  void column(const char* name, T missing, std::vector<T>& out) const {
    fill(header.find(name), missing, out);
  }
  template <typename T>
  void fill(const PcdField* field, T missing, std::vector<T>& out) const {
    out.assign(count, missing);
    if (field == nullptr || count == 0) return;  // without points, records may be null
    const Element element = elementOf(*field);
    const std::byte* at = records + field->offset;
    for (std::size_t i = 0; i < count; ++i, at += header.record_length)
      out[i] = fitting<T>(element(at), *field);
  }

  /// Number of times that are averages of bytes, or no times at all.
  std::size_t countNoTimes() const {
    const PcdField* time = header.find("gps_time");
    if (time == nullptr) return 0;
    const Element element = elementOf(*time);
    const PcdField* next = header.following(*time);
    if (next != nullptr && (time->type != 'F' || next->type != 'F' || next->size != sizeof(float)))
      next = nullptr;
    std::size_t found = 0;
    for (const std::byte *at = records, *end = at + count * header.record_length; at != end;
         at += header.record_length)
      if (isNoTime(secondsOfTime(element(at + time->offset))) ||
          (next != nullptr && endsWithNext(at + time->offset, at + next->offset)))
        ++found;
    return found;
  }

 private:
  template <typename T>
  T fitting(double value, const PcdField& field) const {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
    // The same bytes under a signed type, as lasR writes point source ids above 32767.
    if (value < 0.0 && field.type == 'I' && field.size == sizeof(T))
      value += 1.0 + static_cast<double>(std::numeric_limits<T>::max());
    if (value >= 0.0 && value <= static_cast<double>(std::numeric_limits<T>::max()))
      return static_cast<T>(value);
    throw InputError(file + ": field " + field.name + " holds " + std::to_string(value) +
                     ", which is out of its range (0 to " +
                     std::to_string(std::numeric_limits<T>::max()) + ")");
  }
};

constexpr std::size_t kMostNamed = 20;

template <typename T>
void keepOnly(const std::vector<std::size_t>& rows, std::vector<T>& column) {
  for (std::size_t i = 0; i < rows.size(); ++i) column[i] = column[rows[i]];
}

void dropInvalid(PointChunk& chunk) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < chunk.size(); ++i)
    if (std::isfinite(chunk.x[i]) && std::isfinite(chunk.y[i]) && std::isfinite(chunk.z[i]))
      rows.push_back(i);
  if (rows.size() == chunk.size()) return;
  for (auto* column : {&chunk.x, &chunk.y, &chunk.z, &chunk.gps_time}) keepOnly(rows, *column);
  for (auto* column : {&chunk.intensity, &chunk.scan_angle}) keepOnly(rows, *column);
  keepOnly(rows, chunk.point_source_id);
  for (auto* column : {&chunk.return_number, &chunk.number_of_returns, &chunk.classification,
                       &chunk.flags, &chunk.user_data, &chunk.channel})
    keepOnly(rows, *column);
  chunk.resize(rows.size());
}

}  // namespace

PcdFile::PcdFile(const std::filesystem::path& path, const std::string& channel_field)
    : file_(path),
      header_(readHeader(file_)),
      channel_field_(channel_field == "scanner_channel" ? "" : channel_field) {
  checkFields();
  readFirst();
  rewind();
}

PcdFile::~PcdFile() = default;

void PcdFile::checkFields() const {
  for (const char* axis : {"x", "y", "z"}) {
    const PcdField* field = header_.find(axis);
    if (field == nullptr || field->type != 'F')
      throw InputError(file_.name() + ": the " + header_.kind + " has no field " + axis +
                       " of type F");
  }
  const PcdField* time = header_.find("gps_time");
  if (time != nullptr && time->size != 8)
    throw InputError(file_.name() + ": the " + header_.kind + "'s gps_time is of " +
                     std::to_string(time->size) +
                     " bytes, not of 8 (double); a float of week seconds has steps of 0.03 s, two "
                     "metres of flight");
  if (channel_field_.empty() || header_.named(channel_field_) != nullptr) return;
  std::string names;
  for (const PcdField& field : header_.fields) names += (names.empty() ? "" : ", ") + field.name;
  throw InputError(file_.name() + ": has no field '" + channel_field_ +
                   "' with the channel of the scanner; it has " + names);
}

/// What the first points show of VIEWPOINT and times.
void PcdFile::readFirst() {
  constexpr std::size_t kSampledPoints = 4096;
  constexpr double kFarthestSensor = 1e4;  // metres from the origin of a local system, in plan
  rewind();
  PointChunk chunk;
  while (chunk.size() == 0 && read(kSampledPoints, chunk)) {
  }
  const Block block{header_, buffer_.data(), buffer_.size() / header_.record_length, file_.name()};
  times_are_averages_ = 2 * block.countNoTimes() > block.count;
  time_units_ = 1.0;  // those of averages are none
  origin_.setZero();
  const Eigen::Vector3d& viewpoint = header_.viewpoint;
  const bool far = viewpoint.head<2>().norm() > kFarthestSensor && !header_.rotated &&
                   header_.find("x")->size == 4 && chunk.size() > 0 &&
                   std::hypot(chunk.x[0], chunk.y[0]) <
                       std::hypot(chunk.x[0] - viewpoint.x(), chunk.y[0] - viewpoint.y());
  if (header_.of_pcl_als || far) origin_ = viewpoint;
}

std::string PcdFile::timeFault() const {
  if (!times_are_averages_) return header_.time_fault;
  return "its GPS times are not used, they are averages of bytes: pcl_voxel_grid makes them of "
         "double fields; thin the original with pcl::VoxelGrid<PointLidar> or "
         "pcl::UniformSampling, which keep times";
}

std::vector<std::string> PcdFile::remarks() const {
  std::vector<std::string> remarks;
  const PcdField* channel = channel_field_.empty() ? nullptr : header_.named(channel_field_);
  const std::vector<std::string> unused = header_.unusedFields(channel);
  if (!unused.empty())
    remarks.push_back(
        (unused.size() == 1 ? "its field is not used: " : "its fields are not used: ") +
        listedNames(unused, kMostNamed));
  if (!header_.of_pcl_als && !header_.viewpoint.isZero())
    remarks.emplace_back(origin_.isZero()
                             ? "its VIEWPOINT is the pose of the sensor, as PCL defines it: it is "
                               "not added to the coordinates"
                             : "its VIEWPOINT is taken as the origin of the coordinates, from "
                               "which no sensor would see them");
  if (!header_.other_elements.empty())
    remarks.push_back("only its vertices are read, not its elements " +
                      listedNames(header_.other_elements, kMostNamed));
  if (!timeFault().empty()) remarks.push_back(timeFault());
  return remarks;
}

void PcdFile::rewind() {
  records_ = openPcdRecords(file_, header_);
  position_ = 0;
}

double PcdFile::relativeStep() const {
  const auto single = [this](const char* axis) { return header_.find(axis)->size == 4; };
  return std::ldexp(1.0, single("x") || single("y") || single("z") ? -23 : -52);
}

bool PcdFile::read(std::size_t records, PointChunk& chunk) {
  const std::size_t count = std::min<std::uint64_t>(records, header_.points - position_);
  buffer_.resize(count * header_.record_length);
  if (count > 0) records_->next(count, buffer_.data());
  position_ += count;
  fill(buffer_.data(), count, chunk);
  dropInvalid(chunk);
  return count > 0;
}

void PcdFile::fill(const std::byte* records, std::size_t count, PointChunk& chunk) {
  const Block block{header_, records, count, file_.name()};
  block.column("x", 0.0, chunk.x);
  block.column("y", 0.0, chunk.y);
  block.column("z", 0.0, chunk.z);
  block.column("gps_time", 0.0, chunk.gps_time);
  for (double& time : chunk.gps_time) {
    if (times_are_averages_) time = 0.0;
    time_units_ = std::max(time_units_, timeUnitsPerSecond(time));
    time = secondsOfTime(time);
  }
  block.column("intensity", 0.0F, chunk.intensity);
  block.column("scan_angle", 0.0F, chunk.scan_angle);
  block.column("point_source_id", std::uint16_t{0}, chunk.point_source_id);
  block.column("return_number", std::uint8_t{1}, chunk.return_number);
  block.column("number_of_returns", std::uint8_t{1}, chunk.number_of_returns);
  block.column("classification", std::uint8_t{0}, chunk.classification);
  block.column("flags", std::uint8_t{0}, chunk.flags);
  block.column("user_data", std::uint8_t{0}, chunk.user_data);
  if (channel_field_.empty()) {
    chunk.channel = chunk.flags;
    for (std::uint8_t& channel : chunk.channel) channel = channel >> 6U;
  } else {
    block.fill(header_.named(channel_field_), std::uint8_t{0}, chunk.channel);
  }
}

}  // namespace pcl_als::detail
