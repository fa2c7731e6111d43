// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/processing/class_maps.h>
#include <pcl_als/processing/land_cover.h>

namespace pcl_als {
namespace {

constexpr int kWindow = 512;
constexpr int kMostCells = 1 << 20;

/// Cells whose centre may lie within a box, clipped to the grid; no columns when there are none.
RasterWindow windowOf(const RasterGrid& grid, const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high) {
  const auto clipped = [](long long value, int size) {
    return static_cast<int>(std::clamp<long long>(value, -1, size));
  };
  const int first_column = std::max(0, clipped(grid.columnOf(low.x()), grid.columns)),
            last_column =
                std::min(grid.columns - 1, clipped(grid.columnOf(high.x()), grid.columns));
  const int first_row = std::max(0, clipped(grid.rowOf(high.y()), grid.rows)),
            last_row = std::min(grid.rows - 1, clipped(grid.rowOf(low.y()), grid.rows));
  if (first_column > last_column || first_row > last_row) return {};
  return {first_column, first_row, last_column - first_column + 1, last_row - first_row + 1};
}

bool inside(const ClassSite& site, const Eigen::Vector2d& place) {
  bool odd = false;
  for (const auto& ring : site.rings)
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[i + 1];
      if ((a.y() > place.y()) == (b.y() > place.y())) continue;
      const double x = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (place.x() < x) odd = !odd;
    }
  return odd;
}

void boxOf(const ClassSite& site, double radius, Eigen::Vector2d& low, Eigen::Vector2d& high) {
  low = high = site.isArea() ? site.rings.front().front() : site.place;
  for (const auto& ring : site.rings)
    for (const Eigen::Vector2d& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (site.isArea()) return;
  low.array() -= radius;
  high.array() += radius;
}

std::size_t finite(const std::vector<Eigen::VectorXd>& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](const auto& v) { return v.allFinite(); }));
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

BandReader::BandReader(const std::filesystem::path& path, const std::vector<std::string>& bands)
    : reader_(path), names_(bands) {
  const std::vector<std::string>& present = reader_.layout().bands;
  for (const std::string& name : bands) {
    const auto found = std::find(present.begin(), present.end(), name);
    if (found == present.end()) throw InputError(path.string() + ": has no band " + name);
    indices_.push_back(static_cast<std::size_t>(found - present.begin()));
  }
}

std::vector<std::vector<float>> BandReader::read(const RasterWindow& window) {
  std::vector<std::vector<float>> values;
  for (const std::size_t index : indices_) {
    values.emplace_back(window.cells());
    reader_.read(index, window, values.back().data());
  }
  return values;
}

Raster BandReader::readRaster(const RasterWindow& window) {
  Raster raster;
  raster.grid = grid();
  raster.grid.west += window.column * raster.grid.cell;
  raster.grid.north -= window.row * raster.grid.cell;
  raster.grid.columns = window.columns;
  raster.grid.rows = window.rows;
  std::vector<std::vector<float>> values = read(window);
  for (std::size_t i = 0; i < values.size(); ++i)
    raster.bands.push_back({names_[i], std::move(values[i])});
  return raster;
}

namespace {

/// Adds the cells of a window that belong to the site.
void addCells(const ClassSite& site, double radius, const RasterWindow& window, BandReader& bands,
              SiteCells& cells) {
  const RasterGrid& grid = bands.grid();
  const auto values = bands.read(window);
  for (std::size_t i = 0; i < window.cells(); ++i) {
    const int column =
                  window.column + static_cast<int>(i % static_cast<std::size_t>(window.columns)),
              row = window.row + static_cast<int>(i / static_cast<std::size_t>(window.columns));
    const Eigen::Vector2d centre(grid.centreX(column), grid.centreY(row));
    const bool own = column == grid.columnOf(site.place.x()) && row == grid.rowOf(site.place.y());
    if (!(site.isArea() ? inside(site, centre) : own || (centre - site.place).norm() <= radius))
      continue;
    Eigen::VectorXd sample(static_cast<Eigen::Index>(values.size()));
    for (std::size_t band = 0; band < values.size(); ++band)
      sample[static_cast<Eigen::Index>(band)] = static_cast<double>(values[band][i]);
    cells.values.push_back(std::move(sample));
    cells.places.push_back(site.isArea() ? centre : site.place);
  }
}

}  // namespace

