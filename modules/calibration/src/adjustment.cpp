// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "adjustment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/ordered_results.h>
#include <pcl_als/common/parallel.h>

#include "adjustment_reduced.h"
#include "area_normal.h"
#include "block_cholesky.h"
#include "chosen_parameters.h"
#include "error_normal.h"
#include "spike_and_slab.h"
#include "strip_covariance.h"

namespace pcl_als {
namespace {

constexpr int kKnot = SharedErrors::kPerKnot;
constexpr int kGlobal = kSystemParameterCount;

SystemMatrix slopeNoiseOf(const AreaObservations& area, const std::vector<double>& weights) {
  SystemMatrix sum = SystemMatrix::Zero();
  for (std::size_t i = 0; i < area.size(); ++i) {
    const PairObservation& o = area[i];
    if (weights[i] == 0.0 || o.tilt.isZero(0.0F)) continue;
    const Eigen::Matrix<double, 2, kGlobal> tilt = o.tilt.cast<double>();
    sum += weights[i] / o.variance * tilt.transpose() * tilt;
  }
  return sum;
}

}  // namespace

Adjustment::Adjustment(const SharedErrors& errors, int threads)
    : errors_(errors), threads_(threads), areas_(std::make_shared<const Areas>()) {}
Adjustment::~Adjustment() = default;
Adjustment::Adjustment(const Adjustment&) = default;
Adjustment& Adjustment::operator=(const Adjustment&) = default;

Adjustment::Adjustment(const Adjustment& whole, const std::vector<bool>& areas)
    : errors_(whole.errors_), threads_(whole.threads_) {
  Areas some;
  for (std::size_t area = 0; area < areas.size(); ++area) {
    if (!areas[area]) continue;
    some.normals.push_back(whole.areas_->normals[area]);
    some.slope_noise.push_back(whole.areas_->slope_noise[area]);
  }
  areas_ = std::make_shared<const Areas>(std::move(some));
  setVarianceFactors(whole.levels_);
}

void Adjustment::accumulate(const std::vector<AreaObservations>& areas,
                            const std::vector<std::vector<double>>& weights) {
  std::vector<std::unique_ptr<AreaNormal>> normals(areas.size());
  Areas all;
  all.slope_noise.resize(areas.size());
  parallelFor(areas.size(), threads_, [&](std::size_t area) {
    normals[area] = std::make_unique<AreaNormal>(areas[area], weights[area], errors_);
    all.slope_noise[area] = slopeNoiseOf(areas[area], weights[area]);
  });
  for (auto& normal : normals) all.normals.push_back(std::move(*normal));
  areas_ = std::make_shared<const Areas>(std::move(all));
  setVarianceFactors(levels_);
}

std::unique_ptr<const ErrorNormal> Adjustment::assemble(double shift_variance) const {
  auto normal = std::make_unique<ErrorNormal>(errors_.unknowns());
  const BiasPrior& prior = errors_.model().biases;
  normal->gg += prior.information;
  normal->right_g += prior.information * prior.mean;
  computeInOrder(
      areas_->normals.size(), threads_,
      [&](std::size_t area) { return areas_->normals[area].reduced(shift_variance); },
      [&](std::size_t area, const AreaNormal::Reduced& reduced) {
        normal->add(reduced, areas_->normals[area].knots());
      });
  return normal;
}

void Adjustment::setVarianceFactors(const VarianceFactors& levels) {
  levels_ = levels;
  if (areas_->normals.empty()) return;
  normal_ = assemble(errors_.localVariance(levels_));
  reduced_ = std::make_shared<const Reduced>(reduce(*normal_, levels_));
}

Adjustment::Reduced Adjustment::reduce(const ErrorNormal& normal,
                                       const VarianceFactors& levels) const {
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels);
  const BlockCholesky factor(normal.tt, prior);
  Reduced reduced;
  reduced.elimination = factor.solve(normal.tg);
  reduced.eliminated_right = factor.solve(normal.right_t);
  Eigen::MatrixXd sources = Eigen::MatrixXd::Zero(errors_.unknowns(), kErrorSourceCount);
  sources.middleRows<kErrorSourceCount>(errors_.instrumentBlock() * kKnot).setIdentity();
  reduced.with_sources = factor.solve(sources);
  const Eigen::Index systems =
      Eigen::Index{errors_.systems().count - 1} * SharedErrors::kSystemBlocks * kKnot;
  Eigen::MatrixXd of_systems = Eigen::MatrixXd::Zero(errors_.unknowns(), systems);
  of_systems.middleRows(Eigen::Index{errors_.systemBlock(1)} * kKnot, systems).setIdentity();
  if (systems > 0) reduced.with_systems = factor.solve(of_systems);
  reduced.normal = normal.gg - normal.tg.transpose() * reduced.elimination;
  reduced.normal = (0.5 * (reduced.normal + reduced.normal.transpose())).eval();
  reduced.right = normal.right_g - normal.tg.transpose() * reduced.eliminated_right;
  reduced.prior_share = reduced.elimination.transpose() * (prior * reduced.elimination);
  return reduced;
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

std::unique_ptr<const StripCovariance> Adjustment::stripCovariance(
    const AdjustmentSolution& solution) const {
  if (normal_ == nullptr) return nullptr;
  const BlockCholesky factor(normal_->tt, errors_.priorInformation(levels_));
  return std::make_unique<const StripCovariance>(errors_, levels_, factor.inverse(threads_),
                                                 reduced_->elimination, solution.covariance);
}

double Adjustment::residual(const PairObservation& observation,
                            const AdjustmentSolution& solution) const {
  return observation.misclosure - observation.row() * solution.biases -
         sharedEffect(observation, errors_, solution.shared);
}

Adjustment::Share Adjustment::shareOf(std::size_t area, const AdjustmentSolution& solution) const {
  // From the normal equations of the area: h - N (parameters, knots), reduced by the elimination of
  // the knots.
  const AreaNormal::Reduced own = areas_->normals[area].reduced(errors_.localVariance(levels_));
  const std::vector<int>& knots = areas_->normals[area].knots();
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
  std::vector<double> shares(areas_->normals.size(), 0.0);
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (estimate.empty() || !invert(sub(normalOf(estimate), estimate), inverse, ignored))
    return shares;
  const AdjustmentSolution zero = unsolved(SystemVector::Zero());
  parallelFor(shares.size(), threads_, [&](std::size_t area) {
    shares[area] = (inverse * sub(shareOf(area, zero).normal, estimate)).trace();
  });
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

SystemMatrix Adjustment::jackknife(const AdjustmentSolution& solution,
                                   const std::vector<SystemParameter>& estimate,
                                   const SystemMatrix& all) const {
  const Eigen::MatrixXd normal = sub(all, estimate);
  std::vector<Eigen::VectorXd> moves(areas_->normals.size());
  parallelFor(moves.size(), threads_, [&](std::size_t area) {
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
    if (!areas_->normals[area].knots().empty()) groups += 1.0;
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
  const SystemMatrix sum = std::accumulate(areas_->slope_noise.begin(), areas_->slope_noise.end(),
                                           SystemMatrix(SystemMatrix::Zero()));
  const Eigen::MatrixXd noise = scale.asDiagonal() * sub(sum, estimate) * scale.asDiagonal();
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
                                     const SystemVector& held,
                                     const SystemVector& prior_information) const {
  AdjustmentSolution solution = unsolved(held);
  for (const SystemParameter p : estimate) solution.biases[indexOf(p)] = 0.0;
  SystemMatrix known = errors_.model().biases.marginal(estimate).information;
  known.diagonal() += prior_information;
  SystemMatrix independent = known, normal = normalOf(estimate);
  normal.diagonal() += prior_information;
  for (std::size_t area = 0; area < areas_->normals.size(); ++area)
    independent += areas_->normals[area].parameters();
  Eigen::MatrixXd inverse, formal;
  double ignored = 0.0;
  if (!invert(sub(normal, estimate), inverse, ignored) ||
      !invert(sub(independent, estimate), formal, ignored)) {
    return solution;
  }
  const SystemMatrix model = expanded(inverse, estimate);
  solution.biases += model * (rightOf(estimate) - normal * solution.biases);
  solution.shared = reduced_->eliminated_right - reduced_->elimination * solution.biases;
  solution.formal = expanded(formal, estimate);
  const SystemMatrix of_prior = model * known * model;
  const SystemMatrix robust =
      jackknife(solution, estimate, normal) + model * (reduced_->prior_share + known) * model;
  const Eigen::VectorXd slopes = slopeNoise(sub(independent, estimate), estimate);
  SystemVector inflation = SystemVector::Ones(), inflation_flight = SystemVector::Ones();
  for (std::size_t k = 0; k < estimate.size(); ++k) {
    const int i = indexOf(estimate[k]);
    const double slope = slopes[static_cast<Eigen::Index>(k)];
    const double of_flight = robust(i, i) - of_prior(i, i);
    const double by_model = model(i, i) - of_prior(i, i);
    inflation[i] = slope * std::max(1.0, std::sqrt(robust(i, i) / model(i, i)));
    inflation_flight[i] =
        slope * (by_model > 0.0 ? std::max(1.0, std::sqrt(of_flight / by_model)) : 1.0);
  }
  const SystemMatrix change = averageSources(model, solution);
  solution.model = model;
  solution.covariance = inflation.asDiagonal() * (model + change) * inflation.asDiagonal();
  // C N C, with N without the prior.
  solution.of_flight = inflation_flight.asDiagonal() * (model * (normal - known) * model + change) *
                       inflation_flight.asDiagonal();
  solution.solved = true;
  return solution;
}

namespace {

/// Columns of all error sources for those of \a sources.
template <class Matrix>
Eigen::MatrixXd columnsOf(const Matrix& all, const std::vector<ErrorSource>& sources) {
  Eigen::MatrixXd columns(all.rows(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = all.col(indexOf(sources[i]));
  return columns;
}

}  // namespace

Adjustment::Influence Adjustment::sourceInfluence(const SystemMatrix& model,
                                                  const std::vector<ErrorSource>& sources) const {
  const Eigen::MatrixXd elimination =
      reduced_->elimination.middleRows<kErrorSourceCount>(errors_.instrumentBlock() * kKnot)
          .transpose();
  Influence influence;
  influence.biases = columnsOf(Eigen::MatrixXd(-model * elimination), sources);
  influence.shared =
      columnsOf(reduced_->with_sources, sources) - reduced_->elimination * influence.biases;
  return influence;
}

SystemVector Adjustment::derivativeBySource(ErrorSource source,
                                            const std::vector<SystemParameter>& estimate) const {
  const Influence influence = sourceInfluence(modelCovariance(estimate), {source});
  return influence.biases.col(0) / influence.shared(errors_.sourceUnknown(source), 0);
}

Adjustment::AreaResiduals Adjustment::areaResiduals(const AdjustmentSolution& solution) const {
  AreaResiduals residuals(areas_->normals.size());
  parallelFor(residuals.size(), threads_, [&](std::size_t area) {
    const AreaNormal::Reduced own = areas_->normals[area].reduced(errors_.localVariance(levels_));
    const std::vector<int>& knots = areas_->normals[area].knots();
    Eigen::VectorXd unknowns(own.right.size());
    unknowns.head<kGlobal>() = solution.biases;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      const auto at = kGlobal + static_cast<Eigen::Index>(i) * kKnot;
      unknowns.segment<kKnot>(at) = solution.shared.segment<kKnot>(knots[i] * kKnot);
    }
    residuals[area] = own.right - own.matrix * unknowns;
  });
  return residuals;
}

std::vector<Eigen::VectorXd> Adjustment::areaScores(const Influence& influence,
                                                    const AreaResiduals& residuals) const {
  std::vector<Eigen::VectorXd> scores(residuals.size());
  parallelFor(scores.size(), threads_, [&](std::size_t area) {
    const std::vector<int>& knots = areas_->normals[area].knots();
    Eigen::MatrixXd on_values(residuals[area].size(), influence.biases.cols());
    on_values.topRows<kGlobal>() = influence.biases;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      const auto at = kGlobal + static_cast<Eigen::Index>(i) * kKnot;
      on_values.middleRows<kKnot>(at) = influence.shared.middleRows<kKnot>(knots[i] * kKnot);
    }
    scores[area] = on_values.transpose() * residuals[area];
  });
  return scores;
}

Adjustment::SourceCertainty Adjustment::sourceCertainty(const Influence& influence,
                                                        const AdjustmentSolution& solution) const {
  const std::vector<Eigen::VectorXd> moves = areaScores(influence, areaResiduals(solution));
  Eigen::VectorXd scatter = Eigen::VectorXd::Zero(influence.biases.cols());
  double groups = 0.0;
  for (const Eigen::VectorXd& move : moves) {
    scatter += move.cwiseAbs2();
    if (!move.isZero(0.0)) groups += 1.0;
  }
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels_);
  SourceCertainty certainty{1.0, std::max(1.0, groups - 1.0)};
  for (Eigen::Index i = 0; i < scatter.size(); ++i) {
    const ErrorSource source = errors_.consideredSources()[static_cast<std::size_t>(i)];
    const double slab = errors_.model().sources[static_cast<std::size_t>(indexOf(source))].std;
    const double variance = influence.shared(errors_.sourceUnknown(source), i);
    const double of_prior = influence.shared.col(i).dot(prior * influence.shared.col(i));
    // Of what the observations determine: the part of the variance that the model ascribes to them.
    if (std::sqrt(variance) < SharedErrorModel::kDetermined * slab)
      certainty.overdispersion =
          std::max(certainty.overdispersion, scatter[i] / (variance - of_prior));
  }
  return certainty;
}

SystemMatrix Adjustment::averageSources(const SystemMatrix& model,
                                        AdjustmentSolution& solution) const {
  const std::vector<ErrorSource>& sources = errors_.consideredSources();
  const Influence influence = sourceInfluence(model, sources);
  std::vector<SpikeAndSlab::Prior> priors;
  Eigen::VectorXd mean(sources.size());
  Eigen::MatrixXd covariance(sources.size(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const SharedErrorModel::SourcePrior& prior =
        errors_.model().sources[static_cast<std::size_t>(indexOf(sources[i]))];
    priors.push_back({prior.absent, prior.std_absent * prior.std_absent, prior.std * prior.std});
    const auto row = static_cast<Eigen::Index>(i);
    mean[row] = solution.shared[errors_.sourceUnknown(sources[i])];
    covariance.row(row) = influence.shared.row(errors_.sourceUnknown(sources[i]));
  }
  // The scatter between areas limits what is said of further sources; that of the ranging error on
  // slopes, which every solution contains, is in the standard deviations of the parameters.
  SpikeAndSlab::Certainty certainty;
  if (sources.size() > 1) {
    const SourceCertainty found = sourceCertainty(influence, solution);
    certainty = {found.overdispersion, found.freedom};
  }
  const SpikeAndSlab mixture(priors, mean, 0.5 * (covariance + covariance.transpose()), certainty);
  solution.biases += mixture.move(influence.biases);
  solution.shared += mixture.move(influence.shared);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    solution.source_probability[indexOf(sources[i])] = mixture.presence()[row];
    solution.source_value[indexOf(sources[i])] = mixture.valueIfPresent()[row];
    solution.source_std[indexOf(sources[i])] = mixture.stdIfPresent()[row];
  }
  return mixture.change(influence.biases);
}

}  // namespace pcl_als
