// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "area_normal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pcl_als/adjustment/dense_products.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

namespace {

/// The point (side 0) or the patch (side 1) of a strip.
struct Side {
  int index, strip, surface;
  double time, sign;
  SystemRow design;
  Eigen::RowVector3d attitude;  ///< effect of errors of pitch, roll and heading

  Side(int number, const PairObservation& o)
      : index(number),
        strip(number == 0 ? o.a : o.b),
        surface(number == 0 ? o.surfaceA() : o.surfaceB()),
        time(number == 0 ? o.time_a : o.time_b),
        sign(number == 0 ? 1.0 : -1.0),
        design((number == 0 ? o.row_a : o.row_b).cast<double>()),
        attitude(design.segment<3>(indexOf(SystemParameter::boresight_pitch))) {
    if (o.special)
      attitude += (number == 0 ? o.special->boresight_a : o.special->boresight_b).cast<double>();
  }
};

template <class Use>
void forSides(const PairObservation& o, const Use& use) {
  if (o.a != PairObservation::kControl) use(Side(0, o));
  use(Side(1, o));
}

/// Effect of the six trajectory errors at a time.
using Effect = Eigen::Matrix<double, 1, TouchedRow::kKnot>;

/// Calls \a add(knot, effect) with the effects of the knots before and after a time.
template <class Add>
void interpolate(const Side& side, double time, const Effect& effect, const SharedErrors& errors,
                 const Add& add) {
  const SharedErrors::Place where = errors.placeOf(side.strip, time);
  add(where.knot, (1.0 - where.next) * effect);
  if (where.next_knot != where.knot) add(where.next_knot, where.next * effect);
}

/// The same of all trajectory errors of a side.
template <class Add>
void forKnots(const Side& side, const PairObservation& o, const SharedErrors& errors,
              const Add& add) {
  if (!errors.systems().isFlown(side.strip)) return;
  Effect effect;
  if (side.index == 0 || !o.hasMixedTimes()) {
    effect << o.normal.transpose(), side.attitude;
    interpolate(side, side.time, side.sign * effect, errors, add);
    return;
  }
  for (const PairObservation::Special::Vertex& vertex : o.special->vertices) {
    effect << o.normal.transpose(), vertex.turn.cast<double>();
    interpolate(side, vertex.time, side.sign * vertex.weight * effect, errors, add);
  }
}

}  // namespace

TouchedRow::TouchedRow(const PairObservation& o, const SharedErrors& errors) {
  knots.fill(-1);
  row.head<kSystemParameterCount>() = o.row();
  forSides(o, [&](const Side& side) {
    forKnots(side, o, errors, [&](int knot, const Effect& effect) {
      row.segment<kKnot>(slot(slotOf(side.index, knot))) += effect;
    });
    surfaces[static_cast<std::size_t>(side.index)] = side.surface;
    row.segment<kShift>(shift(side.index)) =
        side.sign * errors.shiftScale(side.strip) * o.normal.transpose();
    placeSystem(side.index, errors.systems().of(side.strip), side.sign * side.design,
                side.sign * o.normal, errors);
  });
  for (int i = 0; i < errors.observedInstrumentBlocks(); ++i)
    knots[kKnots + i] = errors.instrumentBlock() + i;
  row.segment<kErrorSourceCount>(kInstrument) = o.sources.cast<double>();
}

int TouchedRow::slotOf(int side, int knot) {
  // Three vertices of a patch have at most six knots; a point has two.
  constexpr std::array<int, 6> kPlaces{0, 1, kFurther, kFurther + 1, kFurther + 2, kFurther + 3};
  for (const int place : kPlaces) {
    const int index = place < 2 ? 2 * side + place : place;
    int& present = knots[static_cast<std::size_t>(index)];
    if (present >= 0 && present != knot) continue;
    present = knot;
    return index;
  }
  throw std::logic_error("TouchedRow: a patch has more than six knots");
}

