// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/processing/intensity_output.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/radiometry/atmosphere.h>

namespace pcl_als {

/// Source of the extinction.
struct ExtinctionChoice {
  std::optional<Atmosphere> air;  ///< empty: given directly, switched off, or of another run
  Extinction parts;               ///< of the air
  double per_km = 0.0;
  std::string remark;  ///< one line for the user
};

/// Contents of the reports of a run.
struct IntensityReport {
  const IntensityRun* run = nullptr;
  const IntensityOutcome* outcome = nullptr;
  ExtinctionChoice extinction;
  IntensityOutput output;
  std::vector<std::string> outputs;  ///< names, by file
  std::optional<OverlapResult> overlaps;
  std::optional<ReferenceResult> reference;
  std::vector<LeftOutPoints> left_out;  ///< points that stay unchanged
  std::vector<std::string> warnings;
};

/// Results of estimation and targets, as lines for the user.
std::string overlapText(const OverlapResult& overlaps, const std::vector<std::string>& strips);
/// Requested terms that are not estimable, or that the adjustment did not converge.
std::string notEstimable(const OverlapResult& overlaps, const std::vector<std::string>& strips);
std::string referenceText(const ReferenceResult& reference);
std::string countsText(const IntensityCounts& counts, const IntensityRun& run);

/// Points without a usable corrected intensity: saturated, clipped or rounded to zero.
struct LostIntensities {
  /// shares of unusable intensities: no reliable result; a warning
  static constexpr double kAll = 0.99, kMany = 0.1;
  double share = 0.0;  ///< of the points with an intensity
  std::string text;
};
LostIntensities lostIntensities(const IntensityCounts& counts);

/// "10-15", or "no surface".
std::string slopeName(std::size_t bin);

/// Factor by which corrected values have the mean of the given ones.
double meanScale(const BeforeAfter& all);

/// model.json of a run; the help of the tool lists its content.
void writeIntensityJson(const std::filesystem::path& path, const IntensityReport& report);

/// report.md, slopes.csv, classes.csv, strips.csv, histograms.csv, written into a folder that is
/// made if missing. Without \a markdown report.md is left to the page.
void writeIntensityReport(const std::filesystem::path& folder, const IntensityReport& report,
                          bool markdown);

/// Model, gains by strip and constant of a JSON of an earlier run.
struct StoredRadiometry {
  RadiometricModel model;
  std::map<std::string, double> gains;
  double constant = 0.0;
};
StoredRadiometry readIntensityJson(const std::filesystem::path& path);

}  // namespace pcl_als
