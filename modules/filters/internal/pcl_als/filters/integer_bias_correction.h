// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <Eigen/Core>

#include <pcl_als/las/las_channel.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/trajectory/system_correction.h>

namespace pcl_als {

/** \brief Eq. (13) of Habib et al. 2011 on the records of a LAS file, in place.
 *
 * The points are corrected by SystemCorrection, as those of clouds are. The effect A(point) delta
 * is computed in double, divided by the scale, rounded to the nearest integer and subtracted (added
 * where the correction is inverted): no other byte changes, and zero biases change none. Points
 * without a trajectory are counted and stay unchanged.
 *
 * Inverting a correction returns each integer to within one unit, because each direction rounds
 * once.
 *
 * apply() may be called from several threads on different records; results do not depend on how
 * records are divided among calls that begin at multiples of kTile.
 */
class IntegerBiasCorrection {
 public:
  /// What the records of a file hold, and where.
  struct Layout {
    std::size_t record_length = 0;  ///< bytes; extra bytes may have been appended to those of file
    LasRecordLayout fields;
    LasScaling metres;
    LasChannel channel;  ///< in the field that the systems depend on

    /// InputError where the file lacks that field.
    static Layout of(const LasFile& file, const SystemLookup& systems);
  };
  /// Points that are computed together; their columns fit the first-level cache.
  static constexpr std::size_t kTile = 256;

  /// \a name: the file, for messages. InputError for a scale that is zero or not finite, and for
  /// records without the channels that the systems of the calibration depend on.
  IntegerBiasCorrection(std::string name, SystemCorrection correction, const Layout& layout);

  /// Corrects \a count records. \a first: index of the first one in the file. InputError naming the
  /// point whose new coordinate does not fit an int32; the records before it have then been
  /// changed.
  CoverageCount apply(std::byte* records, std::size_t count, std::uint64_t first) const;

 private:
  struct Tile;
  void gather(const std::byte* records, std::size_t count, Tile& tile) const;
  void scatter(std::byte* records, std::size_t count, std::uint64_t first, Tile& tile) const;
  [[noreturn]] void refuseOverflow(const double* values, std::uint64_t first, int axis) const;

  std::string name_;
  SystemCorrection correction_;
  Layout layout_;
};

}  // namespace pcl_als
