// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/quality/pair_assessment.h>

namespace pcl_als {
namespace {

constexpr int kBins = 20;
// radians: lines with a larger angle are crossing
constexpr double kParallel = 20.0 * kRadiansPerDegree;

using Samples = std::vector<const OffsetSample*>;

FlightRelation relationOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double cosine = a.dot(b);
  if (cosine > std::cos(kParallel)) return FlightRelation::parallel;
  return cosine < -std::cos(kParallel) ? FlightRelation::opposite : FlightRelation::crossing;
}

Eigen::Vector2d longerAxis(const Samples& samples) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const OffsetSample* s : samples) mean += s->position.head<2>();
  mean /= static_cast<double>(samples.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const OffsetSample* s : samples) {
    const Eigen::Vector2d d = s->position.head<2>() - mean;
    spread += d * d.transpose();
  }
  return symmetricEigen2(spread).vectors.col(1);
}

/// The middle of the overlap: halfway between its edges across and along, without outliers.
Eigen::Vector2d middleOf(const Samples& samples, const Eigen::Vector2d& course) {
  const Eigen::Vector2d right(course.y(), -course.x());
  const Eigen::Vector2d origin = samples.front()->position.head<2>();
  Eigen::Vector2d middle = origin;
  for (const Eigen::Vector2d& axis : {right, course}) {
    std::vector<double> places;
    for (const OffsetSample* s : samples)
      places.push_back((s->position.head<2>() - origin).dot(axis));
    std::sort(places.begin(), places.end());
    const std::size_t aside = places.size() / 100;
    middle += 0.5 * (places[aside] + places[places.size() - 1 - aside]) * axis;
  }
  return middle;
}

/// Straight line of the offsets over \a place, which is given about its mean.
template <typename Place>
Trend trendOver(const Samples& samples, Place place) {
  double mean = 0.0, largest = 0.0;
  for (const OffsetSample* s : samples) mean += place(*s) / static_cast<double>(samples.size());
  for (const OffsetSample* s : samples) largest = std::max(largest, std::abs(place(*s) - mean));
  Trend trend;
  if (!(largest > 1e-6)) return trend;  // no scan angles or times: no trend
  ClusteredRegression line(2);
  for (const OffsetSample* s : samples)
    line.add(s->cluster(), Eigen::Vector2d(1.0, (place(*s) - mean) / largest), s->vertical,
             s->position.head<2>());
  const ClusteredRegression::Result result = line.solve();
  trend.determined = result.determined;
  if (!trend.determined) return trend;
  trend.slope = result.estimate[1] / largest;
  trend.std = result.std(1) / largest;
  return trend;
}

template <typename Place>
std::vector<ProfileBin> profileOver(const Samples& samples, Place place) {
  double low = place(*samples.front()), high = low;
  for (const OffsetSample* s : samples) {
    low = std::min(low, place(*s));
    high = std::max(high, place(*s));
  }
  if (!(high - low > 1e-6)) return {};
  std::vector<RunningStatistics> sums(kBins);
  for (const OffsetSample* s : samples) {
    const int bin = static_cast<int>(kBins * (place(*s) - low) / (high - low));
    sums[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))].add(s->vertical);
  }
  std::vector<ProfileBin> bins;
  const double width = (high - low) / kBins;
  for (int i = 0; i < kBins; ++i) {
    const RunningStatistics& sum = sums[static_cast<std::size_t>(i)];
    bins.push_back(
        {low + i * width, low + (i + 1) * width, sum.count(), sum.mean(), sum.standardDeviation()});
  }
  return bins;
}

/// Plane of the offsets over the ground: the trends across and along, and the roll that they
/// indicate.
void fitPlane(const Samples& samples, const std::optional<Eigen::Vector2d>& course_b,
              OverlapTrends& trends) {
  constexpr double kScale = 100.0;  // metres
  ClusteredRegression plane(3);
  for (const OffsetSample* s : samples) {
    plane.add(s->cluster(),
              Eigen::Vector3d(1.0, trends.distance(s->position) / kScale,
                              trends.distanceAlong(s->position) / kScale),
              s->vertical, s->position.head<2>());
  }
  const ClusteredRegression::Result fit = plane.solve();
  if (!fit.determined) return;
  trends.across = {true, fit.estimate[1] / kScale, fit.std(1) / kScale};
  trends.along = {true, fit.estimate[2] / kScale, fit.std(2) / kScale};
  if (trends.relation == FlightRelation::opposite) {
    trends.roll = {true, -0.5 * trends.across.slope, 0.5 * trends.across.std};
  } else if (trends.relation == FlightRelation::parallel) {
    trends.roll = {true, -trends.across.slope, trends.across.std};
  } else if (trends.relation == FlightRelation::crossing) {
    // gradient = -right_a roll_a + right_b roll_b, with right_a and right_b in (across, along) of a
    const Eigen::Vector2d right_b(course_b->y(), -course_b->x());
    const Eigen::Vector2d right_a(trends.course.y(), -trends.course.x());
    Eigen::Matrix2d effect;
    effect << -1.0, right_b.dot(right_a), 0.0, right_b.dot(trends.course);
    const Eigen::Matrix2d inverse = effect.inverse();
    const Eigen::Vector2d rolls = inverse * fit.estimate.tail<2>() / kScale;
    const Eigen::Matrix2d covariance = inverse * fit.covariance.bottomRightCorner<2, 2>() *
                                       inverse.transpose() / (kScale * kScale);
    trends.roll = {true, rolls[0], std::sqrt(covariance(0, 0))};
    trends.roll_b = {true, rolls[1], std::sqrt(covariance(1, 1))};
  }
}

}  // namespace

OverlapTrends overlapTrends(const std::vector<OffsetSample>& samples,
                            const std::optional<Eigen::Vector2d>& course_a,
                            const std::optional<Eigen::Vector2d>& course_b) {
  OverlapTrends trends;
  Samples level;
  for (const OffsetSample& sample : samples) {
    if (sample.level) level.push_back(&sample);
  }
  if (level.empty()) return trends;
  trends.course = course_a ? *course_a : longerAxis(level);
  if (course_a && course_b) trends.relation = relationOf(*course_a, *course_b);
  trends.centre = middleOf(level, trends.course);
  fitPlane(level, course_b, trends);
  const auto time = [](const OffsetSample& s) { return s.time_a; };
  const auto angle = [](const OffsetSample& s) { return static_cast<double>(s.scan_angle_a); };
  const auto distance = [&](const OffsetSample& s) { return trends.distance(s.position); };
  trends.time = trendOver(level, time);
  trends.scan_angle = trendOver(level, angle);
  trends.by_distance = profileOver(level, distance);
  trends.by_time = profileOver(level, time);
  trends.by_scan_angle = profileOver(level, angle);
  return trends;
}

}  // namespace pcl_als
