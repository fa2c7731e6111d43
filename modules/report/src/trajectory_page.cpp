// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/block_map.h>
#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/report/trajectory_page.h>

#include "report_parts.h"

namespace pcl_als {
namespace {

constexpr double kDegree = 180.0 / kPi;

std::string evidenceOf(const ReconstructedPath& path) {
  if (!path.found) return path.reason;
  if (!path.angles.used) return "rays";
  return path.rays > path.rejected ? "rays and scan angles" : "scan angles";
}

ReportTable pathTable(const ReconstructedTrajectory& flight) {
  ReportTable table{"paths",
                    "Paths by strip: height above ground, RMS over time of the standard deviations "
                    "east, north and up, m; evidence that determined them",
                    {"strip", "from, s", "to, s", "height", "east", "north", "up", "evidence"},
                    {}};
  for (const ReconstructedPath& path : flight.paths) {
    const Eigen::Vector3d std = path.meanStd();
    auto& row = table.rows.emplace_back();
    row = {path.name, numberText(path.times.first, 2), numberText(path.times.last, 2)};
    if (path.found) {
      row.push_back(numberText(path.height, 0));
      for (const double value : std) row.push_back(numberText(value, 3));
    }
    row.push_back(evidenceOf(path));
  }
  return table;
}

ReportTable rayTable(const ReconstructedTrajectory& flight) {
  ReportTable table{"rays",
                    "Rays through two returns of a pulse: number, those that miss the path, median "
                    "separation of the returns (m); standard deviation of a return across its ray "
                    "and of a ray apart from it (m)",
                    {"strip", "rays", "excluded", "separation", "across", "apart"},
                    {}};
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found || path.rays == 0) continue;
    table.rows.push_back({path.name, grouped(path.rays), grouped(path.rejected),
                          numberText(path.separation, 1), numberText(path.across, 4),
                          numberText(path.apart, 3)});
  }
  return table;
}

ReportTable angleTable(const ReconstructedTrajectory& flight) {
  ReportTable table{
      "angles",
      "Recorded scan angles where they determined the path: scale (relative), offset, "
      "changes with time such as roll and noise of a mean (degrees)",
      {"strip", "positive", "scale", "std", "offset", "std", "roll", "noise"},
      {}};
  for (const ReconstructedPath& path : flight.paths) {
    const ReconstructedPath::Angles& a = path.angles;
    if (!path.found || !a.used) continue;
    table.rows.push_back({path.name, a.right_positive ? "to the right" : "to the left",
                          numberText(a.scale, 4), numberText(a.scale_std, 4),
                          numberText(kDegree * a.offset, 2), numberText(kDegree * a.offset_std, 2),
                          numberText(kDegree * a.roll, 3), numberText(kDegree * a.noise, 3)});
  }
  return table;
}

/// Standard deviations of each path over time.
CurvePanels stdPanels(const ReconstructedTrajectory& flight) {
  CurvePanels panels;
  panels.title = "Standard deviations of the position";
  panels.x_label = "seconds from the beginning of the strip";
  panels.y_label = "m";
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found) continue;
    CurvePanels::Panel& panel = panels.panels.emplace_back();
    panel.title = "strip " + path.name;
    panel.series = {{"east", {}, {}, {}}, {"north", {}, {}, {}}, {"up", {}, {}, {}}};
    for (const PathSample& sample : path.samples) {
      for (int axis = 0; axis < 3; ++axis) {
        CurvePlot::Series& series = panel.series[static_cast<std::size_t>(axis)];
        series.x.push_back(sample.time - path.samples.front().time);
        series.y.push_back(std::sqrt(sample.covariance(axis, axis)));
      }
    }
  }
  panels.keepLargest();
  return panels;
}

CurvePanels residualPanels(const ReconstructedTrajectory& flight) {
  CurvePanels panels;
  panels.title = "Distances of rays from the path, in standard deviations";
  panels.x_label = "tenth of the strip's time";
  panels.y_label = "RMS";
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found || path.rays == 0) continue;
    CurvePanels::Panel& panel = panels.panels.emplace_back();
    panel.title = "strip " + path.name;
    CurvePlot::Series& series = panel.series.emplace_back();
    series.name = "rays";
    for (std::size_t k = 0; k < path.residuals.size(); ++k) {
      series.x.push_back(static_cast<double>(k) + 0.5);
      series.y.push_back(path.residuals[k]);
    }
  }
  panels.keepLargest();
  return panels;
}

