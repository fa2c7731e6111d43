// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "pair_observation.h"
#include "shared_errors.h"

namespace pcl_als {

/// Row of one observation: the eight parameters; four knots, six each; the shifts of its two
/// surfaces, three each; the blocks of the instrument, six each; those of the systems of its two
/// strips; further knots of a patch whose vertices were measured at different times. All but the
/// first block of the instrument are mostly unused.
struct TouchedRow {
  static constexpr int kKnot = SharedErrors::kPerKnot;
  static constexpr int kKnots = 4;
  static constexpr int kSystems = kKnots + SharedErrors::kInstrumentBlocks;
  static constexpr int kFurther = kSystems + 2 * SharedErrors::kSystemBlocks;
  static constexpr int kSlots = kFurther + 4;
  static constexpr int kShift = 3;
  static constexpr int kShifts = kSystemParameterCount + kKnots * kKnot;
  static constexpr int kInstrument = kShifts + 2 * kShift;
  static constexpr int kSize = kInstrument + (kSlots - kKnots) * kKnot;

  TouchedRow(const PairObservation& observation, const SharedErrors& errors);

  static constexpr int slot(int index) {
    return index < kKnots ? kSystemParameterCount + index * kKnot
                          : kInstrument + (index - kKnots) * kKnot;
  }
  static constexpr int shift(int index) { return kShifts + index * kShift; }
  /// Columns that may differ from zero.
  int used() const {
    int last = kSlots - 1;
    while (last > kKnots && knots[last] < 0) --last;
    return slot(last) + kKnot;
  }

  Eigen::Matrix<double, 1, kSize> row = Eigen::Matrix<double, 1, kSize>::Zero();
  std::array<int, kSlots> knots;        ///< -1: not used
  std::array<int, 2> surfaces{-1, -1};  ///< PairObservation::surfaceIndex()

  bool hasFurtherKnots() const { return knots[kFurther] >= 0; }

 private:
  /// The slot of a knot of the point or of the patch, a new one where it has none.
  int slotOf(int side, int knot);
  void placeSystem(int side, int system, const SystemRow& design, const Eigen::Vector3d& offset,
                   const SharedErrors& errors);
};

/// Effect of shared errors, shifts excepted, on the distance of a pair, metres: the product of a
/// TouchedRow and the solution, without forming the row. \param shared in the order of SharedErrors
double sharedEffect(const PairObservation& observation, const SharedErrors& errors,
                    const Eigen::VectorXd& shared);

/// Normal equations of one area: parameters, the knots of its observations, the shifts of its
/// surfaces.
class AreaNormal {
 public:
  AreaNormal(const AreaObservations& observations, const std::vector<double>& weights,
             const SharedErrors& errors);

  /// Equations with the shifts eliminated, for a variance of the shifts (m^2).
  struct Reduced {
    Eigen::MatrixXd matrix;  ///< parameters, then knots() six each
    Eigen::VectorXd right;
    double log_determinant = 0.0;  ///< of the shifts' normal matrix times their variance
    double explained = 0.0;        ///< reduction of the weighted sum of squares by the shifts
  };
  Reduced reduced(double shift_variance) const;

  /// What the shifts contribute to the derivatives of the likelihood with respect to the logarithm
  /// of their variance, at the values of parameters and knots (in the order of Reduced::matrix).
  struct ShiftTerms {
    Reduced change;  ///< derivatives of Reduced with the opposite sign: matrix and log_determinant;
                     ///< right: effect of the shifts on the equations; explained: sum of the
                     ///< squared shifts over their variance
    double information = 0.0;  ///< of the shifts' effect, with the shifts eliminated
  };
  ShiftTerms shiftTerms(double shift_variance, const Eigen::VectorXd& values) const;
  const std::vector<int>& knots() const { return knots_; }
  /// The equations of the parameters without elimination: noise of points only.
  SystemMatrix parameters() const {
    return matrix_.topLeftCorner<kSystemParameterCount, kSystemParameterCount>();
  }

 private:
  using Knots = std::array<int, TouchedRow::kSlots>;
  using Surfaces = std::array<int, 2>;
  /// Some columns of a TouchedRow, and their place in the matrix.
  struct Columns {
    int row, matrix, count;
  };
  std::vector<Columns> columnsOf(const Knots& knots, const Surfaces& surfaces) const;
  void collect(const Knots& knots, const Surfaces& surfaces);
  int shiftsBegin() const {
    return kSystemParameterCount + static_cast<int>(knots_.size()) * TouchedRow::kKnot;
  }
  /// Adds the equations of some observations, or of one, to the lower triangle.
  void add(const std::vector<Columns>& columns, const Eigen::MatrixXd& lower,
           const Eigen::VectorXd& right);
  void add(const std::vector<Columns>& columns, const TouchedRow& touched, double misclosure,
           double weight);

  std::vector<int> knots_, surfaces_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

}  // namespace pcl_als
