// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "area_normal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

TouchedRow::TouchedRow(const PairObservation& o, const SharedErrors& errors) {
  knots.fill(-1);
  row.head<kSystemParameterCount>() = o.row();
  if (o.a != PairObservation::kControl)
    place({0, o.a, o.surfaceA(), o.time_a, 1.0, o.row_a, o.turn_a}, o.normal, errors);
  place({1, o.b, o.surfaceB(), o.time_b, -1.0, o.row_b, o.turn_b}, o.normal, errors);
  for (int i = 0; i < errors.observedInstrumentBlocks(); ++i)
    knots[kKnots + i] = errors.instrumentBlock() + i;
  row.segment<kErrorSourceCount>(kInstrument) = o.sources;
}

void TouchedRow::place(const Side& side, const Eigen::Vector3d& normal,
                       const SharedErrors& errors) {
  if (errors.systems().isFlown(side.strip)) placeKnots(side, normal, errors);
  surfaces[static_cast<std::size_t>(side.index)] = side.surface;
  row.segment<kShift>(shift(side.index)) =
      side.sign * errors.shiftScale(side.strip) * normal.transpose();
  placeSystem(side, normal, errors);
}

void TouchedRow::placeKnots(const Side& side, const Eigen::Vector3d& normal,
                            const SharedErrors& errors) {
  const SharedErrors::Place where = errors.placeOf(side.strip, side.time);
  Eigen::Matrix<double, 1, kKnot> effect;
  effect << normal.transpose(),
      side.design.segment<3>(indexOf(SystemParameter::boresight_pitch)) + side.turn.cast<double>();
  const int first = 2 * side.index;
  knots[first] = where.knot;
  row.segment<kKnot>(slot(first)) = side.sign * (1.0 - where.next) * effect;
  if (where.next_knot == where.knot) return;
  knots[first + 1] = where.next_knot;
  row.segment<kKnot>(slot(first + 1)) = side.sign * where.next * effect;
}

void TouchedRow::placeSystem(const Side& side, const Eigen::Vector3d& normal,
                             const SharedErrors& errors) {
  const int system = errors.systems().of(side.strip);
  if (system == 0) return;
  constexpr int kBlocks = SharedErrors::kSystemBlocks;
  const int first = kSystems + side.index * kBlocks;
  for (int i = 0; i < kBlocks; ++i) knots[first + i] = errors.systemBlock(system) + i;
  row.segment<kSystemParameterCount>(slot(first)) = side.sign * side.design;
  row.segment<3>(slot(first) + kSystemParameterCount) = side.sign * normal.transpose();
}

namespace {

/// Sums over observations of the same knots and surfaces; successive observations mostly share
/// them. Their rows are collected, so that the products are those of matrices and not of vectors.
class Partial {
 public:
  void add(const TouchedRow& touched, double misclosure, double weight) {
    const double root = std::sqrt(weight);
    if (columns_ == 0) {
      columns_ = touched.used();
      matrix.setZero(columns_, columns_);
      right.setZero(columns_);
    }
    rows_.row(count_) = root * touched.row;
    misclosures_[count_] = root * misclosure;
    if (++count_ == kRows) flush();
  }
  void flush() {
    const auto rows = rows_.topLeftCorner(count_, columns_);
    matrix.noalias() += rows.transpose() * rows;
    right.noalias() += rows.transpose() * misclosures_.head(count_);
    count_ = 0;
  }

  Eigen::MatrixXd matrix;  ///< columns that may differ from zero
  Eigen::VectorXd right;

 private:
  static constexpr int kRows = 32;
  Eigen::Matrix<double, kRows, TouchedRow::kSize> rows_;
  Eigen::Matrix<double, kRows, 1> misclosures_;
  int count_ = 0, columns_ = 0;
};
using PartialKey = std::pair<std::array<int, TouchedRow::kSlots>, std::array<int, 2>>;

std::map<PartialKey, Partial> partialSums(const AreaObservations& observations,
                                          const std::vector<double>& weights,
                                          const SharedErrors& errors) {
  std::map<PartialKey, Partial> partial;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (weights[i] == 0.0) continue;
    const TouchedRow touched(observations[i], errors);
    partial[{touched.knots, touched.surfaces}].add(touched, observations[i].misclosure,
                                                   weights[i] / observations[i].variance);
  }
  for (auto& [key, sums] : partial) sums.flush();
  return partial;
}

void insertSorted(std::vector<int>& values, int value) {
  const auto place = std::lower_bound(values.begin(), values.end(), value);
  if (value >= 0 && (place == values.end() || *place != value)) values.insert(place, value);
}

int positionOf(const std::vector<int>& values, int value) {
  return static_cast<int>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

}  // namespace