SiteCells cellsOf(const ClassSite& site, double radius, BandReader& bands) {
  Eigen::Vector2d low, high;
  boxOf(site, radius, low, high);
  const RasterWindow whole = windowOf(bands.grid(), low, high);
  SiteCells cells;
  if (whole.columns == 0) return cells;
  // A slender area's box may be the whole block: its values come in pieces.
  const int rows = std::max(1, kMostCells / whole.columns);
  for (int row = 0; row < whole.rows; row += rows)
    addCells(site, radius,
             {whole.column, whole.row + row, whole.columns, std::min(rows, whole.rows - row)},
             bands, cells);
  return cells;
}

TrainingReport collectTraining(const std::vector<ClassSite>& sites, double radius,
                               BandReader& bands) {
  TrainingReport report;
  std::map<std::string, std::size_t> order;
  std::size_t outside = 0, empty = 0;
  for (const ClassSite& site : sites) {
    const auto [entry, added] = order.emplace(site.name, report.classes.size());
    if (added) report.classes.push_back({site.name, {}});
    SiteCells cells = cellsOf(site, radius, bands);
    outside += cells.values.empty() ? 1 : 0;
    empty += !cells.values.empty() && finite(cells.values) == 0 ? 1 : 0;
    auto& samples = report.classes[entry->second].samples;
    for (Eigen::VectorXd& value : cells.values)
      if (value.allFinite()) samples.push_back(std::move(value));
  }
  if (outside > 0)
    report.remarks.push_back(counted(outside, "training site") + " outside of the rasters");
  if (empty > 0)
    report.remarks.push_back(counted(empty, "training site") + " on cells without values");
  return report;
}

CheckReport collectChecks(const std::vector<ClassSite>& sites, const MaximumLikelihood& classifier,
                          BandReader& bands) {
  CheckReport report;
  std::size_t outside = 0, unclassified = 0;
  std::map<std::string, std::size_t> untrained;
  const auto& classes = classifier.model().classes;
  for (const ClassSite& site : sites) {
    const SiteCells cells = cellsOf(site, 0.0, bands);
    outside += cells.values.empty() ? 1 : 0;
    const bool known = std::any_of(classes.begin(), classes.end(),
                                   [&](const auto& c) { return c.name == site.name; });
    if (!known) ++untrained[site.name];
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
      const int index = classifier.classify(cells.values[i].data()).index;
      const bool none = index == MaximumLikelihood::kNoClass;
      unclassified += none ? 1 : 0;
      report.sites.push_back(
          {cells.places[i], site.name, none ? "" : classes[static_cast<std::size_t>(index)].name});
    }
  }
  if (outside > 0)
    report.remarks.push_back(counted(outside, "check site") + " outside of the rasters, excluded");
  if (unclassified > 0)
    report.remarks.push_back(counted(unclassified, "check point") +
                             " on cells without a class, counted as wrong");
  for (const auto& [name, count] : untrained)
    report.remarks.push_back("class " + name + ": " + counted(count, "check site") +
                             " but no training; counted as wrong");
  return report;
}

