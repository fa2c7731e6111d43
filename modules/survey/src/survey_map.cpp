// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {
namespace {

// Coordinates of a survey are multiples of its file's scale, so points lie exactly on cell borders
// that are counted from one of them. Borders a fraction of a millimetre aside keep a point's cell
// the same when the whole block moves.
constexpr double kTieBreakingOffset = 0.00037;

constexpr int kGroup = 4;  // areas per side of the groups that selectAreas spreads over

std::int64_t packed(std::int32_t ix, std::int32_t iy) {
  return (iy * (std::int64_t{1} << 32)) | static_cast<std::uint32_t>(ix);
}
std::int32_t columnOf(std::int64_t key) {
  return static_cast<std::int32_t>(key & 0xffffffff);
}
std::int32_t rowOf(std::int64_t key) {
  return static_cast<std::int32_t>(key >> 32);
}
std::int32_t floorDiv(std::int32_t a, std::int32_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}
std::int64_t coarser(std::int64_t key, int factor) {
  return packed(floorDiv(columnOf(key), factor), floorDiv(rowOf(key), factor));
}

}  // namespace

bool isSurfacePoint(const LidarReturn& point) {
  return point.isLast() && !point.isVegetation() && !point.isNoise() && !point.isWithheld();
}

SurveyMap::SurveyMap(const Eigen::Vector2d& anchor)
    : anchor_(anchor - Eigen::Vector2d::Constant(kTieBreakingOffset)) {}

int SurveyMap::addStrip() {
  strips_.emplace_back();
  strips_.back().start = std::numeric_limits<double>::infinity();
  strips_.back().end = -std::numeric_limits<double>::infinity();
  return static_cast<int>(strips_.size()) - 1;
}

int SurveyMap::addSurface() {
  const int index = addStrip();
  strips_.back().enough = 1;
  return index;
}

