// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/common/control_groups.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/quality/control_check.h>

namespace pcl_als {
namespace {

constexpr double kCommon = 3.0;           // standard deviations of a point
constexpr double kLeastScatter = 0.01;    // metres: three points may agree by chance
constexpr std::size_t kFewestCommon = 3;  // points
constexpr double kReliable = 20.0;        // variance of the slopes over that of their errors
constexpr double kLargestPlanStd = 0.5;   // metres: larger ones do not determine a shift
constexpr std::size_t kUnknowns = 3;      // of a movement
constexpr double kChanceInPlan = 0.001;   // of a significant shift, two-sided

/// Id and mean difference of each point, of one strip or of all, by id.
std::vector<std::pair<std::string, double>> byPoint(
    const std::vector<ControlDifference>& differences, const std::string& strip) {
  std::map<std::string, RunningStatistics> points;
  for (const ControlDifference& d : differences)
    if (d.unfit.empty() && (strip.empty() || d.strip == strip)) points[d.point].add(d.above);
  std::vector<std::pair<std::string, double>> means;
  for (const auto& [point, heights] : points) means.emplace_back(point, heights.mean());
  return means;
}

Eigen::Vector2d slopeOf(const ControlDifference& d) {
  return d.normal.head<2>() / d.normal.z();
}

/// Whether slopes vary by far more than they are uncertain: else their errors make a shift small.
bool slopesAreReliable(const std::vector<const ControlDifference*>& used) {
  const auto count = static_cast<double>(used.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const ControlDifference* d : used) mean += slopeOf(*d) / count;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  double errors = 0.0;
  for (const ControlDifference* d : used) {
    const Eigen::Vector2d slope = slopeOf(*d) - mean;
    spread += slope * slope.transpose() / count;
    errors += d->slope_std * d->slope_std / count;
  }
  return symmetricEigen2(spread).values.minCoeff() > kReliable * errors;
}

}  // namespace

std::string CommonOffset::describe() const {
  char size[64];
  std::snprintf(size, sizeof size, " %.2f ± %.2f m %s ", std::abs(offset), std::max(std, 0.005),
                offset < 0.0 ? "below" : "above");
  return (strip.empty() ? "the strips lie" : "strip " + strip + " lies") + size +
         (points == covered ? "all " + counted(covered, "control point")
                            : std::to_string(points) + " of " + counted(covered, "control point")) +
         (strip.empty() ? "" : " that it covers");
}

std::string ContradictingControl::describe() const {
  return "strip " + strip + " lies " + ControlGroups{separation, lower, higher}.describe();
}

std::optional<ContradictingControl> contradictingControl(
    const std::vector<ControlDifference>& differences, const std::vector<std::string>& strips,
    double survey_sigma) {
  std::optional<ContradictingControl> found;
  std::size_t most = 0;
  for (const std::string& strip : strips) {
    auto heights = byPoint(differences, strip);
    if (heights.size() <= most) continue;
    const std::size_t points = heights.size();
    auto groups = controlGroups(std::move(heights), std::max(survey_sigma, kLeastScatter));
    if (!groups) continue;
    found = {strip, groups->separation, groups->lower, groups->higher};
    most = points;
  }
  return found;
}

std::optional<CommonOffset> commonOffset(const std::vector<ControlDifference>& differences,
                                         const std::string& strip, double survey_sigma) {
  std::vector<double> heights;
  for (const auto& [point, height] : byPoint(differences, strip)) heights.push_back(height);
  if (heights.size() < kFewestCommon) return std::nullopt;
  std::vector<double> sorted = heights;
  const double median = medianInPlace(sorted);
  const double tolerance = kCommon * std::max({robustSigma(heights), survey_sigma, kLeastScatter});
  if (!(std::abs(median) > tolerance)) return std::nullopt;
  RunningStatistics agreeing;
  for (const double height : heights)
    if (std::abs(height - median) <= tolerance) agreeing.add(height);
  if (agreeing.count() < kFewestCommon || 2 * agreeing.count() <= heights.size())
    return std::nullopt;
  CommonOffset found;
  found.strip = strip;
  found.offset = agreeing.mean();
  found.std = agreeing.standardDeviation() / std::sqrt(static_cast<double>(agreeing.count()));
  found.points = agreeing.count();
  found.covered = heights.size();
  return found;
}

std::vector<CommonOffset> commonOffsets(const std::vector<ControlDifference>& differences,
                                        const std::vector<std::string>& strips,
                                        double survey_sigma) {
  if (const auto all = commonOffset(differences, {}, survey_sigma)) return {*all};
  std::vector<CommonOffset> found;
  for (const std::string& strip : strips)
    if (const auto one = commonOffset(differences, strip, survey_sigma)) found.push_back(*one);
  return found;
}

HorizontalShift shiftOntoControl(const std::vector<ControlDifference>& differences) {
  HorizontalShift found;
  std::vector<const ControlDifference*> used;
  std::map<std::string, std::int64_t> points;
  for (const ControlDifference& d : differences) {
    if (!d.unfit.empty()) continue;
    used.push_back(&d);
    points.emplace(d.point, static_cast<std::int64_t>(points.size()));
  }
  found.count = points.size();
  if (found.count <= kUnknowns || !slopesAreReliable(used)) {
    found.reason = found.count <= kUnknowns ? "too few control points"
                                            : "the ground at the control points is too level, or "
                                              "faces one way only";
    return found;
  }
  ClusteredRegression equations(static_cast<int>(kUnknowns));
  for (const ControlDifference* d : used) {
    const Eigen::Vector2d slope = slopeOf(*d);
    equations.add(points.at(d->point), Eigen::Vector3d(-slope.x(), -slope.y(), -1.0), d->above,
                  d->position.head<2>());
  }
  const ClusteredRegression::Result result = equations.solve(true);
  found.rms = result.rms;
  for (int i = 0; i < 3; ++i) {
    found.std[i] = result.std(i);
    found.std_formal[i] = result.formalStd(i);
  }
  found.determined = result.determined && found.std.head<2>().maxCoeff() < kLargestPlanStd;
  if (found.determined)
    found.shift = result.estimate;
  else
    found.reason = "the slopes at the control points are too small for their scatter";
  return found;
}

bool isSignificantInPlan(const HorizontalShift& shift) {
  if (!shift.determined) return false;
  const double limit =
      studentCritical(0.5 * kChanceInPlan, static_cast<double>(shift.count - kUnknowns));
  return (shift.shift.head<2>().cwiseAbs().array() > limit * shift.std.head<2>().array()).any();
}

}  // namespace pcl_als
