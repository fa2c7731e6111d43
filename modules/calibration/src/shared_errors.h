// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/system_parameters.h>

#include "pair_observation.h"

namespace pcl_als {

/// The same model with knots closer together where strips are observed for a short time: 150 of
/// them, but at least 0.4 s apart. Errors between knots count as noise of each point, although the
/// points of a moment share them, and standard deviations are then too small.
/// \param observed firing times by strip
SharedErrorModel withKnotsFor(SharedErrorModel model,
                              const std::vector<std::vector<TimeSpan>>& observed);

/// Variance components: estimated variance over the variance of the model, by component and kind of
/// error.
struct VarianceFactors {
  /// Variance components of one component of the trajectory errors, by kind.
  struct Trajectory {
    double position = 1.0, roll_pitch = 1.0, heading = 1.0;
  };
  Trajectory gauss_markov, smooth, constant;
  double local = 1.0;

  /// All of them, those of the trajectory components first.
  static constexpr int kCount = 10;
  std::array<double, kCount> values() const;
  static VarianceFactors of(const std::array<double, kCount>& values);

  /// Whether none differs by more than a factor of 1.5, which is less than their standard
  /// deviation.
  bool near(const VarianceFactors& other) const;
};

/// Which strips share a system, and which share a trajectory.
struct StripSystems {
  std::vector<int> system;  ///< by strip, from 0; empty: one system
  int count = 1;            ///< of systems
  PerSystemParameters own;  ///< what systems have of their own
  /// By strip, the first strip of the same pass: channels of one scanner, and scanners with ids of
  /// their own, have the same trajectory errors. Empty: every strip is a pass.
  std::vector<int> pass;
  /// A system that is held fixed: its strips (or the surface) have no biases.
  struct Held {
    double offset = 0.0;  ///< a priori standard deviation of a common height error, metres
    double plan = 0.0;    ///< the same of a common error to the east and to the north, metres
    double local = 0.0;   ///< of its shift in an area, metres; 0: as of other strips
    bool flown = false;   ///< strips with trajectory errors; false: a surface
  };
  std::vector<Held> held;  ///< the last systems

  /// The place of the system of a strip in held; -1: the strip is not held fixed.
  int heldIndex(int strip) const {
    const int index = of(strip) - count + static_cast<int>(held.size());
    return held.empty() || index < 0 ? -1 : index;
  }
  /// Whether a strip has trajectory errors.
  bool isFlown(int strip) const {
    const int index = heldIndex(strip);
    return index < 0 || held[static_cast<std::size_t>(index)].flown;
  }
  int heldSystem(std::size_t index) const {
    return count - static_cast<int>(held.size()) + static_cast<int>(index);
  }
  int of(int strip) const { return system.empty() ? 0 : system[static_cast<std::size_t>(strip)]; }
};

/** \brief The unknowns of the model: six at every knot of every strip (linear in time between
 * knots), then two blocks of six for the instrument (the error sources, in the order
 * of ErrorSource), then two for each system after the first (differences to the first:
 * SystemUnknowns), then six for each coefficient of the strips' smooth and constant components.
 *
 * An error at a knot is the sum of all components, so that observations depend on knots and the
 * instrument only. Knots are a knot_spacing apart, and exist only where something was observed; the
 * covariance of the process between them is exact for any distance, so that the cost depends on the
 * observations and not on the length of the flight lines.
 */
class SharedErrors {
 public:
  static constexpr int kPerKnot = 6;
  static constexpr int kInstrumentBlocks = 2;
  static_assert(kErrorSourceCount <= kInstrumentBlocks * kPerKnot);
  static constexpr int kSystemBlocks = 2;
  static_assert(kSystemUnknownCount <= kSystemBlocks * kPerKnot);

  /// \param spans firing times of every strip
  /// \param observed by strip, when observations are made, in any order; empty: always
  SharedErrors(const std::vector<TimeSpan>& spans, const SharedErrorModel& model,
               const std::vector<std::vector<TimeSpan>>& observed = {},
               const StripSystems& systems = {});

