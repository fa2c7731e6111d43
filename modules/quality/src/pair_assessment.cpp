// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/pair_assessment.h>

#include "strip_triples.h"

namespace pcl_als {
namespace {

constexpr std::size_t kFewest = 50;       // least number of level places of a pair
constexpr std::size_t kFewestInCell = 5;  // for the mean of a cell
constexpr double kSteep = 10.0 * kRadiansPerDegree;
constexpr double kChance = 0.05;        // of a change of the shift that counts
constexpr double kLeastVertical = 0.5;  // cosine: 60 degrees, the steepest of the slope classes
// metres: shifts with larger standard deviations are not determined
constexpr double kLargestShiftStd = 0.5;
constexpr double kCopied = 0.5;                                       // share of identical points
constexpr double kSlopeSteps[] = {0.0, 5.0, 10.0, 20.0, 30.0, 60.0};  // degrees
constexpr int kAspects = 8;

OffsetSummary summaryOf(const std::vector<OffsetSample>& samples, bool level) {
  std::vector<double> values;
  std::vector<std::int64_t> clusters;
  std::vector<Eigen::Vector2d> places;
  for (const OffsetSample& s : samples) {
    if (!(level ? s.level : s.conjugate)) continue;
    values.push_back(level ? s.vertical : s.normal_distance);
    clusters.push_back(s.cluster());
    places.emplace_back(s.position.head<2>());
  }
  return summarize(std::move(values), clusters, places);
}

OffsetSummary cellSummary(const std::vector<OffsetSample>& samples) {
  std::vector<double> means;
  std::vector<std::int64_t> clusters;
  std::vector<Eigen::Vector2d> places;
  for (const auto& [cluster, mean] : cellMeans(samples)) {
    means.push_back(mean);
    clusters.push_back(cluster);
    places.push_back(OffsetSample::centreOf(cluster));
  }
  return summarize(std::move(means), clusters, places);
}

/// How the height varies over the overlap that remains when \a b is shifted (OverlapVariation).
double variationOfHeight(const std::vector<OffsetSample>& samples, const Eigen::Vector3d& shift) {
  OverlapVariation variation;
  for (const OffsetSample& s : samples) {
    if (!s.conjugate || s.normal.z() < kLeastVertical) continue;
    variation.add(s.cluster(), s.position.head<2>(),
                  (s.normal_distance - s.normal.dot(shift)) / s.normal.z());
  }
  return variation.ofOffset();
}

/// Squares of what the shift changes by if the strips may be tilted against each other, where this
/// is significant (95 %): slopes that face different ways lie at different places.
Eigen::Vector3d changeByTilt(const std::vector<OffsetSample>& samples,
                             const ClusteredRegression::Result& shift) {
  constexpr double kScale = 100.0;  // metres: rows of size about 1
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const OffsetSample& s : samples)
    centre += s.position.head<2>() / static_cast<double>(samples.size());
  ClusteredRegression tilted(5);
  for (const OffsetSample& s : samples) {
    if (!s.conjugate || s.slope <= kSteep) continue;
    Eigen::VectorXd row(5);
    row << s.normal, s.normal.z() * (s.position.head<2>() - centre) / kScale;
    tilted.add(s.cluster(), row, s.normal_distance, s.position.head<2>(), s.normal);
  }
  const ClusteredRegression::Result fit = tilted.solve(true);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  if (!fit.determined) return squares;
  const double limit = chiSquaredCritical(kChance, 1.0);
  for (int i = 0; i < 3; ++i) {
    const double change = fit.estimate[i] - shift.estimate[i];
    const double chance = std::max(0.0, fit.covariance(i, i) - shift.covariance(i, i));
    if (change * change > limit * chance) squares[i] = change * change - chance;
  }
  return squares;
}

HorizontalShift horizontalShift(const std::vector<OffsetSample>& samples) {
  HorizontalShift found;
  ClusteredRegression equations(3);
  for (const OffsetSample& s : samples) {
    if (s.conjugate && s.slope > kSteep)
      equations.add(s.cluster(), s.normal, s.normal_distance, s.position.head<2>(), s.normal);
  }
  found.count = equations.count();
  const ClusteredRegression::Result result = equations.solve(true);
  if (!result.determined) {
    found.reason = "too few slopes over 10 degrees";
    return found;
  }
  for (int i = 0; i < 3; ++i) {
    found.std[i] = result.std(i);
    found.std_formal[i] = result.formalStd(i);
  }
  Eigen::Vector3d deformation = changeByTilt(samples, result);
  deformation[2] += variationOfHeight(samples, result.estimate);
  const Eigen::Vector3d raised = (found.std_formal.cwiseAbs2() + deformation).cwiseSqrt();
  found.std = found.std.cwiseMax(raised);
  found.rms = result.rms;
  if (!(found.std.maxCoeff() < kLargestShiftStd)) {
    found.reason = "slopes over 10 degrees do not face in enough directions";
    return found;
  }
  found.shift = -result.estimate;
  found.determined = true;
  return found;
}

int aspectOf(const Eigen::Vector3d& normal) {
  const double azimuth = std::atan2(normal.x(), normal.y());  // clockwise from north
  return static_cast<int>(std::lround(azimuth / (2.0 * kPi) * kAspects) + kAspects) % kAspects;
}

std::vector<SlopeAspectClass> slopeAspectClasses(const std::vector<OffsetSample>& samples) {
  std::vector<SlopeAspectClass> classes;
  for (std::size_t step = 0; step + 1 < std::size(kSlopeSteps); ++step) {
    const double from = kSlopeSteps[step], to = kSlopeSteps[step + 1];
    std::vector<RunningStatistics> by_aspect(kAspects);
    RunningStatistics all;
    for (const OffsetSample& s : samples) {
      const double slope = s.slope / kRadiansPerDegree;
      if (!s.conjugate || slope < from || slope >= to) continue;
      all.add(s.normal_distance);
      by_aspect[static_cast<std::size_t>(aspectOf(s.normal))].add(s.normal_distance);
    }
    classes.push_back({from, to, -1, all.count(), all.mean(), all.rms()});
    if (to <= kSlopeSteps[1]) continue;  // the aspect of level ground is noise
    for (int aspect = 0; aspect < kAspects; ++aspect) {
      const RunningStatistics& sum = by_aspect[static_cast<std::size_t>(aspect)];
      classes.push_back({from, to, aspect, sum.count(), sum.mean(), sum.rms()});
    }
  }
  return classes;
}

}  // namespace

