// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include <pcl_als/classification/land_cover_filter.h>
#include <pcl_als/processing/land_cover.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

struct PointClassCounts {
  std::uint64_t points = 0, unclassified = 0;
  /// What of the input was wrong, and what was copied besides (LasRewriteResult).
  std::vector<std::string> remarks;
};

/// Classes of points from a raster file, of which only the parts under the points are in memory.
class PointClasses {
 public:
  PointClasses(std::shared_ptr<const MaximumLikelihood> classifier,
               const std::filesystem::path& raster);
  /// Index of each point's class, or MaximumLikelihood::kNoClass. Thread-safe.
  std::vector<int> classify(const PointChunk& points);
  const GaussianModel& model() const { return classifier_->model(); }

 private:
  struct Group;
  void classify(const PointChunk& points, const Group& group, std::vector<int>& classes);

  std::shared_ptr<const MaximumLikelihood> classifier_;
  BandReader bands_;
  std::mutex reading_;
};

/** \brief A copy of a point file with the ASPRS codes of land cover in its classification.
 *
 * .las and .laz record by record in constant memory, with all other bytes unchanged. Points without
 * a class, points of noise (7, 18), and points that \a survey excludes keep their code; \a place:
 * index of the file in the survey.
 */
PointClassCounts classifyPointFile(const std::filesystem::path& input,
                                   const std::filesystem::path& output, PointClasses& classes,
                                   const SurveyReader& survey, std::size_t place, int threads);

}  // namespace pcl_als
