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
  double cell = 0.0;                      ///< metres; 0: that of the quality level
  int quality_level = 2;                  ///< of the USGS Lidar Base Specification, 0 … 3
};

/// Options of checkDelivery().
struct DeliveryCheckOptions {
  CheckSettings settings;
  StripChoice strips;           ///< strips that are used; default: all
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  /// Areas of comparison; empty: they are chosen. With the areas of an earlier check of the same
  /// block, the two checks are comparable.
  std::vector<SurveyArea> areas;
  std::optional<SeparationImageOptions> separation;  ///< images to be written; default: none
  SurveyObserver observer;  ///< receives the points of the second of its readings
};

struct DeliveryCheckResult {
  CheckedBlock block;
  std::vector<SurveyArea> areas;  ///< areas of comparison
  std::string crs;                ///< of the points, WKT or "EPSG:…"; empty: unknown
};

/** \brief Measures the agreement of overlapping strips with each other and with control.
 *
 * The measures, their signs and their sources (USGS, ASPRS) are described on the page of module
 * quality. The files are read three times, once by the constructor of \a survey; memory depends on
 * the chosen areas and not on the number of points.
 *
 * \param trajectory for scan angles that are finer than those of the files; may be null
 *
 * UsageError for unknown strips or impossible settings, InputError for unusable input, Cancelled.
 * \code
 * pcl_als::SurveyReader survey({"strip1.las", "strip2.las"});
 * const auto check = pcl_als::checkDelivery(survey, nullptr);
 * for (const pcl_als::CheckedPair& pair : check.block.pairs)
 *   std::cout << pair.a << " & " << pair.b << ": " << pair.assessment.vertical.rms << " m\n";
 * \endcode
 */
DeliveryCheckResult checkDelivery(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& trajectory,
                                  const DeliveryCheckOptions& options = {},
                                  const ProgressCallback& progress = {});

/// The files of another version of the same strips: \a given, or the point files of the folder if
/// \a given is a single folder. They are sorted into the order of the files of the same names in
/// \a others, because the names of strips and the order of pairs depend on it. InputError if there
/// are none.
std::vector<std::string> filesLike(const std::vector<std::string>& others,
                                   const std::vector<std::string>& given);

}  // namespace pcl_als
