// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parallel.h>

#include "area_normal.h"
#include "block_cholesky.h"
#include "chosen_parameters.h"
#include "error_normal.h"
#include "possibly_absent.h"

namespace pcl_als {
namespace {

constexpr int kKnot = SharedErrors::kPerKnot;
constexpr int kGlobal = kSystemParameterCount;

SystemMatrix slopeNoiseOf(const AreaObservations& area, const std::vector<double>& weights) {
  SystemMatrix sum = SystemMatrix::Zero();
  for (std::size_t i = 0; i < area.size(); ++i) {
    const PairObservation& o = area[i];
    if (weights[i] == 0.0 || o.tilt_variance == 0.0) continue;
    const Eigen::Matrix<double, 3, kGlobal> design = o.design.cast<double>();
    const SystemRow row = o.normal.transpose() * design;
    sum += weights[i] / o.variance * o.tilt_variance *
           (design.transpose() * design - row.transpose() * row);
  }
  return sum;
}

}  // namespace

/// Normal equations with all shared errors eliminated.
struct Adjustment::Reduced {
  SystemMatrix normal, prior_share;
  SystemVector right;
  Eigen::Matrix<double, Eigen::Dynamic, kGlobal> elimination;  ///< N_tt^-1 N_tg
  Eigen::VectorXd eliminated_right;                            ///< N_tt^-1 h_t
  Eigen::VectorXd with_ranging;  ///< N_tt^-1, the column of the ranging share
};

Adjustment::Adjustment(const SharedErrors& errors, int threads)
    : errors_(errors), threads_(threads) {}
Adjustment::~Adjustment() = default;

void Adjustment::accumulate(const std::vector<AreaObservations>& areas,
                            const std::vector<std::vector<double>>& weights) {
  areas_ = &areas;
  weights_ = &weights;
  std::vector<std::unique_ptr<AreaNormal>> normals(areas.size());
  std::vector<SystemMatrix> noise(areas.size());
  parallelFor(areas.size(), threads_, [&](std::size_t area) {
    normals[area] = std::make_unique<AreaNormal>(areas[area], weights[area], errors_);
    noise[area] = slopeNoiseOf(areas[area], weights[area]);
  });
  slope_noise_ = std::accumulate(noise.begin(), noise.end(), SystemMatrix(SystemMatrix::Zero()));
  area_normals_.clear();
  for (auto& normal : normals) area_normals_.push_back(std::move(*normal));
  setLevels(levels_);
}

std::unique_ptr<const ErrorNormal> Adjustment::assemble(double shift_variance) const {
  std::vector<AreaNormal::Reduced> reduced(area_normals_.size());
  parallelFor(area_normals_.size(), threads_, [&](std::size_t area) {
    reduced[area] = area_normals_[area].reduced(shift_variance);
  });
  auto normal = std::make_unique<ErrorNormal>(errors_.unknowns());
  for (std::size_t area = 0; area < reduced.size();
       ++area) {  // in this order for any number of threads
    normal->add(reduced[area], area_normals_[area].knots());
  }
  return normal;
}

void Adjustment::setLevels(const SharedErrorLevels& levels) {
  levels_ = levels;
  if (areas_ == nullptr) return;
  normal_ = assemble(errors_.localVariance(levels_));
  reduced_ = std::make_unique<Reduced>(reduce(*normal_, levels_));
}

Adjustment::Reduced Adjustment::reduce(const ErrorNormal& normal,
                                       const SharedErrorLevels& levels) const {
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels);
  const BlockCholesky factor(normal.tt, prior);
  Reduced reduced;
  reduced.elimination = factor.solve(normal.tg);
  reduced.eliminated_right = factor.solve(normal.right_t);
  reduced.with_ranging =
      factor.solve(Eigen::VectorXd::Unit(errors_.unknowns(), errors_.rangingUnknown()));
  reduced.normal = normal.gg - normal.tg.transpose() * reduced.elimination;
  reduced.normal = (0.5 * (reduced.normal + reduced.normal.transpose())).eval();
  reduced.right = normal.right_g - normal.tg.transpose() * reduced.eliminated_right;
  reduced.prior_share = reduced.elimination.transpose() * (prior * reduced.elimination);
  return reduced;
}

const SystemMatrix& Adjustment::reducedNormal() const {
  return reduced_->normal;
}

