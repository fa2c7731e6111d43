// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/integer_bias_correction.h>

namespace pcl_als {
namespace {

using Column = std::array<double, IntegerBiasCorrection::kTile>;
using IntegerColumn = std::array<std::int32_t, IntegerBiasCorrection::kTile>;

/// Adding 1.5 * 2^52 to a double below 2^51 leaves it no bits for a fraction: it is rounded to the
/// nearest integer, which stands in its low bits. std::nearbyint and a conversion to int64 would be
/// calls per value on the SSE2 baseline.
constexpr double kShift = 6755399441055744.0;
constexpr std::uint64_t kShiftBits = 0x4338000000000000;

/// 0 for a whole number that fits an int32; its integer value is \a integer then.
inline std::uint64_t toInteger(double value, std::int32_t& integer) {
  const double shifted = value + kShift;
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  const std::uint64_t from_lowest = bits - kShiftBits + (std::uint64_t{1} << 31);
  integer = static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
  return from_lowest >> 32;
}

/// metres = raw * scale + offset
void toMetres(const IntegerColumn& raw, double scale, double offset, Column& metres,
              std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) metres[i] = raw[i] * scale + offset;
}

/// Moves raw values by changes, rounded: \a change becomes the results, and so does \a raw where
/// all fit an int32; false else.
bool move(double steps_per_metre, Column& change, IntegerColumn& raw, std::size_t count) {
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double steps = (change[i] * steps_per_metre + kShift) - kShift;
    const double value = raw[i] + steps;
    change[i] = value;
    outside |= toInteger(value, raw[i]);
  }
  return outside == 0;
}

}  // namespace

struct IntegerBiasCorrection::Tile {
  IntegerColumn raw[3];
  Column time, x, y, z, change[3];
  std::array<float, kTile> intensity;
  std::array<std::int8_t, kTile> scan_direction;
  std::array<std::uint16_t, kTile> source;
  std::array<std::uint8_t, kTile> channel;
};

IntegerBiasCorrection::Layout IntegerBiasCorrection::Layout::of(const LasFile& file,
                                                                const SystemLookup& systems) {
  Layout layout;
  layout.record_length = file.header().record_length;
  layout.fields = file.layout();
  layout.metres = file.toMetres();
  if (!systems.channelField().empty()) layout.channel = LasChannel(file, systems.channelField());
  return layout;
}

IntegerBiasCorrection::IntegerBiasCorrection(std::string name, SystemCorrection correction,
                                             const Layout& layout)
    : name_(std::move(name)), correction_(std::move(correction)), layout_(layout) {
  const Eigen::Vector3d& scale = layout_.metres.scale;
  if (!(scale.cwiseAbs().minCoeff() >= 1e-9) || !scale.allFinite()) {
    throw InputError(name_ + ": the scale of its coordinates is not a number of 1e-9 m or more");
  }
  const std::string objection = correction_.systems().objection(true, layout_.channel.recorded());
  if (!objection.empty()) throw InputError(name_ + ": " + objection);
}

void IntegerBiasCorrection::gather(const std::byte* records, std::size_t count, Tile& tile) const {
  const LasRecordLayout& fields = layout_.fields;
  const std::byte* record = records;
  for (std::size_t i = 0; i < count; ++i, record += layout_.record_length) {
    for (int axis = 0; axis < 3; ++axis)
      tile.raw[axis][i] = LasRecordLayout::coordinateOf(record, axis);
    tile.time[i] = fields.timeOf(record);
    tile.intensity[i] = fields.intensityOf(record);
    tile.source[i] = fields.sourceOf(record);
    tile.scan_direction[i] = fields.scanDirectionOf(record) ? -1 : 1;
  }
  const auto& [scale, offset] = layout_.metres;
  toMetres(tile.raw[0], scale.x(), offset.x(), tile.x, count);
  toMetres(tile.raw[1], scale.y(), offset.y(), tile.y, count);
  toMetres(tile.raw[2], scale.z(), offset.z(), tile.z, count);
  if (layout_.channel.recorded())
    layout_.channel.decode(records, count, layout_.record_length, tile.channel.data());
  if (correction_.timeAlignment().identity()) return;
  for (std::size_t i = 0; i < count; ++i) tile.time[i] = correction_.flightTime(tile.time[i]);
}

void IntegerBiasCorrection::scatter(std::byte* records, std::size_t count, std::uint64_t first,
                                    Tile& tile) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!move(1.0 / layout_.metres.scale[axis], tile.change[axis], tile.raw[axis], count)) {
      refuseOverflow(tile.change[axis].data(), first, axis);
    }
  }
  for (std::size_t i = 0; i < count; ++i, records += layout_.record_length) {
    for (int axis = 0; axis < 3; ++axis)
      LasRecordLayout::storeCoordinate(tile.raw[axis][i], axis, records);
  }
}

void IntegerBiasCorrection::refuseOverflow(const double* values, std::uint64_t first,
                                           int axis) const {
  std::size_t i = 0;
  for (std::int32_t ignored = 0; toInteger(values[i], ignored) == 0;) ++i;
  char text[200];
  std::snprintf(text, sizeof text,
                ": point %ju: %c = %.0f units of %g m after the correction does not fit 32 bits; "
                "give the file a coarser scale or a nearer offset",
                std::uintmax_t{first + i}, "xyz"[axis], values[i], layout_.metres.scale[axis]);
  throw InputError(name_ + text);
}

CoverageCount IntegerBiasCorrection::apply(std::byte* records, std::size_t count,
                                           std::uint64_t first) const {
  CoverageCount coverage;
  Tile tile;
  const PointColumns points{
      tile.time.data(),      tile.x.data(),
      tile.y.data(),         tile.z.data(),
      tile.intensity.data(), tile.scan_direction.data(),
      tile.source.data(),    layout_.channel.recorded() ? tile.channel.data() : nullptr};
  const EffectColumns change{tile.change[0].data(), tile.change[1].data(), tile.change[2].data()};
  for (std::size_t at = 0; at < count; at += kTile) {
    const std::size_t size = std::min(kTile, count - at);
    std::byte* tile_records = records + at * layout_.record_length;
    gather(tile_records, size, tile);
    correction_.change(points, size, change, coverage);
    scatter(tile_records, size, first + at, tile);
  }
  return coverage;
}

}  // namespace pcl_als
