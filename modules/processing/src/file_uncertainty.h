// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/processing/intensity_input.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/trajectory/point_uncertainty.h>
#include <pcl_als/trajectory/system_correction.h>

#include "point_deviations.h"

namespace pcl_als::detail {

/** \brief Standard deviations of the points of a LAS file as extra bytes.
 *
 * The file is read window by window with the points around it, from which the local surfaces
 * follow; memory is that of a window for each thread.
 */
class FileUncertainty {
 public:
  /// InputError for a file whose points are in no order of time or place.
  /// \a layout: where a record has what its system depends on.
  FileUncertainty(const LasFile& file, const SystemCorrection& correction,
                  const IntegerBiasCorrection::Layout& layout, const CalibrationResult& calibration,
                  const FileCorrectionOptions& options);

  /// Fields that the file has not yet, and the blocks of the edit.
  const LasExtension& extension() const { return extension_; }

  /// Normals of the surfaces of the records of a block; NaN: none. Before they are corrected.
  std::vector<Eigen::Vector3f> normalsOf(const LasRecordBlock& block) const;
  /// Stores the standard deviations of corrected records.
  void store(const LasRecordBlock& block, const std::vector<Eigen::Vector3f>& normals);
  /// Sets deviations and deviation_raster.
  void finish(FileCorrectionResult& result) const;

 private:
  void chooseRadius();
  void placeFields(const LasFile& file);
  /// Of the echo of a record; NaN: not known.
  double rangeStdOf(const std::byte* record) const;
  std::size_t systemOf(const std::byte* record) const;
  void count(const std::vector<PointDeviation>& points,
             const std::vector<Eigen::Vector3f>& normals);

  std::unique_ptr<const IntensityInput> input_;
  std::vector<SurveyedFile> surveyed_;
  std::optional<StripAssignment> arrangement_;
  double radius_ = 2.0;  ///< metres, of the surfaces
  LasExtension extension_;
  std::size_t horizontal_at_ = 0, vertical_at_ = 0;
  std::optional<std::size_t> range_std_at_;  ///< of a file with decomposed waveforms
  const IntegerBiasCorrection::Layout layout_;
  const SystemCorrection correction_;
  PointUncertainty uncertainty_;
  std::unique_ptr<DeviationCells> cells_;
  std::mutex mutex_;
  DeviationSummary summary_;
  std::uint64_t horizontal_ = 0, vertical_ = 0;  ///< sums of squares
};

}  // namespace pcl_als::detail
