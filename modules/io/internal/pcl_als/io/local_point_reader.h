// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/** \brief Reads points that are stored relative to an origin: those of a PCD file, or of a cloud.
 *
 * ground = origin + local, computed in double. Such points come without a header that tells their
 * box, coordinate step and kind of time: these are found by a first pass over the points.
 */
class LocalPointReader : public PointReader {
 public:
  const PointFileInfo& info() const override { return info_; }
  bool read(PointChunk& chunk) override;

 protected:
  /** \brief Fills info_ from all points; for the constructor of a derived class, which sets path,
   * CRS, units and format itself. \param origin metres, ground frame \param relative_step of the
   * coordinates as they are stored
   */
  void survey(const Eigen::Vector3d& origin, bool has_times, double relative_step);

  /// The next block of points relative to the origin, finite ones only (there may be none); false
  /// at the end.
  virtual bool readLocal(PointChunk& chunk) = 0;
  virtual void rewind() = 0;

  PointFileInfo info_;

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace pcl_als