const char* aspectName(int aspect) {
  static const char* const names[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  return aspect < 0 ? "all" : names[aspect % kAspects];
}

const char* toString(PairAssessment::Status status) {
  static const char* const names[] = {"judged", "too_little", "copy", "too_far"};
  return names[static_cast<int>(status)];
}

const char* toString(FlightRelation relation) {
  static const char* const names[] = {"unknown", "parallel", "opposite", "crossing"};
  return names[static_cast<int>(relation)];
}

PairAssessment assessPair(const std::vector<OffsetSample>& samples,
                          const std::optional<Eigen::Vector2d>& course_a,
                          const std::optional<Eigen::Vector2d>& course_b) {
  PairAssessment pair;
  std::size_t identical = 0;
  for (const OffsetSample& s : samples) identical += s.identical ? 1 : 0;
  pair.vertical = summaryOf(samples, true);
  pair.normal = summaryOf(samples, false);
  pair.vertical_cells = cellSummary(samples);
  if (!samples.empty() &&
      static_cast<double>(identical) > kCopied * static_cast<double>(samples.size())) {
    pair.status = PairAssessment::Status::copy;
    pair.reason = "both hold the same points: one is a copy of the other";
    return pair;
  }
  pair.classes = slopeAspectClasses(samples);
  pair.horizontal = horizontalShift(samples);
  pair.trends = overlapTrends(samples, course_a, course_b);
  if (pair.vertical.count < kFewest ||
      pair.vertical_cells.count < ClusteredRegression::kFewestClusters) {
    pair.reason = "only " + std::to_string(pair.vertical.count) +
                  " places on smooth level single-return ground in common, " +
                  std::to_string(kFewest) + " in " +
                  std::to_string(ClusteredRegression::kFewestClusters) +
                  " cells of 25 m are required";
    return pair;
  }
  pair.status = PairAssessment::Status::judged;
  pair.quality_level = swathQualityLevel(pair.vertical.rms);
  return pair;
}

CellMeans cellMeans(const std::vector<OffsetSample>& samples) {
  std::map<std::int64_t, RunningStatistics> cells;
  for (const OffsetSample& s : samples) {
    if (s.level) cells[s.cluster()].add(s.vertical);
  }
  CellMeans means;
  for (const auto& [cluster, cell] : cells) {
    if (cell.count() >= kFewestInCell) means[cluster] = cell.mean();
  }
  return means;
}

std::vector<TriangleClosure> closeTriangles(const std::vector<PairOffset>& pairs) {
  std::vector<TriangleClosure> triangles;
  for (const detail::StripTriple& triple : detail::stripTriples(pairs)) {
    const CellMeans &ab = pairs[triple.ab.pair].cells, &bc = pairs[triple.bc.pair].cells,
                    &ac = pairs[triple.ac.pair].cells;
    RunningStatistics closures;
    for (const auto& [cell, first] : ab) {
      const auto second = bc.find(cell), third = ac.find(cell);
      if (second == bc.end() || third == ac.end()) continue;
      closures.add(triple.ab.sign * first + triple.bc.sign * second->second -
                   triple.ac.sign * third->second);
    }
    if (closures.count() < ClusteredRegression::kFewestClusters) continue;
    triangles.push_back(
        {triple.a, triple.b, triple.c, closures.count(), closures.mean(),
         closures.standardDeviation() / std::sqrt(static_cast<double>(closures.count()))});
  }
  return triangles;
}

}  // namespace pcl_als
