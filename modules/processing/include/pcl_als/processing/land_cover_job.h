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

/// The point files from which rasters are made.
struct RasterInput {
  std::vector<std::filesystem::path> paths;
  std::vector<PointFileInfo> infos;  ///< by file, with the box of its points
  std::uint64_t points = 0;
  double min_x = 0.0, min_y = 0.0, max_x = 0.0, max_y = 0.0;  ///< box of the points, metres
  std::string crs;                                            ///< of the first file that states one
  /// Units that are converted or assumed, and headers that state another box than the points have.
  std::vector<std::string> remarks;
  /// Reader of all points, or of those of chooseStrips().
  std::shared_ptr<const SurveyReader> survey;
  std::vector<ExcludedPoints> excluded;
};

/** \brief Reads the coordinates of every file once, because the box in a header may be wrong.
 *
 * \param threads 0: all cores
 * \param processes the processes that share the files (collective); null: one process
 *
 * InputError for files without points, and if their CRS or units do not agree (commonReference()).
 */
RasterInput rasterInput(const std::vector<std::string>& paths, int threads = 0,
                        Communicator* processes = nullptr);
/// Restricts the input to the chosen strips; reads every file twice. UsageError for an unknown
/// strip.
void chooseStrips(const StripChoice& choice, RasterInput& files, int threads = 0);

/// Options of classifyLandCover().
struct LandCoverOptions {
  SurfaceOptions surface;  ///< settings of the rasters
  /// Bands that are used for the classification, from SurfaceAccumulator::bandNames().
  std::vector<std::string> bands{"height", "intensity", "roughness", "multiple_returns"};
  double cell = 1.0;                   ///< metres
  std::optional<RasterGrid> grid;      ///< default: cells of this size over all points
  std::vector<ClassSite> training;     ///< training sites, or
  std::optional<GaussianModel> model;  ///< the statistics of an earlier training
  std::vector<ClassSite> checks;       ///< check sites for the accuracy; may be empty
  /// Priors by class; the other classes share the remaining probability.
  std::vector<std::pair<std::string, double>> priors;
  double reject = 0.0;  ///< probability below which a cell has no class, 0 … 0.5
  /// Cells within this distance of a training point are training cells, metres.
  double training_radius = 0.0;
  int tile = 768;   ///< side of the tiles that are processed, cells
  int threads = 0;  ///< 0: all cores; the result does not depend on it
  // Outputs.
  std::filesystem::path map;        ///< GeoTIFF of classes; empty: only rasters are made
  std::filesystem::path grids;      ///< GeoTIFF of all bands; empty: not kept
  std::filesystem::path posterior;  ///< GeoTIFF of probabilities; empty: none
  std::filesystem::path points;     ///< folder of point files with classes; empty: none
  BatchOptions batch;  ///< processes that share tiles and files; continuation for point files
  /// Names of the sites in messages, such as those of their files.
  std::string training_name = "training sites", checks_name = "check sites";
};

/// Reference classes of check sites and classes of their cells.
struct CheckReport {
  std::vector<CheckedSite> sites;
  std::vector<std::string> remarks;
};
/// Numbers of cells of a map.
struct CoverCounts {
  std::vector<std::uint64_t> cells;  ///< per class
  std::uint64_t rejected = 0, without_values = 0;
};

/// Numbers of points and cells of the rasters.
struct RasterCounts {
  std::uint64_t points = 0;       ///< points inside the raster, without noise
  std::uint64_t echo_widths = 0;  ///< points among them with the width of a decomposed echo
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
  std::optional<GaussianModel> model;  ///< that of the options, or the trained one
  CoverCounts cover;                   ///< of the map
  CheckReport checks;                  ///< classes of the cells at check sites
  /// Classes whose covariance the training samples do not determine; their cells are not reliable.
  std::vector<std::string> undetermined;
  std::vector<std::string> remarks;
};

/** \brief Makes rasters of point files and classifies them by Gaussian maximum likelihood.
 *
 * Reads the files tile by tile; memory is that of a tile per thread. Outputs appear only when they
 * are complete. The method is described on the page of module classification. UsageError for
 * impossible options, InputError for unusable input (no points in the rasters, no ground, sites
 * outside), Cancelled.
 * \code
 * const auto files = pcl_als::rasterInput({"strip1.laz", "strip2.laz"});
 * pcl_als::LandCoverOptions options;
 * options.training = pcl_als::readClassSites("training.csv");
 * options.map = "landcover.tif";
 * const auto result = pcl_als::classifyLandCover(files, options);
 * \endcode
 */
LandCoverResult classifyLandCover(const RasterInput& files, const LandCoverOptions& options,
                                  const ProgressCallback& progress = {});

}  // namespace pcl_als
