// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <utility>

#include <pcl_als/classification/land_cover_filter.h>

namespace pcl_als {

PointClassifier::PointClassifier(std::shared_ptr<const MaximumLikelihood> classifier,
                                 std::shared_ptr<const Raster> raster)
    : classifier_(std::move(classifier)), raster_(std::move(raster)) {
  for (const std::string& band : classifier_->model().bands) {
    Source source = Source::cell;
    if (band == "height") source = Source::above_terrain;
    if (band == "surface") source = Source::elevation;
    if (band == "intensity") source = Source::intensity;
    const float* values = nullptr;
    if (source == Source::cell) values = raster_->band(band).values.data();
    if (source == Source::above_terrain) values = raster_->band("terrain").values.data();
    sources_.push_back(source);
    bands_.push_back(values);
  }
}

MaximumLikelihood::Decision PointClassifier::classify(double x, double y, double z,
                                                      double intensity) const {
  const RasterGrid& grid = raster_->grid;
  const long long column = grid.columnOf(x), row = grid.rowOf(y);
  if (!grid.holds(column, row)) return {};
  return classifyIn(grid.index(static_cast<int>(column), static_cast<int>(row)), z, intensity);
}

MaximumLikelihood::Decision PointClassifier::classifyIn(std::size_t cell, double z,
                                                        double intensity) const {
  constexpr std::size_t kOnStack = 16;
  double few[kOnStack];
  std::vector<double> many(sources_.size() > kOnStack ? sources_.size() : 0);
  double* values = many.empty() ? few : many.data();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const double of_cell = bands_[i] == nullptr ? 0.0 : static_cast<double>(bands_[i][cell]);
    switch (sources_[i]) {
      case Source::cell:
        values[i] = of_cell;
        break;
      case Source::above_terrain:
        values[i] = z - of_cell;
        break;
      case Source::elevation:
        values[i] = z;
        break;
      case Source::intensity:
        values[i] = intensity;
        break;
    }
  }
  return classifier_->classify(values);
}

std::uint8_t asprsCodeOf(const std::string& class_name) {
  static const std::map<std::string, std::uint8_t> codes{
      {"tree", 5},  {"trees", 5},    {"grass", 3},    {"soil", 2},  {"ground", 2},
      {"road", 11}, {"built-up", 6}, {"building", 6}, {"water", 9}, {"vegetation", 5}};
  const auto found = codes.find(class_name);
  return found == codes.end() ? std::uint8_t{1} : found->second;
}

}  // namespace pcl_als
