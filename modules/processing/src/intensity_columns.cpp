// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_columns.h"

#include <algorithm>
#include <array>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/common/vector_clones.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {
namespace {

constexpr std::size_t kTile = 256;  ///< points whose columns fit the first-level cache

using Column = std::array<double, kTile>;
using IntegerColumn = std::array<std::int32_t, kTile>;

ALS_VECTOR_CLONES void toMetres(const std::int32_t* raw, double scale, double offset,
                                std::size_t count, double* metres) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) metres[i] = raw[i] * scale + offset;
}

struct ValueColumns {
  const std::int32_t* given;
  const double *factor, *divisor, *range;
};

struct RoundedCounts {
  std::uint64_t zeros = 0, saturated = 0, clipped = 0, under_half = 0;
};

/// Digital numbers, and what they hide. No value is negative.
ALS_VECTOR_CLONES RoundedCounts roundColumns(const ValueColumns& values, double scale,
                                             double saturation, std::size_t count,
                                             std::int32_t* stored) {
  const std::int32_t* const all_given = values.given;
  const double *factor = values.factor, *divisor = values.divisor, *range = values.range;
  std::uint64_t zeros = 0, saturated = 0, clipped = 0, under_half = 0;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double given = all_given[i];
    const double corrected = scale * (given * factor[i] / divisor[i]);
    const double value = range[i] == range[i] ? corrected : given;
    zeros += given == 0.0 ? 1U : 0U;
    saturated += given >= saturation ? 1U : 0U;
    clipped += value > kLargestIntensity ? 1U : 0U;
    under_half += value < 0.5 ? 1U : 0U;
    // As std::lround, which would be a call per value.
    const double from_half = 0.5 + (value < kLargestIntensity ? value : kLargestIntensity);
    stored[i] = static_cast<std::int32_t>(from_half);
  }
  return {zeros, saturated, clipped, under_half};
}

std::uint64_t& countOf(IntensityCounts& counts, RadiometryStatus status) {
  return counts.status[static_cast<std::size_t>(status)];
}

}  // namespace

struct RangeOnlyCorrection::Tile {
  IntegerColumn raw[3], given, stored;
  std::array<std::uint16_t, kTile> source;
  std::array<std::uint8_t, kTile> partial;  ///< 1: not the last return of its pulse
  Column time, x, y, z, divisor, range, factor;
};

bool RangeOnlyCorrection::serves(const IntensitySettings& settings, const IntensityOutput& output) {
  return !settings.find_surfaces && !settings.statistics && settings.gain_control.empty() &&
         !settings.echo_energy && !output.extra_fields;
}

RangeOnlyCorrection::RangeOnlyCorrection(const IntensityRun& run, std::size_t file, double scale,
                                         std::ptrdiff_t original_at)
    : evaluator_(run.trajectory(), run.model()),
      alignment_(run.timeAlignment(file)),
      layout_(run.input(file).las()->layout()),
      metres_per_step_(run.input(file).las()->toMetres().scale),
      offset_(run.input(file).las()->toMetres().offset),
      scale_(scale),
      saturation_(run.saturation()),
      run_(run),
      file_(file),
      original_at_(original_at) {
  StripAssignment::Assigner sorter(run.arrangement(), file);
  for (const PointSource& source : run.sources(file).sources) {
    const std::size_t label = sorter.label(source.id, source.first_time);
    sources_[source.id] = {run.gain(run.arrangement().labels()[label].index), label};
  }
}

std::uint64_t RangeOnlyCorrection::gather(const std::byte* records, std::size_t length,
                                          std::size_t count, Tile& tile) const {
  const LasRecordLayout layout = layout_;  // in registers: stores to the tile may not change it
  std::uint64_t partial = 0;
  for (std::size_t i = 0; i < count; ++i, records += length) {
    for (int axis = 0; axis < 3; ++axis)
      tile.raw[axis][i] = LasRecordLayout::coordinateOf(records, axis);
    tile.given[i] = LasRecordLayout::intensityOf(records);
    tile.source[i] = layout.sourceOf(records);
    tile.time[i] = layout.timeOf(records);
    tile.partial[i] = layout.returnNumberOf(records) < layout.numberOfReturnsOf(records) ? 1 : 0;
    partial += tile.partial[i];
  }
  toMetres(tile.raw[0].data(), metres_per_step_.x(), offset_.x(), count, tile.x.data());
  toMetres(tile.raw[1].data(), metres_per_step_.y(), offset_.y(), count, tile.y.data());
  toMetres(tile.raw[2].data(), metres_per_step_.z(), offset_.z(), count, tile.z.data());
  if (alignment_.identity()) return partial;
  for (std::size_t i = 0; i < count; ++i) tile.time[i] = alignment_(tile.time[i]);
  return partial;
}

