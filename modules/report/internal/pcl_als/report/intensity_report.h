// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/radiometry/atmosphere.h>

namespace pcl_als {

class FieldTable;

/// Source of the extinction.
struct ExtinctionChoice {
  std::optional<Atmosphere> air;  ///< empty: given directly, switched off, or of another run
  Extinction parts;               ///< of the air
  double per_km = 0.0;
  std::string remark;  ///< one line for the user
};

/// "atmosphere: extinction 0.32 per km (aerosol …), two-way transmission of 1 km 0.53".
std::string extinctionText(const ExtinctionChoice& choice);

/// Contents of the reports of a run.
struct IntensityReport {
  const IntensityResult* result = nullptr;
  ExtinctionChoice extinction;
  IntensityOutput output;
  std::vector<std::string> outputs;  ///< names, by file
};

/// Results of estimation and targets, as lines for the user.
std::string overlapText(const OverlapResult& overlaps, const std::vector<std::string>& strips);
std::string referenceText(const ReferenceResult& reference);
std::string countsText(const IntensityCounts& counts, const IntensityRun& run);

/// "10-15", or "no surface".
std::string slopeName(std::size_t bin);

/// Factor by which corrected values have the mean of the given ones.
double meanScale(const BeforeAfter& all);

/// model.json of a run; the help of the tool lists its content.
std::string intensityJson(const IntensityReport& report);
/// The description of model.json.
const FieldTable& intensityFields();

/// slopes.csv, classes.csv, strips.csv, histograms.csv, written into a folder that is made if
/// missing.
void writeIntensityTables(const std::filesystem::path& folder, const IntensityReport& report);

/// Model, gains and constant from the JSON of an earlier run.
StoredRadiometry readIntensityJson(const std::filesystem::path& path);

}  // namespace pcl_als