SystemRow Adjustment::reducedRow(const PairObservation& observation) const {
  const TouchedRow touched(observation, errors_);
  SystemRow row = touched.row.head<kGlobal>();
  for (int slot = 0; slot < TouchedRow::kSlots; ++slot) {
    if (touched.knots[slot] < 0) continue;
    row -= touched.row.segment<kKnot>(TouchedRow::slot(slot)) *
           reduced_->elimination.middleRows<kKnot>(touched.knots[slot] * kKnot);
  }
  return row;
}

double Adjustment::residual(const PairObservation& observation,
                            const AdjustmentSolution& solution) const {
  const TouchedRow touched(observation, errors_);
  double left = observation.misclosure - touched.row.head<kGlobal>() * solution.biases;
  for (int slot = 0; slot < TouchedRow::kSlots; ++slot) {
    if (touched.knots[slot] < 0) continue;
    left -= touched.row.segment<kKnot>(TouchedRow::slot(slot)) *
            solution.shared.segment<kKnot>(touched.knots[slot] * kKnot);
  }
  return left;
}

Adjustment::Share Adjustment::shareOf(std::size_t area, const AdjustmentSolution& solution) const {
  // From the normal equations of the area: h - N (parameters, knots), reduced by the elimination of
  // the knots.
  const AreaNormal::Reduced own = area_normals_[area].reduced(errors_.localVariance(levels_));
  const std::vector<int>& knots = area_normals_[area].knots();
  Eigen::VectorXd unknowns(own.right.size());
  Eigen::MatrixXd reduction(own.right.size(), kGlobal);
  unknowns.head<kGlobal>() = solution.biases;
  reduction.topRows<kGlobal>().setIdentity();
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const auto at = kGlobal + static_cast<Eigen::Index>(i) * kKnot;
    unknowns.segment<kKnot>(at) = solution.shared.segment<kKnot>(knots[i] * kKnot);
    reduction.middleRows<kKnot>(at) = -reduced_->elimination.middleRows<kKnot>(knots[i] * kKnot);
  }
  return {reduction.transpose() * (own.right - own.matrix * unknowns),
          reduction.transpose() * own.matrix * reduction};
}