/// The map is asked when the strip changes.
void RangeOnlyCorrection::setDivisors(std::size_t count, Tile& tile,
                                      IntensityCounts& counts) const {
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const std::uint16_t id = tile.source[first];
    const Source& source = sources_.at(id);
    for (; last < count && tile.source[last] == id; ++last) tile.divisor[last] = source.divisor;
    counts.labels[source.label] += last - first;
  }
}

void RangeOnlyCorrection::countUncovered(std::size_t count, const std::byte* records,
                                         std::size_t length, const Tile& tile,
                                         IntensityCounts& counts) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (tile.range[i] == tile.range[i] ||
        run_.trajectory()->coverage(tile.time[i]) == Trajectory::Coverage::covered)
      continue;
    const double time = layout_.timeOf(records + i * length);
    ++counts.uncovered[{sources_.at(tile.source[i]).label, run_.whyUncovered(file_, time)}];
  }
}

void RangeOnlyCorrection::round(std::size_t count, Tile& tile, IntensityCounts& counts) const {
  const RoundedCounts found =
      roundColumns({tile.given.data(), tile.factor.data(), tile.divisor.data(), tile.range.data()},
                   scale_, saturation_, count, tile.stored.data());
  counts.zeros += found.zeros;
  counts.saturated += found.saturated;
  counts.clipped += found.clipped;
  counts.rounded_to_zero += found.under_half - found.zeros;  // a zero stays one
}

void RangeOnlyCorrection::scatter(std::byte* records, std::size_t length, std::size_t count,
                                  const Tile& tile) const {
  for (std::size_t i = 0; i < count; ++i)
    LasRecordLayout::storeIntensity(static_cast<std::uint16_t>(tile.stored[i]),
                                    records + i * length);
  if (original_at_ < 0) return;
  records += original_at_;
  for (std::size_t i = 0; i < count; ++i)
    storeLas(records + i * length, static_cast<std::uint16_t>(tile.given[i]));
}

IntensityCounts RangeOnlyCorrection::apply(const LasRecordBlock& block) const {
  IntensityCounts counts;
  counts.labels.resize(run_.arrangement().labels().size());
  Tile tile;
  RadiometryCursor cursor;
  for (std::size_t at = 0; at < block.count; at += kTile) {
    const std::size_t size = std::min(kTile, block.count - at);
    std::byte* records = block.records + at * block.record_length;
    std::uint64_t partial = gather(records, block.record_length, size, tile);
    setDivisors(size, tile, counts);
    const RangeCounts left =
        evaluator_.evaluateRanges({tile.time.data(), tile.x.data(), tile.y.data(), tile.z.data()},
                                  size, {tile.range.data(), tile.factor.data()}, cursor);
    if (left.uncovered > 0) countUncovered(size, records, block.record_length, tile, counts);
    round(size, tile, counts);
    scatter(records, block.record_length, size, tile);
    const std::uint64_t corrected = size - left.uncovered - left.above_sensor;
    for (std::size_t i = 0; corrected < size && i < size; ++i)
      if (tile.range[i] != tile.range[i]) partial -= tile.partial[i];
    countOf(counts, RadiometryStatus::uncovered) += left.uncovered;
    countOf(counts, RadiometryStatus::above_sensor) += left.above_sensor;
    countOf(counts, RadiometryStatus::partial) += partial;
    countOf(counts, RadiometryStatus::no_surface) += corrected - partial;
  }
  counts.points = block.count;
  return counts;
}

}  // namespace pcl_als
