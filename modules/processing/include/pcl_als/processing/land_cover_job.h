// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/common/class_site.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/processing/batch_options.h>
#include <pcl_als/processing/strip_rasters.h>

namespace pcl_als {

struct LandCoverOptions {
  SurfaceOptions surface;  ///< how the rasters are made
  /// Bands by which classes are separated, of SurfaceAccumulator::bandNames().
  std::vector<std::string> bands{"height", "intensity", "roughness", "multiple_returns"};
  double cell = 1.0;                ///< metres
  std::optional<RasterGrid> grid;   ///< default: cells of this size over all points
  std::vector<ClassSite> training;  ///< or a model
  std::optional<GaussianModel> model;
  std::vector<ClassSite> checks;  ///< for the assessment of the accuracy; may be empty
  std::vector<std::pair<std::string, double>> priors;  ///< by class; the others share the rest
  double reject = 0.0;  ///< probability below which a cell has no class, 0 … 0.5
  /// metres around training points within which cells are training cells
  double training_radius = 0.0;
  int tile = 768;  ///< cells, side of the tiles that are processed
  int threads = 0;
  std::filesystem::path map;        ///< GeoTIFF of classes; empty: only rasters are made
  std::filesystem::path grids;      ///< GeoTIFF of all bands; empty: not kept
  std::filesystem::path posterior;  ///< GeoTIFF of probabilities; empty: none
  std::filesystem::path points;     ///< folder of point files with classes; empty: none
  BatchOptions batch;  ///< processes that share tiles and files; continuation for point files
  /// Names of the sites in messages: those of their files.
  std::string training_name = "training sites", checks_name = "check sites";
};

/// Classes of check sites and of their cells.
struct CheckReport {
  std::vector<CheckedSite> sites;
  std::vector<std::string> remarks;
};
struct CoverCounts {
  std::vector<std::uint64_t> cells;  ///< per class
  std::uint64_t rejected = 0, without_values = 0;
};

struct LandCoverResult {
  RasterGrid grid;
  RasterCounts rasters;
  std::optional<GaussianModel> model;  ///< given, or trained
  CoverCounts cover;                   ///< of the map
  CheckReport checks;                  ///< classes of the cells at check sites
  /// Classes whose covariance the training samples do not determine; their cells are not reliable.
  std::vector<std::string> undetermined;
  std::vector<std::string> remarks;
};

/** \brief Rasters of strips, classified by Gaussian maximum likelihood, from point files.
 *
 * Reads the files tile by tile; memory is that of a tile per thread. Outputs appear only when they
 * are complete. UsageError for impossible options, InputError for unusable input (no points in the
 * rasters, no ground, sites outside), Cancelled.
 */
LandCoverResult classifyLandCover(const RasterInput& files, const LandCoverOptions& options,
                                  const ProgressCallback& progress = {});

}  // namespace pcl_als
