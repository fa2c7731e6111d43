// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <map>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/intensity_output.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {

/** \brief Corrects the intensities of LAS records for range and air alone, in place, in columns.
 *
 * Where no surfaces are wanted this is all of the correction. It keeps nothing of a point, and no
 * result depends on how the records are divided among calls. Thread-safe.
 */
class RangeOnlyCorrection {
 public:
  /// Whether the correction needs nothing else.
  static bool serves(const IntensitySettings& settings, const IntensityOutput& output);

  /// \a original_at: byte of a record where its given intensity goes; -1: nowhere.
  RangeOnlyCorrection(const IntensityRun& run, std::size_t file, double scale,
                      std::ptrdiff_t original_at);

  IntensityCounts apply(const LasRecordBlock& block) const;

 private:
  struct Tile;
  /// Returns the number of returns that are not the last of their pulse.
  std::uint64_t gather(const std::byte* records, std::size_t length, std::size_t count,
                       Tile& tile) const;
  void setDivisors(std::size_t count, Tile& tile, IntensityCounts& counts) const;
  void countUncovered(std::size_t count, const std::byte* records, std::size_t length,
                      const Tile& tile, IntensityCounts& counts) const;
  void round(std::size_t count, Tile& tile, IntensityCounts& counts) const;
  void scatter(std::byte* records, std::size_t length, std::size_t count, const Tile& tile) const;

  RadiometricEvaluator evaluator_;
  TimeAlignment alignment_;
  LasRecordLayout layout_;
  Eigen::Vector3d metres_per_step_, offset_;
  struct Source {
    double divisor = 1.0;
    std::size_t label = 0;  ///< in the arrangement of the strips
  };
  std::map<std::uint16_t, Source> sources_;  ///< by point source id
  double scale_, saturation_;
  const IntensityRun& run_;
  std::size_t file_;
  std::ptrdiff_t original_at_;
};

}  // namespace pcl_als