  int knotCount() const { return knot_count_; }
  int instrumentBlock() const { return knot_count_; }  ///< counted as a knot after all knots
  /// The blocks of the instrument of which observations depend: the second one holds sources that
  /// are rarely considered.
  int observedInstrumentBlocks() const;
  const StripSystems& systems() const { return systems_; }
  /// The first block of a system's differences to the first system; system > 0.
  int systemBlock(int system) const {
    return knot_count_ + kInstrumentBlocks + (system - 1) * kSystemBlocks;
  }
  /// Whether a system after the first has an unknown of its own.
  bool isOwn(int system, int unknown) const;
  /// Gives a system after the first an unknown of its own with this a priori standard deviation,
  /// internal units.
  void setOwn(int system, int unknown, double std);
  /// A system shares this unknown with the first one, because the data do not determine it.
  void share(int system, int unknown);
  /// Sets the a priori standard deviation of the common height error of a system that is held
  /// fixed, metres; by index of StripSystems::held.
  void setHeldOffset(std::size_t index, double std) { systems_.held[index].offset = std; }
  /// Standard deviation of the shift of a strip in an area over that of the model.
  double shiftScale(int strip) const;
  int sourceUnknown(ErrorSource source) const {
    return instrumentBlock() * kPerKnot + indexOf(source);
  }
  /// The error sources that are unknowns, by default slope_ranging only; the others are absent.
  /// Observations must have been formed with their effects.
  void considerSources(std::vector<ErrorSource> sources) { considered_ = std::move(sources); }
  const std::vector<ErrorSource>& consideredSources() const { return considered_; }
  bool isConsidered(ErrorSource source) const;
  const SharedErrorModel& model() const { return model_; }
  void setPrior(BiasPrior prior) { model_.biases = std::move(prior); }
  /// Unknowns of knots, instrument and systems, on which observations depend.
  int observedUnknowns() const { return systemBlock(systems_.count) * kPerKnot; }
  int unknowns() const { return observedUnknowns() + coefficient_count_ * kPerKnot; }

  /// Position of a time between two knots of its strip.
  struct Place {
    int knot = 0;       ///< the knot at or before the time, counted over all strips
    int next_knot = 0;  ///< the one after; the same for a strip with a single knot
    double next = 0.0;  ///< share of next_knot, 0 … 1
  };
  Place placeOf(int strip, double time) const;
  /// The expectation of the errors of a strip at a time: a linear combination of blocks of
  /// unknowns, and the shares of the variances of two components that remain where there is no
  /// knot.
  struct Expectation {
    double time = 0.0;
    std::vector<std::pair<int, double>> blocks;  ///< with their weights, in increasing order
    double gauss_markov_left = 0.0, smooth_left = 0.0;
  };
  /// A knot_spacing apart from the start of the strip to its end; where nothing was observed,
  /// between the neighbouring knots. None in long gaps, where it does not vary.
  std::vector<Expectation> expectationsOf(int strip) const;
  /// What remains of the variances of a strip's errors, m^2 and rad^2.
  std::array<double, kPerKnot> variancesLeft(int strip, const Expectation& at,
                                             const VarianceFactors& levels) const;
  /// The errors of a strip according to a solution (AdjustmentSolution::shared), at the times of
  /// expectationsOf().
  std::vector<TrajectoryErrorKnot> errorsOf(int strip, const Eigen::VectorXd& solution) const;

  /// Variance of a strip's shift in an area, each axis, m^2.
  double localVariance(const VarianceFactors& levels) const {
    return model_.local * model_.local * levels.local;
  }

  /// Multiplies the prior variance of one component (east north up pitch roll heading) of a strip's
  /// errors, 1 by default; for the sensitivity of a solution to its prior.
  void setVarianceFactor(int strip, int component, double factor);