std::vector<CodeMeaning> legendOf(const GaussianModel& model) {
  using Colour = std::array<std::uint8_t, 3>;
  static const std::map<std::string, Colour> known{
      {"tree", {0x1B, 0x7A, 0x3D}},     {"vegetation", {0x1B, 0x7A, 0x3D}},
      {"grass", {0xA6, 0xD8, 0x54}},    {"soil", {0xC8, 0x9B, 0x5A}},
      {"built-up", {0xD0, 0x43, 0x3A}}, {"building", {0xD0, 0x43, 0x3A}},
      {"road", {0x80, 0x80, 0x80}},     {"water", {0x3B, 0x7D, 0xC4}},
      {"ground", {0xC8, 0x9B, 0x5A}}};
  const std::vector<Colour>& others = spareColours();
  if (model.classes.size() > 254) throw UsageError("a map has at most 254 classes");
  std::vector<CodeMeaning> legend;
  std::size_t other = 0;
  for (const GaussianClass& c : model.classes) {
    const auto found = known.find(c.name);
    const Colour colour = found != known.end() ? found->second : others[other++ % others.size()];
    legend.push_back({static_cast<std::uint8_t>(legend.size() + 1), c.name, colour});
  }
  return legend;
}

namespace {

/// Codes, posteriors and counts of a window.
struct WindowClasses {
  std::vector<std::uint8_t> codes;
  std::vector<float> posteriors;
  CoverCounts counts;

  WindowClasses(const MaximumLikelihood& classifier,
                const std::vector<std::vector<float>>& values) {
    const std::size_t cells = values.front().size();
    codes.assign(cells, CodeRaster::kNoClass);
    posteriors.assign(cells, RasterBand::kNoValue);
    counts.cells.resize(classifier.model().classes.size());
    std::vector<double> sample(values.size());
    for (std::size_t i = 0; i < cells; ++i) {
      bool complete = true;
      for (std::size_t band = 0; band < values.size(); ++band) {
        sample[band] = static_cast<double>(values[band][i]);
        complete = complete && std::isfinite(sample[band]);
      }
      counts.without_values += complete ? 0 : 1;
      if (!complete) continue;
      const MaximumLikelihood::Decision decision = classifier.classify(sample.data());
      posteriors[i] = static_cast<float>(decision.posterior);
      if (decision.index == MaximumLikelihood::kNoClass) {
        ++counts.rejected;
      } else {
        codes[i] = static_cast<std::uint8_t>(decision.index + 1);
        ++counts.cells[static_cast<std::size_t>(decision.index)];
      }
    }
  }
};

}  // namespace

CoverCounts classifyCells(const MaximumLikelihood& classifier, BandReader& bands, int threads,
                          RasterWriter& map, RasterWriter* posterior,
                          const std::function<void(double)>& progress) {
  const RasterGrid& grid = bands.grid();
  std::vector<RasterWindow> windows;
  for (int row = 0; row < grid.rows; row += kWindow)
    for (int column = 0; column < grid.columns; column += kWindow)
      windows.push_back({column, row, std::min(kWindow, grid.columns - column),
                         std::min(kWindow, grid.rows - row)});
  CoverCounts all;
  all.cells.resize(classifier.model().classes.size());
  std::mutex files;
  std::size_t done = 0;
  parallelFor(windows.size(), threads, [&](std::size_t i) {
    std::vector<std::vector<float>> values;
    {
      const std::lock_guard<std::mutex> lock(files);
      values = bands.read(windows[i]);
    }
    const WindowClasses part(classifier, values);
    const std::lock_guard<std::mutex> lock(files);
    map.write(0, windows[i], part.codes.data());
    if (posterior != nullptr) posterior->write(0, windows[i], part.posteriors.data());
    for (std::size_t c = 0; c < all.cells.size(); ++c) all.cells[c] += part.counts.cells[c];
    all.rejected += part.counts.rejected;
    all.without_values += part.counts.without_values;
    progress(static_cast<double>(++done) / static_cast<double>(windows.size()));
  });
  return all;
}

void writeLegend(const std::filesystem::path& path, const std::vector<CodeMeaning>& legend) {
  std::string text = "value,class,red,green,blue\n";
  for (const CodeMeaning& entry : legend) {
    text += std::to_string(entry.value) + ',' + entry.name;
    for (const std::uint8_t part : entry.colour) text += ',' + std::to_string(part);
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace pcl_als
