// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/land_cover_job.h>

namespace pcl_als {

/// Some bands of a raster file, by name.
class BandReader {
 public:
  /// InputError naming the file and a missing band.
  BandReader(const std::filesystem::path& path, const std::vector<std::string>& bands);
  const RasterGrid& grid() const { return reader_.layout().grid; }
  /// Values [band][cell] of a window.
  std::vector<std::vector<float>> read(const RasterWindow& window);
  /// The same as a raster.
  Raster readRaster(const RasterWindow& window);

 private:
  RasterReader reader_;
  std::vector<std::string> names_;
  std::vector<std::size_t> indices_;
};

/// Band values of the cells of a site: for a point its cell, or the cells with centres within \a
/// radius metres of it (including its own); for an area the cells with their centre inside.
struct SiteCells {
  std::vector<Eigen::VectorXd> values;  ///< some may not be finite
  std::vector<Eigen::Vector2d> places;  ///< of the point, or the centres of the area's cells
};
SiteCells cellsOf(const ClassSite& site, double radius, BandReader& bands);

struct TrainingReport {
  std::vector<TrainingClass> classes;  ///< in order of first appearance
  std::vector<std::string> remarks;
};
TrainingReport collectTraining(const std::vector<ClassSite>& sites, double radius,
                               BandReader& bands);

CheckReport collectChecks(const std::vector<ClassSite>& sites, const MaximumLikelihood& classifier,
                          BandReader& bands);

/// Colour and code of each class, in the model's order; codes from 1.
std::vector<CodeMeaning> legendOf(const GaussianModel& model);

/// Classifies every cell, window by window. Codes are written to \a map, posteriors to \a posterior
/// where there is one. The result does not depend on the number of threads.
CoverCounts classifyCells(const MaximumLikelihood& classifier, BandReader& bands, int threads,
                          RasterWriter& map, RasterWriter* posterior,
                          const std::function<void(double)>& progress);

/// Legend as CSV: value,class,red,green,blue.
void writeLegend(const std::filesystem::path& path, const std::vector<CodeMeaning>& legend);

}  // namespace pcl_als