  /// A priori variances of the errors at a knot, m^2 and rad^2, sums of their components.
  using Variances = std::array<double, kPerKnot>;
  Variances variances(const VarianceFactors& levels) const;

  /// Information matrix of the prior, unknowns x unknowns, block by block (east north up pitch roll
  /// heading).
  Eigen::SparseMatrix<double> priorInformation(
      const VarianceFactors& levels = VarianceFactors()) const;
  /// Logarithm of its determinant.
  double priorLogDeterminant(const VarianceFactors& levels = VarianceFactors()) const;

  /// Variance components of the trajectory errors: VarianceFactors::values() without the last.
  static constexpr int kTrajectoryComponents = VarianceFactors::kCount - 1;
  /// The part of priorInformation() that is inversely proportional to each of them. The sum is
  /// priorInformation() without the instrument's.
  std::vector<Eigen::SparseMatrix<double>> priorParts(const VarianceFactors& levels) const;
  /// The number of independent variables of each component.
  Eigen::VectorXd priorVariables() const;
  /// The contributions of the components to the errors at the knots according to a solution:
  /// observedUnknowns() x kTrajectoryComponents.
  Eigen::MatrixXd contributions(const Eigen::VectorXd& solution) const;

 private:
  struct StripKnots {
    double start = 0.0, spacing = 1.0;  ///< seconds
    int steps = 0;                      ///< from start to end
    int first = 0;                      ///< knot, counted over all strips
    std::vector<int> at;                ///< steps at which the strip has its knots
    double per_node = 1.0;              ///< steps between nodes of the smooth component
    std::vector<int> nodes;             ///< of the coefficients that have an effect at a knot
    int first_node = 0;                 ///< block of unknowns of the first coefficient
    int constant = 0;                   ///< block of unknowns of the constant
    std::array<double, kPerKnot> variance_factors{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    /// The knot of the strip at or before a step; 0 before the first.
    int before(double step) const;
    /// The first and the last step, and those within \a reach of a knot.
    std::vector<int> stepsWithin(double reach) const;
  };
  static StripKnots knotsOf(const TimeSpan& span, double spacing,
                            const std::vector<TimeSpan>* observed);

  using Weights = std::vector<std::pair<int, double>>;  ///< blocks of unknowns with their weights
  void addCoefficients(StripKnots& strip);
  /// The constant and the smooth component at a step, linear in their coefficients.
  Weights coefficientsAt(const StripKnots& strip, int step) const;
  void assembleGaussMarkov();
  /// A priori variance of the unknowns of a block: a knot's Gauss-Markov component, the instrument,
  /// a coefficient.
  Variances shareOf(double share, const VarianceFactors::Trajectory& levels) const;
  struct PriorVariances {
    Variances gauss_markov, smooth, constant;
    std::array<double, kInstrumentBlocks * kPerKnot> instrument;
    std::vector<double> systems;  ///< of their blocks
  };
  PriorVariances priorVariances(const VarianceFactors& levels) const;
  /// Information of every unknown: of a Gauss-Markov component of its strip, and its own.
  struct PriorDiagonals {
    Eigen::VectorXd gauss_markov, own;
  };
  PriorDiagonals priorDiagonals(const VarianceFactors& levels) const;

  const StripKnots& passOf(int strip) const;
  std::vector<double> systemVariances() const;

  std::vector<StripKnots> strips_;  ///< by pass
  std::vector<int> pass_;           ///< by strip: index in strips_
  StripSystems systems_;
  /// By system after the first: a priori standard deviations of differences; zero: shared.
  std::vector<std::array<double, kSystemUnknownCount>> own_;
  int knot_count_ = 0, coefficient_count_ = 0;
  /// Information of the Gauss-Markov components with a variance of one, and the logarithm of its
  /// determinant.
  Eigen::SparseMatrix<double> gauss_markov_;
  double gauss_markov_log_ = 0.0;
  SharedErrorModel model_;
  std::vector<ErrorSource> considered_{ErrorSource::slope_ranging};
};

}  // namespace pcl_als
