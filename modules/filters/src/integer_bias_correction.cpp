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

template <typename T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

constexpr double kLowest = -2147483648.0, kHighest = 2147483647.0;

/// Nearest integer, as a double, for magnitudes below 2^51: adding 1.5 * 2^52 leaves no bits for a
/// fraction. std::nearbyint would be a call per value on the SSE2 baseline.
inline double rounded(double value) {
  constexpr double kShift = 6755399441055744.0;
  return (value + kShift) - kShift;
}

/// steps = -sign * effect / scale, rounded.
void toSteps(Column& effect, double steps_per_metre, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) effect[i] = rounded(effect[i] * steps_per_metre);
}

}  // namespace

struct IntegerBiasCorrection::Tile {
  Column time, x, y, z, effect_x, effect_y, effect_z;
};

IntegerBiasCorrection::IntegerBiasCorrection(std::string name,
                                             std::shared_ptr<const BiasEvaluator> evaluator,
                                             const Layout& layout, TimeAlignment alignment,
                                             bool invert)
    : name_(std::move(name)),
      evaluator_(std::move(evaluator)),
      layout_(layout),
      alignment_(std::move(alignment)),
      invert_(invert) {
  if (!evaluator_) throw UsageError(name_ + ": no biases are set");
  // Effects stay far below 1e6 m; rounded() needs steps below 2^51.
  if (!(layout_.scale.minCoeff() >= 1e-9) || !layout_.scale.allFinite()) {
    throw InputError(name_ + ": the scale of its coordinates is not a number of 1e-9 m or more");
  }
}

void IntegerBiasCorrection::gather(const std::byte* records, std::size_t count, Tile& tile) const {
  const std::size_t length = layout_.record_length;
  const std::byte* time = records + layout_.time_position;
  const double scale_x = layout_.scale.x(), scale_y = layout_.scale.y(),
               scale_z = layout_.scale.z();
  const double offset_x = layout_.offset.x(), offset_y = layout_.offset.y(),
               offset_z = layout_.offset.z();
  for (std::size_t i = 0; i < count; ++i, records += length, time += length) {
    tile.time[i] = load<double>(time);
    tile.x[i] = load<std::int32_t>(records) * scale_x + offset_x;
    tile.y[i] = load<std::int32_t>(records + 4) * scale_y + offset_y;
    tile.z[i] = load<std::int32_t>(records + 8) * scale_z + offset_z;
  }
  if (alignment_.identity()) return;
  for (std::size_t i = 0; i < count; ++i) tile.time[i] = alignment_(tile.time[i]);
}

void IntegerBiasCorrection::scatter(std::byte* records, std::size_t count, std::uint64_t first,
                                    Tile& tile) const {
  const double sign = invert_ ? 1.0 : -1.0;
  Column* const effects[] = {&tile.effect_x, &tile.effect_y, &tile.effect_z};
  for (int axis = 0; axis < 3; ++axis) {
    Column& steps = *effects[axis];
    toSteps(steps, sign / layout_.scale[axis], count);
    std::byte* at = records + 4 * axis;
    bool fits = true;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = load<std::int32_t>(at + i * layout_.record_length) + steps[i];
      fits = fits && value >= kLowest && value <= kHighest;
    }
    if (!fits) refuseOverflow(records, count, first, axis, steps.data());
    for (std::size_t i = 0; i < count; ++i, at += layout_.record_length) {
      const auto value = static_cast<std::int32_t>(load<std::int32_t>(at) + steps[i]);
      std::memcpy(at, &value, sizeof value);
    }
  }
}

void IntegerBiasCorrection::refuseOverflow(const std::byte* records, std::size_t count,
                                           std::uint64_t first, int axis,
                                           const double* steps) const {
  std::size_t i = 0;
  double value = 0.0;
  for (; i < count; ++i) {
    value = load<std::int32_t>(records + i * layout_.record_length + 4 * axis) + steps[i];
    if (!(value >= kLowest && value <= kHighest)) break;
  }
  char text[200];
  std::snprintf(text, sizeof text,
                ": point %llu: %c = %.0f units of %g m after the correction does not fit 32 bits; "
                "give the file a coarser scale or a nearer offset",
                static_cast<unsigned long long>(first + i), "xyz"[axis], value,
                layout_.scale[axis]);
  throw InputError(name_ + text);
}

CoverageCount IntegerBiasCorrection::apply(std::byte* records, std::size_t count,
                                           std::uint64_t first) const {
  CoverageCount coverage;
  Tile tile;
  const PointColumns points{tile.time.data(), tile.x.data(), tile.y.data(), tile.z.data()};
  const EffectColumns effect{tile.effect_x.data(), tile.effect_y.data(), tile.effect_z.data()};
  for (std::size_t at = 0; at < count; at += kTile) {
    const std::size_t size = std::min(kTile, count - at);
    std::byte* tile_records = records + at * layout_.record_length;
    gather(tile_records, size, tile);
    if (invert_) {
      evaluator_->inverseEffect(points, size, effect, coverage);
    } else {
      evaluator_->effect(points, size, effect, coverage);
    }
    scatter(tile_records, size, first + at, tile);
  }
  return coverage;
}

}  // namespace pcl_als
