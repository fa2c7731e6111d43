// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/raster.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/processing/batch_options.h>

namespace pcl_als {

class Communicator;
class SurveyReader;

/// Contents of point files.
struct RasterInput {
  std::vector<std::filesystem::path> paths;
  std::vector<PointFileInfo> infos;  ///< of each, with the box of its points
  std::uint64_t points = 0;
  double min_x = 0.0, min_y = 0.0, max_x = 0.0, max_y = 0.0;  ///< of the points, metres
  std::string crs;                                            ///< of the first file that has one
  /// Units that are converted or assumed, headers that state another box than that of the points.
  std::vector<std::string> remarks;
  /// The same files: all points, or those of chooseStrips().
  std::shared_ptr<const SurveyReader> survey;
  std::vector<ExcludedPoints> excluded;
};

/** \brief Reads the coordinates of every file once, because the box in a header may be wrong.
 *
 * Collective: \a processes (null: one) share the files. InputError for files without points or that
 * commonReference() refuses. \a threads: 0: all cores.
 */
RasterInput rasterInput(const std::vector<std::string>& paths, int threads = 0,
                        Communicator* processes = nullptr);
/// Restricts the contents to the chosen strips: reads every file twice.
void chooseStrips(const StripChoice& choice, RasterInput& files, int threads = 0);

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

struct RasterCounts {
  std::uint64_t points = 0;       ///< inside the raster, without noise
  std::uint64_t echo_widths = 0;  ///< of these, with the width of a decomposed echo
  CellCounts surface, terrain;

  void add(const RasterCounts& other) {
    points += other.points;
    echo_widths += other.echo_widths;
    surface.merge(other.surface);
    terrain.merge(other.terrain);
  }
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
