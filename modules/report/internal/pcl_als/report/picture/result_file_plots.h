// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// A plot of a result file.
struct NamedPlot {
  std::string name;  ///< of the file, without .png
  std::function<Canvas(PictureSize)> draw;
  std::string file{};  ///< result file that contains it
};

/** \brief All plots of a result file of any tool.
 *
 * calibration.json: parameters, correlation, pairs, convergence, residuals, strip_errors.
 * quality.json: heights, offset_against_distance, …_time and …_scan_angle of the pairs.
 * JSON of pcl_als_intensity: variance_to_mean, histograms, strip_gains. accuracy.json: confusion.
 * Any result: "curves", "histograms" and "confusion" at the top level (README of module
 * visualization). InputError for a file that is no JSON, is malformed, or has nothing to plot.
 */
std::vector<NamedPlot> plotsOf(const std::filesystem::path& file);

/// The plots of several files; where several have a plot of the same name, the later ones are named
/// FILE_NAME.
std::vector<NamedPlot> plotsOfAll(const std::vector<std::filesystem::path>& files);

/// Those of the plots that have these names, in the order of the names. UsageError for a name that
/// none has.
std::vector<NamedPlot> plotsNamed(const std::vector<NamedPlot>& plots,
                                  const std::vector<std::string>& names);

}  // namespace pcl_als
