// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>

namespace pcl_als::detail {

/** \brief Keeps the directions of waveforms consistent with points that are corrected.
 *
 * A correction of the geometry turns the pulse as well as it moves its point. A second point of the
 * pulse, 300 m behind the first one, is corrected in the same way, and the direction between both
 * is stored. The anchor, point + location direction, then is corrected, too. \code DisplacedPoints
 * second(file, block);       // before the correction correct(block.records);
 * correct(second.records()); second.storeDirections(block);             // after it \endcode
 */
class DisplacedPoints {
 public:
  DisplacedPoints(const LasFile& file, const LasRecordBlock& block);

  /// Whether the points of the file can have waveforms; if not, there is nothing to correct.
  bool any() const { return layout_.waveform >= 0; }
  std::byte* records() { return records_.data(); }
  /// Stores the directions of points that were moved. The others keep their bytes.
  void storeDirections(const LasRecordBlock& block) const;

 private:
  const LasRecordLayout layout_;
  const Eigen::Vector3d scale_;
  std::vector<std::byte> records_;  ///< of the second points
  std::vector<std::byte> before_;   ///< the given records
  std::vector<bool> displaced_;
};

/// Applies a correction to the points of a block and to the directions of their waveforms.
/// \param engine has apply(records, count, first) \return what that returns for the points
template <typename Engine>
auto applyWithWaveforms(const Engine& engine, const LasFile& file, const LasRecordBlock& block) {
  DisplacedPoints second(file, block);
  auto result = engine.apply(block.records, block.count, block.first);
  if (!second.any()) return result;
  engine.apply(second.records(), block.count, block.first);
  second.storeDirections(block);
  return result;
}

}  // namespace pcl_als::detail
