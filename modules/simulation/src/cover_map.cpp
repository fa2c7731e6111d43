// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "cover_map.h"

#include <algorithm>
#include <cmath>

#include "random.h"

namespace pcl_als::simulation {

namespace {

constexpr double kParcel = 120.0;    ///< metres, mean size of a field
constexpr double kSoilShare = 0.38;  ///< of the parcels; the others are grass

/// A parcel is the region nearest to its seed point (a jittered lattice).
struct Parcel {
  Eigen::Vector2d seed;
  LandCover cover;
};

Parcel parcelOf(long column, long row, std::uint64_t seed) {
  Random random(
      keyOf({seed, 0xF1E1D, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)}));
  const double x = kParcel * (static_cast<double>(column) + random.uniform(0.1, 0.9));
  const double y = kParcel * (static_cast<double>(row) + random.uniform(0.1, 0.9));
  return {{x, y}, random.chance(kSoilShare) ? LandCover::soil : LandCover::grass};
}

LandCover parcelCoverAt(const Eigen::Vector2d& place, std::uint64_t seed) {
  const long column = std::lround(std::floor(place.x() / kParcel));
  const long row = std::lround(std::floor(place.y() / kParcel));
  LandCover cover = LandCover::grass;
  double nearest = 1e30;
  for (long j = row - 1; j <= row + 1; ++j)
    for (long i = column - 1; i <= column + 1; ++i) {
      const Parcel parcel = parcelOf(i, j, seed);
      const double distance = (parcel.seed - place).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      cover = parcel.cover;
    }
  return cover;
}

std::uint64_t latticeIndex(double floored) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(floored));
}

/// A random value in [0, 1) of a lattice point.
double latticeValue(std::uint64_t column, std::uint64_t row, std::uint64_t seed) {
  return unitOf(mixBits(seed + column * 0x9E3779B97F4A7C15ULL + row * 0xC2B2AE3D27D4EB4FULL));
}

/// Smooth noise in [-1, 1] with one random value per lattice point.
double latticeNoise(double x, double y, std::uint64_t seed) {
  const double column = std::floor(x), row = std::floor(y);
  const std::uint64_t i = latticeIndex(column), j = latticeIndex(row);
  const auto value = [seed](std::uint64_t a, std::uint64_t b) { return latticeValue(a, b, seed); };
  const double u = x - column, v = y - row;
  const double p = u * u * (3.0 - 2.0 * u), q = v * v * (3.0 - 2.0 * v);
  const double lower = value(i, j) * (1.0 - p) + value(i + 1, j) * p;
  const double upper = value(i, j + 1) * (1.0 - p) + value(i + 1, j + 1) * p;
  return 2.0 * (lower * (1.0 - q) + upper * q) - 1.0;
}

}  // namespace

CoverMap::CoverMap(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
                   std::uint64_t seed)
    : minimum_(minimum) {
  constexpr std::ptrdiff_t kStep = 4;  // parcels are looked up every 2 m
  const auto cells = [](double size) {
    return (static_cast<std::ptrdiff_t>(std::ceil(size / (kCell * kStep))) + 1) * kStep;
  };
  columns_ = cells(maximum.x() - minimum.x());
  rows_ = cells(maximum.y() - minimum.y());
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::ptrdiff_t row = 0; row < rows_; row += kStep) {
    LandCover* first = cells_.data() + row * columns_;
    for (std::ptrdiff_t column = 0; column < columns_; column += kStep) {
      const Eigen::Vector2d place(static_cast<double>(column), static_cast<double>(row));
      std::fill_n(first + column, kStep, parcelCoverAt(minimum + kCell * place, seed));
    }
    for (std::ptrdiff_t i = 1; i < kStep; ++i) std::copy_n(first, columns_, first + i * columns_);
  }
}

std::size_t CoverMap::indexOf(double x, double y) const {
  const auto column = std::clamp<std::ptrdiff_t>(
      static_cast<std::ptrdiff_t>((x - minimum_.x()) / kCell), 0, columns_ - 1);
  const auto row = std::clamp<std::ptrdiff_t>(
      static_cast<std::ptrdiff_t>((y - minimum_.y()) / kCell), 0, rows_ - 1);
  return static_cast<std::size_t>(row * columns_ + column);
}

template <typename Inside>
void CoverMap::paint(const Eigen::Vector2d& centre, double reach, LandCover cover,
                     const Inside& inside) {
  const auto cellOf = [](double distance, std::ptrdiff_t count) {
    const double cell = std::floor(distance / kCell);
    return static_cast<std::ptrdiff_t>(std::clamp(cell, -1.0, static_cast<double>(count)));
  };
  const Eigen::Vector2d from = centre - minimum_;
  const std::ptrdiff_t left = std::max<std::ptrdiff_t>(0, cellOf(from.x() - reach, columns_));
  const std::ptrdiff_t right = std::min(columns_ - 1, cellOf(from.x() + reach, columns_));
  const std::ptrdiff_t top = std::min(rows_ - 1, cellOf(from.y() + reach, rows_));
  for (auto row = std::max<std::ptrdiff_t>(0, cellOf(from.y() - reach, rows_)); row <= top; ++row)
    for (std::ptrdiff_t column = left; column <= right; ++column) {
      const Eigen::Vector2d middle(static_cast<double>(column) + 0.5,
                                   static_cast<double>(row) + 0.5);
      if (inside(kCell * middle - from))
        cells_[static_cast<std::size_t>(row * columns_ + column)] = cover;
    }
}

void CoverMap::paintDisc(const Eigen::Vector2d& centre, double radius, LandCover cover) {
  paint(centre, radius, cover, [radius](const Eigen::Vector2d& from_centre) {
    return from_centre.squaredNorm() <= radius * radius;
  });
}

void CoverMap::paintRectangle(const Eigen::Vector2d& centre, double azimuth, double length,
                              double width, LandCover cover) {
  const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth)), across(-along.y(), along.x());
  paint(centre, 0.5 * std::hypot(length, width), cover, [&](const Eigen::Vector2d& from_centre) {
    return std::abs(from_centre.dot(along)) <= 0.5 * length &&
           std::abs(from_centre.dot(across)) <= 0.5 * width;
  });
}

float baseReflectance(LandCover cover) {
  switch (cover) {
    case LandCover::grass:
      return 0.50F;
    case LandCover::soil:
      return 0.28F;
    case LandCover::road:
      return 0.14F;
    case LandCover::building:
      return 0.22F;
    case LandCover::tree:
      return 0.55F;
  }
  return 0.3F;
}

double textureAt(double x, double y, std::uint64_t seed) {
  return 1.0 + 0.10 * latticeNoise(x / 40.0, y / 40.0, seed) +
         0.08 * latticeNoise(x / 3.0, y / 3.0, seed + 1) +
         0.10 * latticeNoise(x / 0.7, y / 0.7, seed + 2);
}

double grassHeightAt(double x, double y, std::uint64_t seed) {
  constexpr double kBlades = 0.02, kMeadow = 25.0, kShortest = 0.3;  // metres, metres, 1
  const double longest =
      kShortest +
      (1.0 - kShortest) * (0.5 + 0.5 * latticeNoise(x / kMeadow, y / kMeadow, seed + 3));
  return longest * latticeValue(latticeIndex(std::floor(x / kBlades)),
                                latticeIndex(std::floor(y / kBlades)), seed + 4);
}

}  // namespace pcl_als::simulation
