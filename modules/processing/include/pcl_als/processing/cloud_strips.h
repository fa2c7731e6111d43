// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/survey/cloud_input.h>

namespace pcl_als {

/// Strips in memory, as collected by the classes for clouds.
template <typename PointT>
class CloudStrips {
 public:
  using CloudConstPtr = typename pcl::PointCloud<PointT>::ConstPtr;

  /// UsageError for a null cloud, a frame that is not finite, or a strip without a name.
  void add(const CloudConstPtr& cloud, const LocalFrame& frame, const std::string& id) {
    if (!cloud) throw UsageError("strip " + id + ": the cloud is null");
    if (id.empty()) throw UsageError("a strip needs an id");
    if (!frame.origin.allFinite())
      throw UsageError("strip " + id + ": the origin of its frame is not finite");
    parts_.push_back({cloud, frame, id});
  }
  void clear() { parts_.clear(); }
  std::size_t size() const { return parts_.size(); }

  /// Sources for a SurveyReader, in the order in which they were added.
  std::vector<SurveyInput> inputs(const TimeAlignment& time) const {
    std::vector<SurveyInput> inputs;
    for (const Part& part : parts_)
      inputs.push_back(makeCloudInput<PointT>(part.cloud, part.frame, part.id, time));
    return inputs;
  }

 private:
  struct Part {
    CloudConstPtr cloud;
    LocalFrame frame;
    std::string id;
  };
  std::vector<Part> parts_;
};

}  // namespace pcl_als
