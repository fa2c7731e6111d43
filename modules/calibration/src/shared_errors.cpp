// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
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
  for (const auto& [name, value] : values) {
    if (std::isfinite(value) && value > 0.0) continue;
    std::ostringstream text;
    text << name << " must be positive, is " << value;
    throw UsageError(text.str());
  }
}

SharedErrors::SharedErrors(const std::vector<std::pair<double, double>>& spans,
                           const SharedErrorModel& model)
    : model_(model) {
  model_.validate();
  // Every strip's errors meet those of the strips it overlaps, which makes eliminating them dear.
  constexpr double kMostKnots = 400.0;
  double total = 0.0;
  for (const auto& [start, end] : spans) total += std::max(0.0, end - start);
  const double spacing = std::max(model_.knot_spacing, total / kMostKnots);
  for (const auto& [start, end] : spans) {
    StripKnots strip;
    const double length = std::max(0.0, end - start);
    const int intervals = static_cast<int>(std::ceil(length / spacing - 1e-9));
    strip.start = start;
    strip.count = intervals + 1;
    strip.spacing = intervals > 0 ? length / intervals : 1.0;
    strip.first = knot_count_;
    knot_count_ += strip.count;
    strips_.push_back(strip);
  }
}

SharedErrors::Place SharedErrors::placeOf(int index, double time) const {
  const StripKnots& strip = strips_[static_cast<std::size_t>(index)];
  if (strip.count == 1) return {strip.first, strip.first, 0.0};
  const double at =
      std::clamp((time - strip.start) / strip.spacing, 0.0, static_cast<double>(strip.count - 1));
  const int knot = std::min(static_cast<int>(at), strip.count - 2);
  return {strip.first + knot, strip.first + knot + 1, at - knot};
}

std::vector<TrajectoryErrorKnot> SharedErrors::errorsOf(int index,
                                                        const Eigen::VectorXd& solution) const {
  const StripKnots& strip = strips_[static_cast<std::size_t>(index)];
  std::vector<TrajectoryErrorKnot> knots;
  for (int k = 0; k < strip.count; ++k) {
    const Eigen::Index at = static_cast<Eigen::Index>(strip.first + k) * kPerKnot;
    knots.push_back(
        {strip.start + k * strip.spacing, solution.segment<3>(at), solution.segment<3>(at + 3)});
  }
  return knots;
}

Eigen::SparseMatrix<double> SharedErrors::priorInformation(const SharedErrorLevels& levels) const {
  const double position = model_.position * model_.position * levels.position;
  const double roll_pitch = model_.roll_pitch * model_.roll_pitch * levels.roll_pitch;
  const double heading = model_.heading * model_.heading * levels.heading;
  const double variances[kPerKnot] = {position,   position,   position,
                                      roll_pitch, roll_pitch, heading};
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row_knot, int column_knot, double factor) {
    for (int i = 0; i < kPerKnot; ++i) {
      entries.emplace_back(row_knot * kPerKnot + i, column_knot * kPerKnot + i,
                           factor / variances[i]);
    }
  };
  for (const StripKnots& strip : strips_) {
    // Inverse covariance of a Gauss-Markov process at equal steps: tridiagonal.
    const double rho = strip.count > 1 ? std::exp(-strip.spacing / model_.correlation_time) : 0.0;
    const double scale = 1.0 / (1.0 - rho * rho);
    for (int k = 0; k < strip.count; ++k) {
      const bool inner = k > 0 && k + 1 < strip.count;
      add(strip.first + k, strip.first + k, inner ? scale * (1.0 + rho * rho) : scale);
      if (k + 1 == strip.count) continue;
      add(strip.first + k, strip.first + k + 1, -scale * rho);
      add(strip.first + k + 1, strip.first + k, -scale * rho);
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
