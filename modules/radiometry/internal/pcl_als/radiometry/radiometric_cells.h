// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {

class ByteReader;
class ByteWriter;
struct CellVariation;

/// Observations of one strip in one cell; sums over its comparable points.
struct CellSums {
  int strip = 0;
  std::uint32_t points = 0;    ///< with a surface, neither zero nor saturated
  std::uint32_t excluded = 0;  ///< all others
  double intensity = 0.0, intensity_sq = 0.0, range = 0.0;  ///< digital numbers; metres
  Eigen::Vector3d beam = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
};

/// Criterion of cells that are smooth enough to be compared with those of another strip.
struct SmoothCellSettings {
  std::uint32_t least_points = 3;
  double most_excluded = 0.1;      ///< share of the cell's points
  double least_coherence = 0.995;  ///< length of the mean normal: 0.995 are 6 degrees RMS
  double most_variation = 0.3;     ///< standard deviation over mean of the intensities
  double most_turn = 5.0;          ///< degrees between the normals of two strips
};

/// A smooth cell covered by several strips.
struct SharedCell {
  struct View {
    int strip;
    double points, intensity, range, cosine;  ///< means
  };
  std::int32_t column = 0, row = 0;
  std::vector<View> views;  ///< ascending strips
};

/** \brief Means of intensity, range and incidence per plan cell and strip.
 *
 * To bound memory on large blocks only one cell in \a one_in is kept, chosen by a hash of its
 * position and therefore the same for all strips and files. Memory: about 150 bytes per cell and
 * strip. The normal of a cell is the mean over its strips: with separate normals their noise would
 * bias the incidence exponent.
 */
class RadiometricCells {
 public:
  /// \a size: metres, > 0; \a one_in: 1 keeps all. UsageError otherwise.
  explicit RadiometricCells(double size, std::uint32_t one_in = 1);

  double size() const { return size_; }
  std::uint32_t oneIn() const { return one_in_; }
  bool wants(double x, double y) const;
  /// \a usable: the intensity is neither zero nor saturated, and the return is the only one of its
  /// pulse: returns from the ground below leaves are darker, by an amount that differs between
  /// strips.
  void add(int strip, double x, double y, double intensity, bool usable,
           const PointRadiometry& point, const LocalSurface& surface);
  void merge(const RadiometricCells& other);
  std::size_t count() const { return cells_.size(); }
  /// All sums, for another process.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);
  /// Smooth cells of at least two strips, by row and column.
  std::vector<SharedCell> shared(const SmoothCellSettings& settings = SmoothCellSettings()) const;

 private:
  static std::uint64_t keyOf(double x, double y, double size);

  double size_;
  std::uint32_t one_in_;
  std::unordered_map<std::uint64_t, std::vector<CellSums>> cells_;
};

/// \a gains: divisors by strip; empty: none. A null model: the intensities as they are.
CellVariation variationOf(const std::vector<SharedCell>& cells, const RadiometricModel* model,
                          const std::vector<double>& gains);

}  // namespace pcl_als