void TouchedRow::placeSystem(int side, int system, const SystemRow& design,
                             const Eigen::Vector3d& offset, const SharedErrors& errors) {
  if (system == 0) return;
  constexpr int kBlocks = SharedErrors::kSystemBlocks;
  const int first = kSystems + side * kBlocks;
  for (int i = 0; i < kBlocks; ++i) knots[first + i] = errors.systemBlock(system) + i;
  row.segment<kSystemParameterCount>(slot(first)) = design;
  row.segment<3>(slot(first) + kSystemParameterCount) = offset.transpose();
}

double sharedEffect(const PairObservation& o, const SharedErrors& errors,
                    const Eigen::VectorXd& shared) {
  constexpr int kKnot = TouchedRow::kKnot;
  double sum =
      o.effectOfSources(shared.segment<kErrorSourceCount>(errors.instrumentBlock() * kKnot));
  forSides(o, [&](const Side& side) {
    forKnots(side, o, errors, [&](int knot, const Effect& effect) {
      sum += effect.dot(shared.segment<kKnot>(knot * kKnot));
    });
    const int system = errors.systems().of(side.strip);
    if (system == 0) return;
    const int at = errors.systemBlock(system) * kKnot;
    sum += side.sign * (side.design.dot(shared.segment<kSystemParameterCount>(at)) +
                        o.normal.dot(shared.segment<3>(at + kSystemParameterCount)));
  });
  return sum;
}

namespace {

/// The equation of an observation with a weight.
struct Entry {
  std::size_t index;
  TouchedRow touched;
};

using Unknowns = std::pair<std::array<int, TouchedRow::kSlots>, std::array<int, 2>>;
using EntriesByUnknowns = std::map<Unknowns, std::vector<const Entry*>>;

/// The observations with a weight.
std::vector<Entry> entriesOf(const AreaObservations& observations,
                             const std::vector<double>& weights, const SharedErrors& errors) {
  std::vector<Entry> entries;
  entries.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (weights[i] != 0.0) entries.push_back({i, TouchedRow(observations[i], errors)});
  }
  return entries;
}

EntriesByUnknowns byUnknowns(const std::vector<Entry>& entries) {
  EntriesByUnknowns groups;
  auto current = groups.end();
  for (const Entry& entry : entries) {
    const TouchedRow& row = entry.touched;
    const bool same = current != groups.end() && current->first.first == row.knots &&
                      current->first.second == row.surfaces;
    if (!same) current = groups.try_emplace({row.knots, row.surfaces}).first;
    current->second.push_back(&entry);
  }
  return groups;
}

/// Lower triangle of the normal equations of observations of the same unknowns. Their rows are
/// collected, so that the products are those of matrices and not of vectors.
class Partial {
 public:
  /// \param columns that may differ from zero
  void begin(int columns) {
    columns_ = columns;
    matrix.setZero(columns, columns);
    right.setZero(columns);
  }
  void add(const TouchedRow& touched, double misclosure, double weight) {
    const auto row = touched.row.head(columns_).transpose();
    rows_.col(count_).head(columns_) = std::sqrt(weight) * row;
    right += weight * misclosure * row;
    if (++count_ == kRows) flush();
  }
  void flush() {
    if (count_ == 0) return;
    dense::addSquare(rows_.topLeftCorner(columns_, count_), matrix);
    count_ = 0;
  }

  Eigen::MatrixXd matrix;  ///< after flush()
  Eigen::VectorXd right;

