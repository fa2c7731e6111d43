// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <pcl_als/calibration/shared_errors.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {

void SharedErrorModel::validate() const {
  const std::pair<const char*, double> values[] = {
      {"trajectory position sigma (m)", position},
      {"trajectory roll and pitch sigma (rad)", roll_pitch},
      {"trajectory heading sigma (rad)", heading},
      {"trajectory correlation time (s)", correlation_time},
      {"trajectory knot spacing (s)", knot_spacing},
      {"local shift sigma (m)", local},
      {"ranging share", ranging_incidence},
      {"range scale", range_scale}};
  if (!(ranging_absent >= 0.0 && ranging_absent < 1.0))
    throw UsageError("probability of no ranging error must be in [0, 1)");
  for (const auto& [name, value] : values) {
    if (std::isfinite(value) && value > 0.0) continue;
    std::ostringstream text;
    text << name << " must be positive, is " << value;
    throw UsageError(text.str());
  }
}

bool SharedErrorLevels::near(const SharedErrorLevels& other) const {
  const auto alike = [](double a, double b) { return std::max(a, b) <= 1.5 * std::min(a, b); };
  return alike(position, other.position) && alike(roll_pitch, other.roll_pitch) &&
         alike(heading, other.heading) && alike(local, other.local);
}

std::vector<std::vector<TimeSpan>> observedTimes(const std::vector<AreaObservations>& areas,
                                                 std::size_t strips) {
  std::vector<std::vector<TimeSpan>> times(strips);
  for (const AreaObservations& area : areas) {
    std::map<int, TimeSpan> here;
    for (const PairObservation& o : area) {
      for (const auto& [strip, time] : {std::pair(o.a, o.time_a), std::pair(o.b, o.time_b)}) {
        if (strip == PairObservation::kControl) continue;
        TimeSpan& span = here.try_emplace(strip, time, time).first->second;
        span = {std::min(span.first, time), std::max(span.second, time)};
      }
    }
    for (const auto& [strip, span] : here) times[static_cast<std::size_t>(strip)].push_back(span);
  }
  return times;
}

int SharedErrors::StripKnots::before(double step) const {
  const auto after = std::upper_bound(at.begin(), at.end(), step,
                                      [](double value, int knot) { return value < knot; });
  return std::max(0, static_cast<int>(after - at.begin()) - 1);
}

SharedErrors::StripKnots SharedErrors::knotsOf(const TimeSpan& span, double spacing,
                                               const std::vector<TimeSpan>* observed) {
  StripKnots strip;
  const double length = std::max(0.0, span.second - span.first);
  strip.start = span.first;
  strip.steps = static_cast<int>(std::ceil(length / spacing - 1e-9));
  strip.spacing = strip.steps > 0 ? length / strip.steps : 1.0;
  std::vector<bool> used(static_cast<std::size_t>(strip.steps) + 1, observed == nullptr);
  if (observed != nullptr && strip.steps > 0) {
    for (const auto& [from, to] : *observed) {
      const auto stepOf = [&](double time) {
        return std::clamp(static_cast<int>((time - strip.start) / strip.spacing), 0,
                          strip.steps - 1);
      };
      for (int step = stepOf(from); step <= stepOf(to) + 1; ++step) used[step] = true;
    }
  }
  for (int step = 0; step <= strip.steps; ++step) {
    if (used[step]) strip.at.push_back(step);
  }
  if (strip.at.empty()) strip.at.push_back(0);
  return strip;
}

SharedErrors::SharedErrors(const std::vector<TimeSpan>& spans, const SharedErrorModel& model,
                           const std::vector<std::vector<TimeSpan>>& observed)
    : model_(model) {
  model_.validate();
  for (std::size_t i = 0; i < spans.size(); ++i) {
    strips_.push_back(
        knotsOf(spans[i], model_.knot_spacing, observed.empty() ? nullptr : &observed[i]));
    strips_.back().first = knot_count_;
    knot_count_ += static_cast<int>(strips_.back().at.size());
  }
}

