// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include <pcl_als/quality/swath_separation.h>

namespace pcl_als {
namespace {

constexpr float kStep = 0.5F;  // metres: a larger step in a cell is another surface
// metres, RMS of neighbours about their plane: rougher cells have no slope
constexpr float kUneven = 0.3F;
constexpr int kFewestNeighbours = 5;  // of nine, for a slope
constexpr float kShare = 0.5F;        // of the colour over the grey

std::int64_t keyOf(int block_column, int block_row) {
  return (block_row * (std::int64_t{1} << 32)) | static_cast<std::uint32_t>(block_column);
}

}  // namespace

SwathSeparation::SwathSeparation(RasterGrid grid, std::size_t strips)
    : grid_(std::move(grid)), strips_(strips) {}

void SwathSeparation::add(int index, const LidarReturn& point) {
  if (!isCheckable(point) || !point.isLast()) return;
  const long long column = grid_.columnOf(point.position.x());
  const long long row = grid_.rowOf(point.position.y());
  if (!grid_.holds(column, row)) return;
  StripBlocks& strip = strips_[static_cast<std::size_t>(index)];
  if (!strip.any) {
    strip.height = point.position.z();
    strip.any = true;
  }
  const auto c = static_cast<int>(column), r = static_cast<int>(row);
  const std::int64_t key = keyOf(c / kBlock, r / kBlock);
  if (strip.last == nullptr || key != strip.last_key) {
    Block& block = strip.blocks[key];
    if (block.empty()) block.resize(static_cast<std::size_t>(kBlock) * kBlock);
    strip.last = &block;
    strip.last_key = key;
  }
  Sum& sum = (*strip.last)[static_cast<std::size_t>(r % kBlock) * kBlock + c % kBlock];
  const Place place =
      (point.position - Eigen::Vector3d(grid_.centreX(c), grid_.centreY(r), strip.height))
          .cast<float>();
  if (sum.count == 0 || place.head<2>().squaredNorm() < sum.nearest.head<2>().squaredNorm())
    sum.nearest = place;
  sum.low = sum.count == 0 ? place.z() : std::min(sum.low, place.z());
  sum.high = sum.count == 0 ? place.z() : std::max(sum.high, place.z());
  const float share = 1.0F / static_cast<float>(++sum.count);
  sum.mean += (place - sum.mean) * share;
  sum.intensity += (point.intensity - sum.intensity) * share;
}

const SwathSeparation::Place& SwathSeparation::Sum::place() const {
  return high - low < kStep ? mean : nearest;
}

const SwathSeparation::Sum* SwathSeparation::at(const StripBlocks& strip, int column,
                                                int row) const {
  if (!grid_.holds(column, row)) return nullptr;
  const auto block = strip.blocks.find(keyOf(column / kBlock, row / kBlock));
  if (block == strip.blocks.end()) return nullptr;
  const Sum& sum = block->second[static_cast<std::size_t>(row % kBlock) * kBlock + column % kBlock];
  return sum.count == 0 ? nullptr : &sum;
}

float SwathSeparation::heightAtCentre(const StripBlocks& strip, int column, int row,
                                      const Sum& sum) const {
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  std::array<Eigen::Vector3f, 9> places;
  std::array<float, 9> heights{};
  std::size_t count = 0;
  const Place& own = sum.place();
  const auto cell = static_cast<float>(grid_.cell);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Sum* near = dx == 0 && dy == 0 ? &sum : at(strip, column + dx, row + dy);
      if (near == nullptr) continue;
      const Place& there = near->place();
      const Eigen::Vector3f place(1.0F, there.x() / cell + static_cast<float>(dx),
                                  there.y() / cell - static_cast<float>(dy));
      places[count] = place;
      heights[count] = there.z() - own.z();
      normal += place * place.transpose();
      right += heights[count++] * place;
    }
  }
  if (count < kFewestNeighbours) return own.z();
  bool invertible = false;
  Eigen::Matrix3f inverse;
  normal.computeInverseWithCheck(inverse, invertible, 1e-3F);
  if (!invertible) return own.z();
  const Eigen::Vector3f plane = inverse * right;
  float squares = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const float rest = heights[i] - plane.dot(places[i]);
    squares += rest * rest;
  }
  if (squares > kUneven * kUneven * static_cast<float>(count)) return own.z();
  return own.z() - (plane[1] * own.x() + plane[2] * own.y()) / cell;
}

SwathSeparation::Cell SwathSeparation::cellAt(int column, int row) const {
  Cell cell;
  double low = 0.0, high = 0.0, intensity = 0.0, points = 0.0;
  for (const StripBlocks& strip : strips_) {
    const Sum* sum = at(strip, column, row);
    if (sum == nullptr) continue;
    const double z = strip.height + heightAtCentre(strip, column, row, *sum);
    low = cell.strips == 0 ? z : std::min(low, z);
    high = cell.strips == 0 ? z : std::max(high, z);
    if (cell.strips < 255) ++cell.strips;
    intensity += static_cast<double>(sum->intensity) * sum->count;
    points += sum->count;
  }
  cell.separation = static_cast<float>(high - low);
  if (points > 0.0) cell.intensity = static_cast<float>(intensity / points);
  return cell;
}

std::vector<SwathSeparation::Cell> SwathSeparation::rows(int first_row, int rows) const {
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(rows) * grid_.columns);
  for (int row = first_row; row < first_row + rows; ++row)
    for (int column = 0; column < grid_.columns; ++column) cells.push_back(cellAt(column, row));
  return cells;
}

SwathSeparation::Stretch SwathSeparation::intensityStretch() const {
  constexpr std::size_t kEvery = 7;  // of the cells of a block
  std::vector<float> values;
  for (const StripBlocks& strip : strips_)
    for (const auto& [key, block] : strip.blocks)
      for (std::size_t i = 0; i < block.size(); i += kEvery)
        if (block[i].count > 0) values.push_back(block[i].intensity);
  Stretch stretch;
  if (values.empty()) return stretch;
  std::sort(values.begin(), values.end());
  stretch.low = values[values.size() / 50];
  stretch.high = values[values.size() - 1 - values.size() / 50];
  return stretch;
}

SeparationColour separationColour(float separation, double limit) {
  if (separation <= limit) return SeparationColour::green;
  return separation <= 2.0 * limit ? SeparationColour::yellow : SeparationColour::red;
}

SeparationPixel separationPixel(const SwathSeparation::Cell& cell,
                                const SwathSeparation::Stretch& stretch, double limit) {
  if (cell.strips == 0) return {};
  const float range = std::max(stretch.high - stretch.low, 1e-6F);
  const float grey = 255.0F * std::clamp((cell.intensity - stretch.low) / range, 0.0F, 1.0F);
  std::array<float, 3> pixel{grey, grey, grey};
  if (cell.strips > 1) {
    static constexpr std::array<std::array<float, 3>, 3> kColours{
        {{0.0F, 200.0F, 0.0F}, {255.0F, 255.0F, 0.0F}, {255.0F, 0.0F, 0.0F}}};
    const auto which = static_cast<std::size_t>(separationColour(cell.separation, limit)) - 1;
    for (std::size_t i = 0; i < 3; ++i)
      pixel[i] = kShare * kColours[which][i] + (1.0F - kShare) * grey;
  }
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {byte(pixel[0]), byte(pixel[1]), byte(pixel[2]), 255};
}

}  // namespace pcl_als
