// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/** \brief Times of the points and positions of their swath: counts and mean positions for every
 * tenth of a second.
 *
 * Sums are in whole centimetres, so that a track depends neither on the order of the points nor on
 * their division into files. Memory: about 90 bytes for every tenth of a second flown; where times
 * extend over more than kMostBins bins, the width of the bins is doubled.
 */
class SwathTrack {
 public:
  static constexpr std::size_t kMostBins = std::size_t{1} << 18U;

  struct Bin {
    double first = 0.0, last = 0.0;  ///< smallest and largest time, seconds
    std::uint64_t points = 0;
    std::uint64_t placed = 0;           ///< points with a usable position
    std::int64_t x_sum = 0, y_sum = 0;  ///< of these, centimetres
    double middle() const { return 0.5 * (first + last); }
    Eigen::Vector2d mean() const;  ///< metres
    void merge(const Bin& other);
  };

  /// Adds points [from, to) of a chunk; times that are zero or not finite are not added.
  void add(const PointChunk& chunk, std::size_t from, std::size_t to);
  /// Adds another track with its times converted by \a alignment.
  void merge(const SwathTrack& other, const TimeAlignment& alignment = TimeAlignment());

  bool empty() const { return bins_.empty(); }
  double width() const { return width_; }  ///< of a bin, seconds
  /// In order of time.
  const std::map<std::int64_t, Bin>& bins() const { return bins_; }
  std::uint64_t pointCount() const;

  void put(ByteWriter& out) const {
    out.put(width_).putMap(bins_, [](ByteWriter& o, const Bin& bin) { o.put(bin); });
  }
  void get(ByteReader& in) {
    in.get(width_).getMap(bins_, [](ByteReader& i, Bin& bin) { i.get(bin); });
  }

 private:
  std::int64_t indexOf(double time) const;
  void limitMemory();
  void doubleWidth();

  double width_ = 0.1;
  std::map<std::int64_t, Bin> bins_;
};

}  // namespace pcl_als
