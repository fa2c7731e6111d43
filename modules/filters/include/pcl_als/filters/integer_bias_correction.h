// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <Eigen/Core>

#include <pcl_als/trajectory/system_correction.h>

namespace pcl_als {

/** \brief Eq. (13) of Habib et al. 2011 on packed records with integer coordinates, in place.
 *
 * The engine of LAS to LAS correction. A record begins with X, Y, Z (int32, little-endian); ground
 * = raw scale + offset. The effect A(point) delta is computed in double, divided by the scale,
 * rounded to the nearest integer and subtracted (added where the correction is inverted): no other
 * byte changes, and zero biases change none. Points without a trajectory are counted and stay
 * unchanged.
 *
 * Inverting a correction returns each integer to within one unit, because each direction rounds
 * once.
 *
 * apply() may be called from several threads on different records; results do not depend on how
 * records are divided among calls that begin at multiples of kTile.
 */
class IntegerBiasCorrection {
 public:
  struct Layout {
    std::size_t record_length = 0;  ///< bytes
    std::size_t time_position = 0;  ///< byte of the GPS time (double, little-endian) in a record
    std::size_t intensity_position = 0;            ///< byte of the intensity (16 bits)
    std::size_t scan_direction_position = 0;       ///< byte whose bit 6 is the scan direction flag
    Eigen::Vector3d scale, offset;                 ///< metres
    std::size_t source_position = 0;               ///< byte of the point source id (16 bits)
    std::size_t channel_position = 0;              ///< byte with the channel of the scanner
    unsigned channel_shift = 0, channel_mask = 0;  ///< channel = (byte >> shift) & mask
    double time_shift = 0.0;                       ///< seconds, added to recorded times
  };
  /// Points that are computed together; their columns fit the first-level cache.
  static constexpr std::size_t kTile = 256;

  /// \a name: the file, for messages. InputError for a scale that is zero or not finite.
  IntegerBiasCorrection(std::string name, SystemCorrection correction, const Layout& layout);

  /// Corrects \a count records. \a first: index of the first one in the file. InputError naming the
  /// point whose new coordinate does not fit an int32; the records before it have then been
  /// changed.
  CoverageCount apply(std::byte* records, std::size_t count, std::uint64_t first) const;

 private:
  struct Tile;
  void gather(const std::byte* records, std::size_t count, Tile& tile) const;
  /// The systems of points, where there are several.
  void gatherSystems(const std::byte* records, std::size_t count, Tile& tile) const;
  void scatter(std::byte* records, std::size_t count, std::uint64_t first, Tile& tile) const;
  [[noreturn]] void refuseOverflow(const double* values, std::uint64_t first, int axis) const;

  std::string name_;
  SystemCorrection correction_;
  Layout layout_;
};

}  // namespace pcl_als
