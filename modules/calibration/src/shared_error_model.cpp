// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include <pcl_als/common/errors.h>

#include "shared_errors.h"

namespace pcl_als {

void SharedErrorModel::validate() const {
  const std::pair<const char*, double> values[] = {
      {"trajectory position sigma (m)", position},
      {"trajectory roll and pitch sigma (rad)", roll_pitch},
      {"trajectory heading sigma (rad)", heading},
      {"trajectory correlation time (s)", correlation_time},
      {"trajectory knot spacing (s)", knot_spacing},
      {"share of constant trajectory errors", constant_share},
      {"share of smooth trajectory errors", smooth_share},
      {"share of Gauss-Markov trajectory errors", 1.0 - constant_share - smooth_share},
      {"local shift sigma (m)", local}};
  for (const auto& [name, value] : values) {
    if (std::isfinite(value) && value > 0.0) continue;
    std::ostringstream text;
    text << name << " must be positive, is " << value;
    throw UsageError(text.str());
  }
  for (const ErrorSourceInfo& info : errorSources()) {
    const SourcePrior& prior = sources[static_cast<std::size_t>(indexOf(info.source))];
    if (prior.std > prior.std_absent && prior.std_absent >= 0.0 && prior.absent >= 0.0 &&
        prior.absent < 1.0)
      continue;
    throw UsageError("prior of " + std::string(info.name) +
                     ": the probability must be in [0, 1), and the standard deviation larger than "
                     "that of an absent error");
  }
}

namespace {

/// Length of the union of some spans, seconds.
double coveredTime(std::vector<TimeSpan> spans) {
  std::sort(spans.begin(), spans.end());
  double covered = 0.0, end = -HUGE_VAL;
  for (const auto& [from, to] : spans) {
    covered += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return covered;
}

}  // namespace

SharedErrorModel withKnotsFor(SharedErrorModel model,
                              const std::vector<std::vector<TimeSpan>>& observed) {
  constexpr double kKnots = 150.0, kClosest = 0.4;
  double time = 0.0;
  for (const std::vector<TimeSpan>& of_strip : observed) time += coveredTime(of_strip);
  model.knot_spacing = std::min(model.knot_spacing, std::max(kClosest, time / kKnots));
  return model;
}

bool SharedErrorModel::isDetermined(double value, double std, double prior_std) {
  constexpr double kNotZero = 4.0;  // standard deviations
  return std < kDetermined * prior_std || std::abs(value) > kNotZero * std;
}

SharedErrorModel SharedErrorModel::ofGrade(const std::string& grade) {
  struct Grade {
    const char* name;
    double position, roll_pitch, heading;  // metres, arc-seconds
  };
  constexpr Grade kGrades[] = {
      {"survey", 0.02, 9.0, 18.0}, {"tactical", 0.03, 54.0, 126.0}, {"mems", 0.04, 90.0, 288.0}};
  SharedErrorModel model;
  for (const Grade& known : kGrades) {
    if (grade != known.name) continue;
    model.position = known.position;
    model.roll_pitch = known.roll_pitch * kRadiansPerArcsec;
    model.heading = known.heading * kRadiansPerArcsec;
    return model;
  }
  throw UsageError("'" + grade + "' is none of survey, tactical, mems");
}

std::array<double, VarianceFactors::kCount> VarianceFactors::values() const {
  return {gauss_markov.position, gauss_markov.roll_pitch,
          gauss_markov.heading,  smooth.position,
          smooth.roll_pitch,     smooth.heading,
          constant.position,     constant.roll_pitch,
          constant.heading,      local};
}

VarianceFactors VarianceFactors::of(const std::array<double, kCount>& v) {
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}, v[9]};
}

bool VarianceFactors::near(const VarianceFactors& other) const {
  const auto mine = values(), theirs = other.values();
  return std::equal(mine.begin(), mine.end(), theirs.begin(),
                    [](double a, double b) { return std::max(a, b) <= 1.5 * std::min(a, b); });
}

std::vector<TimeSpan> continuousSpans(const std::vector<double>& times) {
  constexpr double kGap = 10.0;  // seconds: far more than between two looks at the same ground
  std::map<double, TimeSpan> by_interval;
  for (const double time : times) {
    TimeSpan& span = by_interval.try_emplace(std::floor(time / kGap), time, time).first->second;
    span = {std::min(span.first, time), std::max(span.second, time)};
  }
  std::vector<TimeSpan> spans;
  for (const auto& [interval, span] : by_interval) {
    if (!spans.empty() && span.first - spans.back().second <= kGap)
      spans.back().second = span.second;
    else
      spans.push_back(span);
  }
  return spans;
}

std::vector<std::vector<TimeSpan>> observedTimes(const std::vector<AreaObservations>& areas,
                                                 std::size_t strips) {
  std::vector<std::vector<TimeSpan>> times(strips);
  for (const AreaObservations& area : areas) {
    std::map<int, std::vector<double>> here;
    for (const PairObservation& o : area) {
      if (o.a != PairObservation::kControl) here[o.a].push_back(o.time_a);
      if (!o.hasMixedTimes()) {
        here[o.b].push_back(o.time_b);
        continue;
      }
      for (const auto& vertex : o.special->vertices) here[o.b].push_back(vertex.time);
    }
    for (const auto& [strip, of_strip] : here) {
      const std::vector<TimeSpan> spans = continuousSpans(of_strip);
      auto& all = times[static_cast<std::size_t>(strip)];
      all.insert(all.end(), spans.begin(), spans.end());
    }
  }
  return times;
}

}  // namespace pcl_als