SharedErrors::Place SharedErrors::placeOf(int index, double time) const {
  const StripKnots& strip = strips_[static_cast<std::size_t>(index)];
  if (strip.at.size() == 1) return {strip.first, strip.first, 0.0};
  const double step =
      std::clamp((time - strip.start) / strip.spacing, static_cast<double>(strip.at.front()),
                 static_cast<double>(strip.at.back()));
  const int knot = std::min(strip.before(step), static_cast<int>(strip.at.size()) - 2);
  const double from = strip.at[knot], to = strip.at[knot + 1];
  return {strip.first + knot, strip.first + knot + 1, (step - from) / (to - from)};
}

std::vector<TrajectoryErrorKnot> SharedErrors::errorsOf(int index,
                                                        const Eigen::VectorXd& solution) const {
  const StripKnots& strip = strips_[static_cast<std::size_t>(index)];
  using Knot = Eigen::Matrix<double, kPerKnot, 1>;
  const auto valueOf = [&](int knot) -> Knot {
    return solution.segment<kPerKnot>(static_cast<Eigen::Index>(strip.first + knot) * kPerKnot);
  };
  const double unit = strip.spacing / model_.correlation_time;
  std::vector<TrajectoryErrorKnot> errors;
  for (int step = 0; step <= strip.steps; ++step) {
    // Expectation of a Gauss-Markov process between two known values, or beyond the last one.
    const int knot = strip.before(step);
    const double since = unit * (step - strip.at[knot]);
    Knot value = valueOf(knot) * std::exp(-std::abs(since));
    if (since > 0.0 && knot + 1 < static_cast<int>(strip.at.size())) {
      const double until = unit * (strip.at[knot + 1] - step);
      value = (std::sinh(until) * valueOf(knot) + std::sinh(since) * valueOf(knot + 1)) /
              std::sinh(since + until);
    }
    errors.push_back({strip.start + step * strip.spacing, value.head<3>(), value.tail<3>()});
  }
  return errors;
}

void SharedErrors::setVarianceFactor(int strip, int component, double factor) {
  strips_[static_cast<std::size_t>(strip)].variance_factors[static_cast<std::size_t>(component)] =
      factor;
}

Eigen::SparseMatrix<double> SharedErrors::priorInformation(const SharedErrorLevels& levels) const {
  const double position = model_.position * model_.position * levels.position;
  const double roll_pitch = model_.roll_pitch * model_.roll_pitch * levels.roll_pitch;
  const double heading = model_.heading * model_.heading * levels.heading;
  const double variances[kPerKnot] = {position,   position,   position,
                                      roll_pitch, roll_pitch, heading};
  std::vector<Eigen::Triplet<double>> entries;
  for (const StripKnots& strip : strips_) {
    const auto add = [&](int row_knot, int column_knot, double factor) {
      for (int i = 0; i < kPerKnot; ++i) {
        entries.emplace_back(row_knot * kPerKnot + i, column_knot * kPerKnot + i,
                             factor / (variances[i] * strip.variance_factors[i]));
      }
    };
    // Inverse covariance of a Gauss-Markov process: tridiagonal. Each step adds the information of
    // a value that is rho times the one before, with variance 1 - rho^2.
    add(strip.first, strip.first, 1.0);
    for (int k = 0; k + 1 < static_cast<int>(strip.at.size()); ++k) {
      const double seconds = strip.spacing * (strip.at[k + 1] - strip.at[k]);
      const double rho = std::exp(-seconds / model_.correlation_time);
      const double scale = 1.0 / (1.0 - rho * rho);
      const int here = strip.first + k, next = here + 1;
      add(here, here, scale * rho * rho);
      add(next, next, scale);
      add(here, next, -scale * rho);
      add(next, here, -scale * rho);
    }
  }
  const double instrument[kPerKnot] = {
      model_.ranging_incidence, model_.range_scale, 1.0, 1.0, 1.0, 1.0};
  for (int i = 0; i < kPerKnot; ++i) {
    const int at = instrumentBlock() * kPerKnot + i;
    entries.emplace_back(at, at, 1.0 / (instrument[i] * instrument[i]));
  }
  Eigen::SparseMatrix<double> information(unknowns(), unknowns());
  information.setFromTriplets(entries.begin(), entries.end());
  return information;
}

}  // namespace pcl_als