std::int64_t SurveyMap::keyOf(const Eigen::Vector3d& position) const {
  const double column = std::floor((position.x() - anchor_.x()) / kCell);
  const double row = std::floor((position.y() - anchor_.y()) / kCell);
  constexpr double kLimit = 1e9;  // far beyond the Earth: not a valid coordinate
  if (!(std::abs(column) < kLimit && std::abs(row) < kLimit))
    throw InputError("a point lies 10 000 000 km away");
  return packed(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
}

void SurveyMap::add(int index, const LidarReturn* points, std::size_t count) {
  StripCells& strip = strips_[static_cast<std::size_t>(index)];
  Cell* cell = nullptr;
  std::int64_t cell_key = 0;
  for (const LidarReturn* p = points; p != points + count; ++p) {
    if (!p->position.allFinite() || !std::isfinite(p->time)) {
      ++strip.invalid;
      continue;
    }
    const std::int64_t key = keyOf(p->position);
    if (cell == nullptr || key != cell_key) {
      cell = &strip.cells[key];
      cell_key = key;
    }
    ++strip.points;
    strip.start = std::min(strip.start, p->time);
    strip.end = std::max(strip.end, p->time);
    ++cell->points;
    if (!p->isSingle()) ++cell->multiple;
    if (!isSurfacePoint(*p)) continue;
    if (cell->last_returns++ == 0) cell->z_reference = cell->lowest = p->position.z();
    cell->lowest = std::min(cell->lowest, p->position.z());
    const double z = p->position.z() - cell->z_reference;
    cell->z_sum += z;
    cell->z_sq_sum += z * z;
  }
}

void SurveyMap::putStrip(int strip, ByteWriter& out) const {
  const StripCells& from = strips_[strip];
  out.put(from.points).put(from.invalid).put(from.start).put(from.end);
  out.put(from.cells.bucket_count());
  out.putMap(from.cells, [](ByteWriter& o, const Cell& cell) { o.put(cell); });
}

void SurveyMap::getStrip(int strip, ByteReader& in) {
  StripCells& to = strips_[strip];
  in.get(to.points).get(to.invalid).get(to.start).get(to.end);
  const auto buckets = in.take<std::size_t>();
  in.getHashed(to.cells, buckets, [](ByteReader& i, Cell& cell) { i.get(cell); });
}

bool SurveyMap::areCopies(int a, int b) const {
  const StripCells &one = strips_[static_cast<std::size_t>(a)],
                   &other = strips_[static_cast<std::size_t>(b)];
  if (one.points == 0 || one.points != other.points || one.start != other.start ||
      one.end != other.end || one.cells.size() != other.cells.size())
    return false;
  return std::all_of(one.cells.begin(), one.cells.end(), [&](const auto& entry) {
    const auto same = other.cells.find(entry.first);
    return same != other.cells.end() && same->second.points == entry.second.points;
  });
}

std::optional<double> SurveyMap::lowestAt(int strip, const Eigen::Vector3d& position) const {
  const auto& cells = strips_[static_cast<std::size_t>(strip)].cells;
  const auto cell = cells.find(keyOf(position));
  if (cell == cells.end() || cell->second.last_returns == 0) return std::nullopt;
  return cell->second.lowest;
}

Eigen::AlignedBox2d SurveyMap::boxOf(int strip) const {
  Eigen::AlignedBox2d box;
  for (const auto& [key, cell] : strips_[static_cast<std::size_t>(strip)].cells) {
    const Eigen::Vector2d corner = anchor_ + kCell * Eigen::Vector2d(columnOf(key), rowOf(key));
    box.extend(corner);
    box.extend(Eigen::Vector2d(corner + Eigen::Vector2d::Constant(kCell)));
  }
  return box;
}

std::vector<SurveyMap::Overlap> SurveyMap::overlaps(double minimum_area) const {
  // By cell and not by pair, because of a thousand strips few overlap.
  std::vector<std::pair<std::int64_t, int>> touched;
  for (std::size_t strip = 0; strip < strips_.size(); ++strip) {
    for (const auto& [key, cell] : strips_[strip].cells) {
      touched.emplace_back(key, static_cast<int>(strip));
    }
  }
  std::sort(touched.begin(), touched.end());
  std::map<StripPair, std::size_t> common;
  for (auto first = touched.begin(); first != touched.end();) {
    auto end = first;
    while (end != touched.end() && end->first == first->first) ++end;
    for (; first != end; ++first) {
      for (auto other = first + 1; other != end; ++other) ++common[{first->second, other->second}];
    }
  }
  std::vector<Overlap> found;
  for (const auto& [strips, cells] : common) {
    const double area = static_cast<double>(cells) * kCell * kCell;
    if (area >= minimum_area) found.push_back({strips, area});
  }
  return found;
}

SurveyMap::HeightOffset SurveyMap::heightOffset(const StripPair& pair) const {
  constexpr std::uint32_t kMinimumPoints = 5;
  constexpr std::size_t kFewestCells = 20;
  std::vector<double> differences;
  const StripCells& one = strips_[static_cast<std::size_t>(pair.first)];
  const StripCells& another = strips_[static_cast<std::size_t>(pair.second)];
  const auto& others = another.cells;
  for (const auto& [key, cell] : one.cells) {
    const auto other = others.find(key);
    if (other == others.end() || cell.last_returns < std::min(kMinimumPoints, one.enough) ||
        other->second.last_returns < std::min(kMinimumPoints, another.enough)) {
      continue;
    }
    differences.push_back(cell.lowest - other->second.lowest);
  }
  const std::size_t count = differences.size();
  if (count < kFewestCells) return {};
  return {medianInPlace(differences), count};
}

void SurveyMap::releaseCells() {
  for (StripCells& strip : strips_) strip.cells = {};
}

std::string describe(const SurveyMap::HeightOffset& height, const std::string& a,
                     const std::string& b) {
  char offset[48];
  std::snprintf(offset, sizeof offset, " lies %.2f m %s strip ", std::abs(height.offset),
                height.offset > 0.0 ? "above" : "below");
  return "strip " + a + offset + b + " (median of " + counted(height.cells, "cell") + " of " +
         shortText(SurveyMap::kCell) + " m)";
}

double SurveyMap::score(const StripCells& a, const Cell& in_a, const StripCells& b,
                        const Cell& in_b) {
  constexpr double kMostlySolid = 0.15;  // share of points of pulses with several returns
  constexpr double kFlat = 0.2;          // metres: flat ground is also used, for heights
  constexpr double kRelief = 2.0;        // metres: further relief has no advantage
  double relief = kRelief;
  for (const Cell* cell : {&in_a, &in_b}) {
    const std::uint32_t enough = (cell == &in_a ? a : b).enough;
    if (cell->last_returns < enough || cell->multiple > kMostlySolid * cell->points) return 0.0;
    const double mean = cell->z_sum / cell->last_returns;
    relief = std::min(relief,
                      std::sqrt(std::max(0.0, cell->z_sq_sum / cell->last_returns - mean * mean)));
  }
  return kFlat + relief;
}

namespace {

/// Areas of one pair of strips in the order of their choice.
std::vector<std::int64_t> ranked(const std::map<std::int64_t, double>& scores) {
  std::map<std::int64_t, std::vector<std::pair<double, std::int64_t>>> groups;
  for (const auto& [area, score] : scores) groups[coarser(area, kGroup)].emplace_back(-score, area);
  for (auto& [group, areas] : groups) std::sort(areas.begin(), areas.end());
  std::vector<std::int64_t> order;
  for (std::size_t round = 0; round < static_cast<std::size_t>(kGroup) * kGroup; ++round) {
    std::vector<std::pair<double, std::int64_t>> of_round;
    for (const auto& [group, areas] : groups) {
      if (round < areas.size()) of_round.push_back(areas[round]);
    }
    std::sort(of_round.begin(), of_round.end());
    for (const auto& entry : of_round) order.push_back(entry.second);
  }
  return order;
}

}  // namespace

std::vector<SurveyArea> SurveyMap::selectAreas(const std::vector<StripPair>& pairs,
                                               const AreaSelection& selection) const {
  const int cells_per_area =
      std::max(1, static_cast<int>(std::lround(selection.area_size / kCell)));
  const double size = cells_per_area * kCell;
  const double inflation =
      (size + 2.0 * selection.margin) * (size + 2.0 * selection.margin) / (size * size);
  std::map<std::int64_t, double>
      points_of;  // expected points of an area with its margin, all strips
  for (const StripCells& strip : strips_) {
    for (const auto& [key, cell] : strip.cells)
      points_of[coarser(key, cells_per_area)] += inflation * cell.points;
  }
  std::vector<std::vector<std::int64_t>> wishes;
  for (const StripPair& pair : pairs) {
    std::map<std::int64_t, double> scores;
    const StripCells &a = strips_[pair.first], &b = strips_[pair.second];
    for (const auto& [key, cell] : a.cells) {
      const auto other = b.cells.find(key);
      if (other == b.cells.end()) continue;
      const double gain = score(a, cell, b, other->second);
      if (gain > 0.0) scores[coarser(key, cells_per_area)] += gain;
    }
    wishes.push_back(ranked(scores));
  }
  std::set<std::int64_t> chosen;
  double budget = static_cast<double>(selection.point_budget);
  std::vector<std::size_t> next(wishes.size(), 0);
  for (bool any = true; any && budget > 0.0;) {
    any = false;
    for (std::size_t pair = 0; pair < wishes.size() && budget > 0.0; ++pair) {
      if (next[pair] >= wishes[pair].size()) continue;
      any = true;
      const std::int64_t area = wishes[pair][next[pair]++];
      if (chosen.insert(area).second) budget -= points_of[area];
    }
  }
  std::vector<SurveyArea> areas;
  for (const std::int64_t key : chosen) {
    areas.push_back(
        {anchor_ + size * Eigen::Vector2d(columnOf(key), rowOf(key)), size, selection.margin});
  }
  return areas;
}

}  // namespace pcl_als