std::vector<double> Adjustment::informationShares(
    const std::vector<SystemParameter>& estimate) const {
  std::vector<double> shares(area_normals_.size(), 0.0);
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (estimate.empty() || !invert(sub(reduced_->normal, estimate), inverse, ignored)) return shares;
  const AdjustmentSolution zero = unsolved(SystemVector::Zero());
  parallelFor(shares.size(), threads_, [&](std::size_t area) {
    shares[area] = (inverse * sub(shareOf(area, zero).normal, estimate)).trace();
  });
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

SystemMatrix Adjustment::jackknife(const AdjustmentSolution& solution,
                                   const std::vector<SystemParameter>& estimate) const {
  const Eigen::MatrixXd normal = sub(reduced_->normal, estimate);
  std::vector<Eigen::VectorXd> moves(areas_->size());
  parallelFor(areas_->size(), threads_, [&](std::size_t area) {
    const Share share = shareOf(area, solution);
    Eigen::VectorXd score(estimate.size());
    for (std::size_t i = 0; i < estimate.size(); ++i) score[i] = share.score[indexOf(estimate[i])];
    Eigen::MatrixXd inverse;
    double ignored = 0.0;
    // Without an area that determines something alone, the jackknife adds nothing to the model.
    if (!invert(normal - sub(share.normal, estimate), inverse, ignored)) {
      invert(normal, inverse, ignored);
    }
    moves[area] = inverse * score;
  });
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(normal.rows(), normal.rows());
  double groups = 0.0;
  for (std::size_t area = 0; area < moves.size(); ++area) {
    if (!(*areas_)[area].empty()) groups += 1.0;
    scatter += moves[area] * moves[area].transpose();
  }
  if (groups > 1.0) scatter *= (groups - 1.0) / groups;
  return expanded(scatter, estimate);
}

Eigen::VectorXd Adjustment::slopeNoise(const Eigen::MatrixXd& independent,
                                       const std::vector<SystemParameter>& estimate) const {
  constexpr double kCaution = 2.0, kLeast = 1e-4;
  const Eigen::VectorXd scale = independent.diagonal().cwiseSqrt().cwiseInverse();
  const CholeskyFactor cholesky(scale.asDiagonal() * independent * scale.asDiagonal());
  const Eigen::MatrixXd noise =
      scale.asDiagonal() * sub(slope_noise_, estimate) * scale.asDiagonal();
  const Eigen::MatrixXd half = cholesky.solveLower(noise);
  const Eigen::MatrixXd share = cholesky.solveLower(Eigen::MatrixXd(half.transpose()));
  const auto eigen = symmetricEigen(0.5 * (share + share.transpose()));
  const Eigen::VectorXd left = (1.0 - kCaution * eigen.values.array()).max(kLeast).rsqrt().matrix();
  const Eigen::MatrixXd root = cholesky.solveUpper(eigen.vectors);
  return ((root * left.asDiagonal()).rowwise().norm().array() / root.rowwise().norm().array())
      .matrix();
}

AdjustmentSolution Adjustment::unsolved(const SystemVector& held) const {
  AdjustmentSolution solution;
  solution.biases = held;
  solution.shared = Eigen::VectorXd::Zero(errors_.unknowns());
  return solution;
}

AdjustmentSolution Adjustment::solve(const std::vector<SystemParameter>& estimate,
                                     const SystemVector& held) const {
  AdjustmentSolution solution = unsolved(held);
  for (const SystemParameter p : estimate) solution.biases[indexOf(p)] = 0.0;
  SystemMatrix independent = SystemMatrix::Zero();
  for (std::size_t area = 0; area < area_normals_.size(); ++area)
    independent += area_normals_[area].parameters();
  Eigen::MatrixXd inverse, formal;
  double ignored = 0.0;
  if (!invert(sub(reduced_->normal, estimate), inverse, ignored) ||
      !invert(sub(independent, estimate), formal, ignored)) {
    return solution;
  }
  const SystemMatrix model = expanded(inverse, estimate);
  solution.biases += model * (reduced_->right - reduced_->normal * solution.biases);
  solution.shared = reduced_->eliminated_right - reduced_->elimination * solution.biases;
  solution.formal = expanded(formal, estimate);
  const SystemMatrix robust = jackknife(solution, estimate) + model * reduced_->prior_share * model;
  const Eigen::VectorXd slopes = slopeNoise(sub(independent, estimate), estimate);
  SystemVector inflation = SystemVector::Ones();
  for (std::size_t k = 0; k < estimate.size(); ++k) {
    const int i = indexOf(estimate[k]);
    inflation[i] =
        slopes[static_cast<Eigen::Index>(k)] * std::max(1.0, std::sqrt(robust(i, i) / model(i, i)));
  }
  const SystemMatrix averaged = model + averageRangingModels(model, solution);
  solution.covariance = inflation.asDiagonal() * averaged * inflation.asDiagonal();
  solution.solved = true;
  return solution;
}

SystemMatrix Adjustment::averageRangingModels(const SystemMatrix& model,
                                              AdjustmentSolution& solution) const {
  const int at = errors_.rangingUnknown();
  const SystemVector coupling = reduced_->elimination.row(at).transpose();
  const SystemVector with_biases = -model * coupling;
  const Eigen::VectorXd with_shared = reduced_->with_ranging - reduced_->elimination * with_biases;
  const PossiblyAbsent ranging(errors_.model().ranging_absent,
                               std::pow(errors_.model().ranging_incidence, 2), solution.shared[at],
                               with_shared[at]);
  solution.biases += ranging.move(with_biases);
  solution.shared += ranging.move(with_shared);
  return ranging.change(with_biases);
}

AdjustmentSolution Adjustment::solveNearZero(const std::vector<SystemParameter>& estimate,
                                             const SystemVector& prior) const {
  AdjustmentSolution solution = unsolved(SystemVector::Zero());
  SystemMatrix normal = reduced_->normal;
  normal.diagonal() += prior.cwiseAbs2().cwiseInverse();
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (!invert(sub(normal, estimate), inverse, ignored)) return solution;
  solution.covariance = solution.formal = expanded(inverse, estimate);
  solution.biases = solution.covariance * reduced_->right;
  solution.shared = reduced_->eliminated_right - reduced_->elimination * solution.biases;
  solution.solved = true;
  return solution;
}

}  // namespace pcl_als