 private:
  static constexpr int kRows = 32;
  Eigen::Matrix<double, TouchedRow::kSize, kRows> rows_ =  // one in each column
      Eigen::Matrix<double, TouchedRow::kSize, kRows>::Zero();
  int count_ = 0, columns_ = 0;
};

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
  const std::vector<Entry> entries = entriesOf(observations, weights, errors);
  const EntriesByUnknowns groups = byUnknowns(entries);
  for (const auto& [unknowns, group] : groups) collect(unknowns.first, unknowns.second);
  const auto size = shiftsBegin() + static_cast<int>(surfaces_.size()) * TouchedRow::kShift;
  matrix_.setZero(size, size);
  right_.setZero(size);
  Partial sums;
  for (const auto& [unknowns, group] : groups) {
    const std::vector<Columns> columns = columnsOf(unknowns.first, unknowns.second);
    // Few observations have the further knots of a patch of mixed times in common.
    const bool single = group.front()->touched.hasFurtherKnots();
    if (!single) sums.begin(group.front()->touched.used());
    for (const Entry* entry : group) {
      const PairObservation& o = observations[entry->index];
      const double weight = weights[entry->index] / o.variance;
      if (single)
        add(columns, entry->touched, o.misclosure, weight);
      else
        sums.add(entry->touched, o.misclosure, weight);
    }
    if (single) continue;
    sums.flush();
    add(columns, sums.matrix, sums.right);
  }
  matrix_.triangularView<Eigen::StrictlyUpper>() = matrix_.transpose();
}

void AreaNormal::collect(const Knots& knots, const Surfaces& surfaces) {
  for (const int knot : knots) insertSorted(knots_, knot);
  for (const int surface : surfaces) insertSorted(surfaces_, surface);
}

std::vector<AreaNormal::Columns> AreaNormal::columnsOf(const Knots& knots,
                                                       const Surfaces& surfaces) const {
  std::vector<Columns> columns{{0, 0, kSystemParameterCount}};
  for (int i = 0; i < TouchedRow::kSlots; ++i) {
    const int knot = knots[static_cast<std::size_t>(i)];
    const int at = kSystemParameterCount + positionOf(knots_, knot) * TouchedRow::kKnot;
    if (knot >= 0) columns.push_back({TouchedRow::slot(i), at, TouchedRow::kKnot});
  }
  for (int i = 0; i < 2; ++i) {
    const int surface = surfaces[static_cast<std::size_t>(i)];
    const int at = shiftsBegin() + positionOf(surfaces_, surface) * TouchedRow::kShift;
    if (surface >= 0) columns.push_back({TouchedRow::shift(i), at, TouchedRow::kShift});
  }
  return columns;
}

void AreaNormal::add(const std::vector<Columns>& columns, const Eigen::MatrixXd& lower,
                     const Eigen::VectorXd& right) {
  for (const Columns& c : columns) {
    right_.segment(c.matrix, c.count) += right.segment(c.row, c.count);
    for (const Columns& r : columns) {
      if (r.matrix < c.matrix) continue;
      auto block = matrix_.block(r.matrix, c.matrix, r.count, c.count);
      if (r.row > c.row) {
        block += lower.block(r.row, c.row, r.count, c.count);
      } else if (r.row < c.row) {
        block += lower.block(c.row, r.row, c.count, r.count).transpose();
      } else {
        block.template triangularView<Eigen::Lower>() +=
            lower.block(r.row, c.row, r.count, c.count);
      }
    }
  }
}

void AreaNormal::add(const std::vector<Columns>& columns, const TouchedRow& touched,
                     double misclosure, double weight) {
  for (const Columns& c : columns) {
    const Eigen::RowVectorXd weighted = weight * touched.row.segment(c.row, c.count);
    right_.segment(c.matrix, c.count) += misclosure * weighted.transpose();
    for (const Columns& r : columns) {
      if (r.matrix < c.matrix) continue;
      matrix_.block(r.matrix, c.matrix, r.count, c.count).noalias() +=
          touched.row.segment(r.row, r.count).transpose() * weighted;
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
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(kept, kept);
  dense::addTransposedProduct(half, half, square);
  reduced.matrix -= square;
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
  dense::addTransposedProduct(effect, effect, terms.change.matrix);
  terms.change.matrix /= shift_variance;
  terms.change.right = effect.transpose() * shift / shift_variance;
  terms.change.log_determinant = inverse.trace() / shift_variance - static_cast<double>(shifts);
  terms.change.explained = shift.squaredNorm() / shift_variance;
  terms.information = (own * shift).dot(inverse * shift) / shift_variance;
  return terms;
}

}  // namespace pcl_als
