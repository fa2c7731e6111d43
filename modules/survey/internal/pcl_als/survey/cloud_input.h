// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include <pcl/point_cloud.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/local_point_reader.h>
#include <pcl_als/survey/survey_input.h>

namespace pcl_als {

/// InputError where the floats of a cloud have steps of more than 2 mm (16 km from its frame's
/// origin), a tenth of the noise of points: such a cloud is probably without its frame.
void requireFineFloats(const PointFileInfo& cloud);

/** \brief Reads a cloud as if it were a point file. Points that are not finite are excluded.
 *
 * The points of a cloud and those of the PCD file that savePcd() writes of it are equal to the last
 * bit. Fields that the type lacks are those of PointFields. Memory: one chunk. requireFineFloats()
 * is called.
 */
template <typename PointT>
class CloudReader : public LocalPointReader {
 public:
  using CloudConstPtr = typename pcl::PointCloud<PointT>::ConstPtr;

  CloudReader(CloudConstPtr cloud, const LocalFrame& frame, const std::string& name)
      : cloud_(std::move(cloud)) {
    info_.path = name;
    info_.crs = frame.crs;
    info_.units.source = info_.units.vertical_source = "LocalFrame";
    info_.format = "point cloud";
    survey(frame.origin, HasGpsTime<PointT>::value, std::numeric_limits<float>::epsilon());
    requireFineFloats(info_);
  }

 private:
  bool readLocal(PointChunk& chunk) override {
    const std::size_t count = std::min(kChunk, cloud_->size() - next_);
    chunk.resize(count);
    std::size_t row = 0;
    for (std::size_t i = next_; i < next_ + count; ++i) {
      const PointFields<PointT> fields{(*cloud_)[i]};
      if (fields.isFinite()) fill(fields, chunk, row++);
    }
    chunk.resize(row);
    next_ += count;
    return count > 0;
  }
  void rewind() override { next_ = 0; }

  static void fill(const PointFields<PointT>& fields, PointChunk& chunk, std::size_t row) {
    chunk.x[row] = static_cast<double>(fields.point.x);
    chunk.y[row] = static_cast<double>(fields.point.y);
    chunk.z[row] = static_cast<double>(fields.point.z);
    chunk.gps_time[row] = secondsOfTime(fields.gpsTime());
    chunk.intensity[row] = fields.intensity();
    chunk.scan_angle[row] = fields.scanAngle();
    chunk.point_source_id[row] = 0;
    chunk.return_number[row] = fields.returnNumber();
    chunk.number_of_returns[row] = fields.numberOfReturns();
    chunk.classification[row] = fields.classification();
    chunk.flags[row] = fields.flags();
    chunk.user_data[row] = fields.userData();
    chunk.channel[row] = fields.flags() >> 6U;
  }

  CloudConstPtr cloud_;
  std::size_t next_ = 0;
};

/// A cloud as a source of points of one strip. \a time: to the time system of the trajectory
template <typename PointT>
SurveyInput makeCloudInput(const std::shared_ptr<const pcl::PointCloud<PointT>>& cloud,
                           const LocalFrame& frame, const std::string& strip,
                           const TimeAlignment& time = TimeAlignment()) {
  SurveyInput input;
  input.open = [cloud, frame, strip](const std::string&) {
    return std::make_unique<CloudReader<PointT>>(cloud, frame, "strip " + strip);
  };
  input.strip = strip;
  input.time = time;
  return input;
}

}  // namespace pcl_als
