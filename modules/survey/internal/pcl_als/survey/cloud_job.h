// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/survey/cloud_input.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Common base of the jobs on strips that are clouds in memory: strips, flight and progress.
template <typename PointT>
class CloudJob {
 public:
  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;

  /// Adds a strip, or a further part of the strip of that id. Points that are not finite are left
  /// out. UsageError for a null cloud, an empty id, or a frame that is not finite.
  void addInputStrip(const PointCloudConstPtr& cloud, const LocalFrame& frame,
                     const std::string& id) {
    if (!cloud) throw UsageError("strip " + id + ": the cloud is null");
    if (id.empty()) throw UsageError("a strip needs an id");
    if (!frame.origin.allFinite())
      throw UsageError("strip " + id + ": the origin of its frame is not finite");
    parts_.push_back({cloud, frame, id});
  }
  void clearInputStrips() { parts_.clear(); }

  /// The flight as delivered; its use is described with the class.
  void setTrajectory(std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
  }
  std::shared_ptr<const Trajectory> getTrajectory() const { return trajectory_; }

  /// Conversion of point times to those of the trajectory; default: they are the same.
  void setTimeAlignment(const TimeAlignment& alignment) { alignment_ = alignment; }
  const TimeAlignment& getTimeAlignment() const { return alignment_; }

  /// Called in every phase and iteration; returning false cancels.
  void setProgressCallback(ProgressCallback callback) { progress_ = std::move(callback); }

 protected:
  explicit CloudJob(const char* name) : name_(name) {}
  ~CloudJob() = default;

  void requireStrips() const {
    if (parts_.empty()) throw UsageError(name_ + ": no strips are set");
  }
  /// The strips in the order in which they were added.
  SurveyReader survey(int threads) const {
    std::vector<SurveyInput> inputs;
    for (const Part& part : parts_)
      inputs.push_back(makeCloudInput<PointT>(part.cloud, part.frame, part.id, alignment_));
    return SurveyReader::ofInputs(std::move(inputs), threads);
  }

  std::string name_;  ///< of the class, for messages
  std::shared_ptr<const Trajectory> trajectory_;
  ProgressCallback progress_;

 private:
  struct Part {
    PointCloudConstPtr cloud;
    LocalFrame frame;
    std::string id;
  };
  std::vector<Part> parts_;
  TimeAlignment alignment_;
};

}  // namespace pcl_als