/// The enlargement with which the largest of the typical standard deviations is a hundredth of the
/// extent: a power of ten.
double enlargementFor(const std::vector<BlockMap::Path>& paths, double extent) {
  double largest = 0.0;
  for (const BlockMap::Path& path : paths)
    for (const Eigen::Vector2d& std : path.std) largest = std::max(largest, std.maxCoeff());
  return largest > 0.0 ? std::pow(10.0, std::floor(std::log10(0.1 * extent / largest))) : 1.0;
}

void addPathMap(const ReconstructedTrajectory& flight, const StripCoverage& coverage,
                const std::vector<std::string>& strips, HtmlReport& report) {
  std::vector<BlockMap::Path> paths;
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found) continue;
    BlockMap::Path& shown = paths.emplace_back();
    for (const PathSample& sample : path.samples) {
      shown.places.emplace_back(sample.position.head<2>());
      shown.std.emplace_back(sample.covariance.diagonal().head<2>().cwiseSqrt());
    }
  }
  const double extent = coverage.cell() * std::max(coverage.columns(), coverage.rows());
  const double enlargement = enlargementFor(paths, extent);
  BlockMap map;
  map.setTitle("Reconstructed path and strips");
  map.setPaths(std::move(paths), enlargement);
  report.addPicture(
      map.draw(coverage, strips, {1400, BlockMap::heightFor(coverage, 1400)}),
      "The path of the sensor (black) over the ground that its strips cover. Crosses: standard "
      "deviations east and north, enlarged " +
          numberText(enlargement, 0) + " times.");
}

Verdict verdictOf(const ReconstructedTrajectory& flight) {
  Verdict verdict;
  std::size_t found = 0;
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found) continue;
    ++found;
    largest = largest.cwiseMax(path.meanStd());
  }
  verdict.grade = !flight.incomplete.empty()    ? VerdictGrade::bad
                  : found < flight.paths.size() ? VerdictGrade::attention
                                                : VerdictGrade::good;
  verdict.headline = "The trajectory of " + grouped(found) + " of " + grouped(flight.paths.size()) +
                     " passes was found from their points.";
  verdict.sentences.push_back("Standard deviations are at most " + numberText(largest.x(), 3) +
                              " m east, " + numberText(largest.y(), 3) + " m north and " +
                              numberText(largest.z(), 3) + " m up (RMS of a pass over time).");
  if (!flight.attitude.empty()) verdict.sentences.push_back("Attitude: " + flight.attitude + ".");
  if (!flight.incomplete.empty()) verdict.sentences.push_back(flight.incomplete + ".");
  return verdict;
}

}  // namespace

struct TrajectoryPage::State {
  ObservedBlock block;
};

TrajectoryPage::TrajectoryPage(bool wanted) {
  if (wanted) state_ = std::make_unique<State>();
}

TrajectoryPage::~TrajectoryPage() = default;

SurveyObserver TrajectoryPage::observer() {
  return state_ ? state_->block.observer() : SurveyObserver();
}

void TrajectoryPage::write(const ReportOrigin& origin, const ReconstructedTrajectory& flight,
                           const std::vector<std::string>& files) const {
  HtmlReport report(origin.titleOr("Trajectory from points"), origin.program);
  addVerdict(verdictOf(flight), report);
  addWarnings(flight.warnings, report);
  report.addSection("Paths");
  report.addTable(pathTable(flight));
  addPathMap(flight, *state_->block.coverage, state_->block.strips, report);
  const CurvePanels stds = stdPanels(flight);
  report.addPicture(drawCurvePanels(stds, stds.panels.size() > 4 ? kTall : kWide),
                    "Standard deviations of the position over time: large where the ground shows "
                    "few second returns.");
  report.addSection("Evidence");
  const ReportTable rays = rayTable(flight), angles = angleTable(flight);
  if (!rays.rows.empty()) {
    report.addTable(rays);
    const CurvePanels residuals = residualPanels(flight);
    report.addPicture(drawCurvePanels(residuals, residuals.panels.size() > 4 ? kTall : kWide),
                      "Distances of the rays from the path over their standard deviations: about "
                      "one everywhere where the path is flexible enough.");
  }
  if (!angles.rows.empty()) report.addTable(angles);
  addOrigin(origin, files, report);
  report.write(origin.folder);
}

}  // namespace pcl_als
