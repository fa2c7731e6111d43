// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>

namespace pcl_als {
namespace {

/// Bits spread so that neighbouring cells are chosen independently.
std::uint64_t mixed(std::uint64_t key) {
  key ^= key >> 33U;
  key *= 0xFF51AFD7ED558CCDULL;
  key ^= key >> 33U;
  key *= 0xC4CEB9FE1A85EC53ULL;
  return key ^ key >> 33U;
}

std::int32_t columnOf(std::uint64_t key) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(key));
}
std::int32_t rowOf(std::uint64_t key) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(key >> 32U));
}

bool isSmooth(const CellSums& sums, const SmoothCellSettings& settings) {
  if (sums.points < settings.least_points) return false;
  const double n = sums.points;
  if (sums.excluded > settings.most_excluded * (n + sums.excluded)) return false;
  if (sums.normal.norm() < settings.least_coherence * n) return false;
  const double mean = sums.intensity / n;
  const double variance = std::max(0.0, sums.intensity_sq / n - mean * mean);
  return variance <= std::pow(settings.most_variation * mean, 2);
}

void mergeInto(std::vector<CellSums>& strips, const CellSums& sums) {
  auto at = std::lower_bound(strips.begin(), strips.end(), sums.strip,
                             [](const CellSums& s, int strip) { return s.strip < strip; });
  if (at == strips.end() || at->strip != sums.strip) {
    strips.insert(at, sums);
    return;
  }
  at->points += sums.points;
  at->excluded += sums.excluded;
  at->intensity += sums.intensity;
  at->intensity_sq += sums.intensity_sq;
  at->range += sums.range;
  at->beam += sums.beam;
  at->normal += sums.normal;
}

/// The strips of a cell that agree on its normal; fewer than two: none.
std::vector<SharedCell::View> viewsOf(const std::vector<CellSums>& strips,
                                      const SmoothCellSettings& settings) {
  std::vector<const CellSums*> smooth;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const CellSums& sums : strips) {
    if (!isSmooth(sums, settings)) continue;
    smooth.push_back(&sums);
    normal += sums.normal;
  }
  std::vector<SharedCell::View> views;
  if (smooth.size() < 2) return views;
  normal.normalize();
  const double least = std::cos(settings.most_turn * kRadiansPerDegree);
  for (const CellSums* sums : smooth) {
    if (sums->normal.normalized().dot(normal) < least) continue;
    const double n = sums->points;
    const double cosine = std::abs(normal.dot(sums->beam.normalized()));
    views.push_back({sums->strip, n, sums->intensity / n, sums->range / n, cosine});
  }
  if (views.size() < 2) views.clear();
  return views;
}

}  // namespace

RadiometricCells::RadiometricCells(double size, std::uint32_t one_in)
    : size_(size), one_in_(one_in) {
  if (!std::isfinite(size) || size <= 0.0) throw UsageError("radiometric cells: size must be > 0");
  if (one_in == 0) throw UsageError("radiometric cells: one in 0 is none");
}

std::uint64_t RadiometricCells::keyOf(double x, double y, double size) {
  const auto column = static_cast<std::int32_t>(std::floor(x / size));
  const auto row = static_cast<std::int32_t>(std::floor(y / size));
  return std::uint64_t{static_cast<std::uint32_t>(row)} << 32U | static_cast<std::uint32_t>(column);
}

bool RadiometricCells::wants(double x, double y) const {
  return one_in_ == 1 || mixed(keyOf(x, y, size_)) % one_in_ == 0;
}

void RadiometricCells::add(int strip, double x, double y, double intensity, bool usable,
                           const PointRadiometry& point, const LocalSurface& surface) {
  if (!wants(x, y) || !point.corrected()) return;
  CellSums sums;
  sums.strip = strip;
  if (!usable || point.status != RadiometryStatus::surface) {
    sums.excluded = 1;
  } else {
    sums.points = 1;
    sums.intensity = intensity;
    sums.intensity_sq = intensity * intensity;
    sums.range = point.range;
    sums.beam = point.beam.cast<double>();
    sums.normal = surface.normal.cast<double>();
  }
  mergeInto(cells_[keyOf(x, y, size_)], sums);
}

void RadiometricCells::merge(const RadiometricCells& other) {
  for (const auto& [key, strips] : other.cells_) {
    std::vector<CellSums>& mine = cells_[key];
    for (const CellSums& sums : strips) mergeInto(mine, sums);
  }
}

std::vector<SharedCell> RadiometricCells::shared(const SmoothCellSettings& settings) const {
  std::vector<SharedCell> cells;
  for (const auto& [key, strips] : cells_) {
    if (strips.size() < 2) continue;
    std::vector<SharedCell::View> views = viewsOf(strips, settings);
    if (!views.empty()) cells.push_back({columnOf(key), rowOf(key), std::move(views)});
  }
  std::sort(cells.begin(), cells.end(), [](const SharedCell& a, const SharedCell& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  return cells;
}

CellVariation variationOf(const std::vector<SharedCell>& cells, const RadiometricModel* model,
                          const std::vector<double>& gains) {
  std::vector<double> variations;
  double sum_sq = 0.0;
  for (const SharedCell& cell : cells) {
    double sum = 0.0, squares = 0.0;
    for (const SharedCell::View& view : cell.views) {
      double value = view.intensity;
      if (model != nullptr) value *= model->factor(view.range, view.cosine);
      if (!gains.empty()) value /= gains[static_cast<std::size_t>(view.strip)];
      sum += value;
      squares += value * value;
    }
    const auto n = static_cast<double>(cell.views.size());
    const double mean = sum / n;
    const double variance = std::max(0.0, (squares - n * mean * mean) / (n - 1.0));
    variations.push_back(std::sqrt(variance) / mean);
    sum_sq += variance / (mean * mean);
  }
  CellVariation result;
  result.cells = variations.size();
  if (variations.empty()) return result;
  std::sort(variations.begin(), variations.end());
  result.median = variations[variations.size() / 2];
  result.p90 = variations[variations.size() * 9 / 10];
  result.rms = std::sqrt(sum_sq / static_cast<double>(variations.size()));
  return result;
}

void RadiometricCells::put(ByteWriter& out) const {
  out.putMap(cells_, [](ByteWriter& o, const std::vector<CellSums>& cell) { o.putPlain(cell); });
}

void RadiometricCells::get(ByteReader& in) {
  in.getMap(cells_, [](ByteReader& i, std::vector<CellSums>& cell) { i.getPlain(cell); });
}

}  // namespace pcl_als
