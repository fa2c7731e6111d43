// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Adjustment::restrictedLikelihood(): the deviance of variance components and its derivatives.
#include <memory>

#include <pcl_als/common/ordered_results.h>

#include "adjustment.h"
#include "adjustment_reduced.h"
#include "block_cholesky.h"
#include "chosen_parameters.h"
#include "error_normal.h"

namespace pcl_als {
namespace {

constexpr int kGlobal = ErrorNormal::kGlobal, kKnot = ErrorNormal::kKnot;
constexpr int kComponents = VarianceFactors::kCount;
constexpr int kLocal = kComponents - 1;

/// A column or a row for each estimated parameter.
template <class Matrix>
Eigen::MatrixXd columnsOf(const Matrix& all, const std::vector<SystemParameter>& estimate) {
  Eigen::MatrixXd columns(all.rows(), estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = all.col(indexOf(estimate[i]));
  return columns;
}

/** \brief The normal equations H x = b of the estimated parameters (g) and the shared errors (t),
 * with the prior information of the variance components v_k, P = sum of Q_k / v_k.
 *
 * The deviance is ln |H| - ln |P| - b'x and terms of the areas. Its derivative with respect to
 * ln v_k is n_k - tr(H^-1 P_k) - x'P_k x, with P_k = Q_k / v_k and n_k variables of the component.
 * The average information of two components is s_k'N s_l - (N s_k)'H^-1 (N s_l), with the
 * contributions s_k of the components to x and the normal matrix N of the observations.
 */
class LikelihoodEquations {
 public:
  LikelihoodEquations(const SharedErrors& errors, const VarianceFactors& levels,
                      const ErrorNormal& normal, const std::vector<SystemParameter>& estimate);

  bool solved() const { return solved_; }
  double deviance() const;
  void differentiate(const std::vector<AreaNormal>& areas, int threads,
                     RestrictedLikelihood& result) const;

 private:
  void addTrajectory(const InverseEntries& inverse, RestrictedLikelihood& result) const;
  /// Sums over the areas; ErrorNormal::right_g and right_t are the effect of the shifts.
  ErrorNormal shiftTerms(const std::vector<AreaNormal>& areas, int threads,
                         RestrictedLikelihood& result) const;
  void addInformation(const ErrorNormal& shifts, RestrictedLikelihood& result) const;
  /// The solution for the unknowns of an area.
  Eigen::VectorXd valuesOf(const AreaNormal& area) const;
  /// Trace of the product of H^-1 and the matrix of these equations.
  double traceWith(const ErrorNormal& equations, const InverseEntries& inverse) const;

  const SharedErrors& errors_;
  const VarianceFactors& levels_;
  const ErrorNormal& normal_;
  const std::vector<SystemParameter>& estimate_;
  BlockCholesky factor_;         ///< of H_tt
  Eigen::MatrixXd coupling_;     ///< H_tg
  Eigen::MatrixXd elimination_;  ///< H_tt^-1 H_tg
  Eigen::MatrixXd inverse_gg_;   ///< of H
  SystemVector parameters_ = SystemVector::Zero();
  Eigen::VectorXd shared_;
  double log_parameters_ = 0.0, explained_ = 0.0;
  bool solved_ = false;
};

LikelihoodEquations::LikelihoodEquations(const SharedErrors& errors, const VarianceFactors& levels,
                                         const ErrorNormal& normal,
                                         const std::vector<SystemParameter>& estimate)
    : errors_(errors),
      levels_(levels),
      normal_(normal),
      estimate_(estimate),
      factor_(normal.tt, errors.priorInformation(levels)),
      coupling_(columnsOf(normal.tg, estimate)) {
  Eigen::MatrixXd right(coupling_.rows(), coupling_.cols() + 1);
  right << coupling_, normal.right_t;
  const Eigen::MatrixXd solution = factor_.solve(right);
  elimination_ = solution.leftCols(coupling_.cols());
  const PriorChange prior(errors.model().biases, estimate);
  const Eigen::MatrixXd reduced =
      sub(normal.gg + prior.normal, estimate) - coupling_.transpose() * elimination_;
  if (!invert(0.5 * (reduced + reduced.transpose()), inverse_gg_, log_parameters_)) return;
  const Eigen::VectorXd eliminated_right = solution.rightCols<1>();
  const Eigen::VectorXd right_g =
      columnsOf((normal.right_g + prior.right).transpose(), estimate).transpose() -
      coupling_.transpose() * eliminated_right;
  const Eigen::VectorXd parameters = inverse_gg_ * right_g;
  for (std::size_t i = 0; i < estimate.size(); ++i)
    parameters_[indexOf(estimate[i])] = parameters[static_cast<Eigen::Index>(i)];
  shared_ = eliminated_right - elimination_ * parameters;
  explained_ = normal.right_t.dot(eliminated_right) + right_g.dot(parameters);
  solved_ = true;
}

double LikelihoodEquations::deviance() const {
  return normal_.log_determinant + factor_.logDeterminant() - errors_.priorLogDeterminant(levels_) +
         log_parameters_ - normal_.explained - explained_;
}

Eigen::VectorXd LikelihoodEquations::valuesOf(const AreaNormal& area) const {
  const auto knots = static_cast<Eigen::Index>(area.knots().size());
  Eigen::VectorXd values(kGlobal + knots * kKnot);
  values.head<kGlobal>() = parameters_;
  for (Eigen::Index i = 0; i < knots; ++i) {
    values.segment<kKnot>(kGlobal + i * kKnot) =
        shared_.segment<kKnot>(area.knots()[static_cast<std::size_t>(i)] * kKnot);
  }
  return values;
}

double LikelihoodEquations::traceWith(const ErrorNormal& equations,
                                      const InverseEntries& inverse) const {
  const Eigen::MatrixXd coupling = columnsOf(equations.tg, estimate_);
  const Eigen::MatrixXd of_parameters = sub(equations.gg, estimate_) -
                                        2.0 * elimination_.transpose() * coupling +
                                        elimination_.transpose() * equations.times(elimination_);
  return inverse.traceOfProduct(equations.tt) + (inverse_gg_ * of_parameters).trace();
}

void LikelihoodEquations::addTrajectory(const InverseEntries& inverse,
                                        RestrictedLikelihood& result) const {
  const auto parts = errors_.priorParts(levels_);
  const Eigen::VectorXd variables = errors_.priorVariables();
  for (int k = 0; k < kLocal; ++k) {
    const Eigen::SparseMatrix<double>& part = parts[static_cast<std::size_t>(k)];
    const Eigen::MatrixXd of_parameters = elimination_.transpose() * (part * elimination_);
    result.gradient[k] = variables[k] - inverse.traceOfProduct(part) -
                         (inverse_gg_ * of_parameters).trace() - shared_.dot(part * shared_);
  }
}

ErrorNormal LikelihoodEquations::shiftTerms(const std::vector<AreaNormal>& areas, int threads,
                                            RestrictedLikelihood& result) const {
  ErrorNormal sum(errors_.unknowns());
  const double variance = errors_.localVariance(levels_);
  computeInOrder(
      areas.size(), threads,
      [&](std::size_t i) { return areas[i].shiftTerms(variance, valuesOf(areas[i])); },
      [&](std::size_t i, const AreaNormal::ShiftTerms& terms) {
        sum.add(terms.change, areas[i].knots());
        result.information(kLocal, kLocal) += terms.information;
      });
  return sum;
}

void LikelihoodEquations::addInformation(const ErrorNormal& shifts,
                                         RestrictedLikelihood& result) const {
  Eigen::MatrixXd contributions = Eigen::MatrixXd::Zero(errors_.unknowns(), kLocal);
  contributions.topRows(errors_.observedUnknowns()) = errors_.contributions(shared_);
  Eigen::MatrixXd effects_g(estimate_.size(), kComponents);
  Eigen::MatrixXd effects_t(errors_.unknowns(), kComponents);
  effects_g << coupling_.transpose() * contributions,
      columnsOf(shifts.right_g.transpose(), estimate_).transpose();
  effects_t << normal_.times(contributions), shifts.right_t;
  const Eigen::MatrixXd products = contributions.transpose() * effects_t;
  result.information.topRows<kLocal>() += products;
  result.information.row(kLocal).head<kLocal>() += products.col(kLocal).transpose();
  // What the parameters and the shared errors absorb.
  const Eigen::MatrixXd absorbed = factor_.solve(effects_t);
  effects_g -= coupling_.transpose() * absorbed;
  result.information -=
      effects_t.transpose() * absorbed + effects_g.transpose() * inverse_gg_ * effects_g;
}

void LikelihoodEquations::differentiate(const std::vector<AreaNormal>& areas, int threads,
                                        RestrictedLikelihood& result) const {
  const InverseEntries inverse = factor_.inverse(threads);
  addTrajectory(inverse, result);
  const ErrorNormal shifts = shiftTerms(areas, threads, result);
  addInformation(shifts, result);
  result.gradient[kLocal] = -shifts.log_determinant - traceWith(shifts, inverse) - shifts.explained;
}

}  // namespace

RestrictedLikelihood Adjustment::restrictedLikelihood(const VarianceFactors& levels,
                                                      const std::vector<SystemParameter>& estimate,
                                                      double differentiated_below) const {
  const bool same_local = levels.local == levels_.local;
  const std::unique_ptr<const ErrorNormal> other =
      same_local ? nullptr : assemble(errors_.localVariance(levels));
  const LikelihoodEquations equations(errors_, levels, same_local ? *normal_ : *other, estimate);
  RestrictedLikelihood result;
  if (!equations.solved()) return result;
  result.deviance = equations.deviance();
  if (result.deviance < differentiated_below)
    equations.differentiate(areas_->normals, threads_, result);
  return result;
}

}  // namespace pcl_als