AreaNormal::AreaNormal(const AreaObservations& observations, const std::vector<double>& weights,
                       const SharedErrors& errors) {
  const std::map<PartialKey, Partial> partial = partialSums(observations, weights, errors);
  for (const auto& [key, sums] : partial) {
    for (const int knot : key.first) insertSorted(knots_, knot);
    for (const int surface : key.second) insertSorted(surfaces_, surface);
  }
  const auto shifts = kSystemParameterCount + static_cast<int>(knots_.size()) * TouchedRow::kKnot;
  const auto size = shifts + static_cast<int>(surfaces_.size()) * TouchedRow::kShift;
  matrix_.setZero(size, size);
  right_.setZero(size);
  for (const auto& [key, sums] : partial) {
    std::vector<std::array<int, 3>> parts{{0, 0, kSystemParameterCount}};  // local, area, length
    for (int i = 0; i < TouchedRow::kSlots; ++i) {
      const int at = kSystemParameterCount + positionOf(knots_, key.first[i]) * TouchedRow::kKnot;
      if (key.first[i] >= 0) parts.push_back({TouchedRow::slot(i), at, TouchedRow::kKnot});
    }
    for (int i = 0; i < 2; ++i) {
      const int at = shifts + positionOf(surfaces_, key.second[i]) * TouchedRow::kShift;
      if (key.second[i] >= 0) parts.push_back({TouchedRow::shift(i), at, TouchedRow::kShift});
    }
    for (const auto& r : parts) {
      right_.segment(r[1], r[2]) += sums.right.segment(r[0], r[2]);
      for (const auto& c : parts) {
        matrix_.block(r[1], c[1], r[2], c[2]) += sums.matrix.block(r[0], c[0], r[2], c[2]);
      }
    }
  }
}

AreaNormal::Reduced AreaNormal::reduced(double shift_variance) const {
  const auto shifts = static_cast<Eigen::Index>(surfaces_.size()) * TouchedRow::kShift;
  const Eigen::Index kept = matrix_.rows() - shifts;
  Reduced reduced;
  reduced.matrix = matrix_.topLeftCorner(kept, kept);
  reduced.right = right_.head(kept);
  if (shifts == 0) return reduced;
  Eigen::MatrixXd own = matrix_.bottomRightCorner(shifts, shifts);
  own.diagonal().array() += 1.0 / shift_variance;
  const CholeskyFactor cholesky(own);
  // Eliminated through the Cholesky factor, so that the result is symmetric and positive by
  // construction.
  const Eigen::MatrixXd coupling = matrix_.bottomLeftCorner(shifts, kept);
  const Eigen::VectorXd right = right_.tail(shifts);
  const Eigen::MatrixXd half = cholesky.solveLower(coupling);
  const Eigen::VectorXd half_right = cholesky.solveLower(right);
  reduced.matrix.noalias() -= half.transpose() * half;
  reduced.right.noalias() -= half.transpose() * half_right;
  reduced.log_determinant =
      cholesky.logDeterminant() + static_cast<double>(shifts) * std::log(shift_variance);
  reduced.explained = half_right.squaredNorm();
  return reduced;
}

AreaNormal::ShiftTerms AreaNormal::shiftTerms(double shift_variance,
                                              const Eigen::VectorXd& values) const {
  const auto shifts = static_cast<Eigen::Index>(surfaces_.size()) * TouchedRow::kShift;
  const Eigen::Index kept = matrix_.rows() - shifts;
  ShiftTerms terms;
  terms.change.matrix.setZero(kept, kept);
  terms.change.right.setZero(kept);
  if (shifts == 0) return terms;
  const Eigen::MatrixXd own = matrix_.bottomRightCorner(shifts, shifts);
  const Eigen::MatrixXd coupling = matrix_.bottomLeftCorner(shifts, kept);
  Eigen::MatrixXd full = own;
  full.diagonal().array() += 1.0 / shift_variance;
  const CholeskyFactor cholesky(full);
  const Eigen::MatrixXd effect = cholesky.solve(coupling);
  const Eigen::VectorXd shift = cholesky.solve(right_.tail(shifts) - coupling * values);
  // With the posterior covariance C of the values, the shifts have C_u = full^-1 + effect C
  // effect'.
  const Eigen::MatrixXd inverse = cholesky.solve(Eigen::MatrixXd::Identity(shifts, shifts));
  terms.change.matrix = effect.transpose() * effect / shift_variance;
  terms.change.right = effect.transpose() * shift / shift_variance;
  terms.change.log_determinant = inverse.trace() / shift_variance - static_cast<double>(shifts);
  terms.change.explained = shift.squaredNorm() / shift_variance;
  terms.information = (own * shift).dot(inverse * shift) / shift_variance;
  return terms;
}

}  // namespace pcl_als
