// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/processing/checked_block.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

/// Swath separation images; needs a build with GDAL.
struct SeparationImageOptions {
  std::filesystem::path folder;
  std::string name = "swath_separation";  ///< of the files, without extension
  double cell = 0.0;                      ///< metres; 0: as the quality level requires
  int quality_level = 2;                  ///< of the USGS Lidar Base Specification, 0 … 3
};

struct DeliveryCheckOptions {
  CheckSettings settings;
  StripChoice strips;             ///< strips that are used; default all
  std::optional<int> gps_week;    ///< of times that are seconds of the week; default: from the data
  std::vector<SurveyArea> areas;  ///< to compare at; empty: chosen. Those of an earlier check of
                                  ///< the same block make both comparable.
  std::optional<SeparationImageOptions> separation;  ///< images to write; default none
  SurveyObserver observer;                           ///< called during the second reading
};

struct DeliveryCheckResult {
  CheckedBlock block;
  std::vector<SurveyArea> areas;  ///< areas of comparison
  std::string crs;                ///< of the points, WKT or "EPSG:…"; empty: unknown
};

/** \brief Measures the agreement of the overlapping strips of a survey with each other and with
 * control.
 *
 * Reads the files three times; memory depends on the areas chosen and not on the survey.
 *
 * \param trajectory for scan angles that are finer than those of the files; may be null
 *
 * UsageError for unknown strips or impossible settings, InputError for unusable input, Cancelled.
 */
DeliveryCheckResult checkDelivery(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& trajectory,
                                  const DeliveryCheckOptions& options = {},
                                  const ProgressCallback& progress = {});

/// Another set of the files \a others: \a given, or the point files of the one folder in it, in the
/// order of the files of that name in \a others, because strips are named, and pairs turned, by it.
/// InputError where there are none.
std::vector<std::string> filesLike(const std::vector<std::string>& others,
                                   const std::vector<std::string>& given);

}  // namespace pcl_als
