// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "alignment_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>

#include "strip_deformation.h"

namespace pcl_als {

const char* toString(PatchAlignmentResult::Status status) {
  switch (status) {
    case PatchAlignmentResult::Status::converged:
      return "converged";
    case PatchAlignmentResult::Status::not_converged:
      return "not_converged";
    case PatchAlignmentResult::Status::too_few_pairs:
      return "too_few_pairs";
    default:
      return "no_overlap";
  }
}

const char* PatchAlignmentResult::name(int parameter) {
  static constexpr const char* kNames[kParameters] = {"XT", "YT", "ZT", "omega", "phi", "kappa"};
  return kNames[parameter];
}

double PatchAlignmentResult::standardDeviation(int parameter) const {
  return std::sqrt(std::max(0.0, covariance(parameter, parameter)));
}

double PatchAlignmentResult::formalStandardDeviation(int parameter) const {
  return std::sqrt(std::max(0.0, covariance_formal(parameter, parameter)));
}

namespace registration {
namespace {

constexpr double kGentleCosine = 0.98481;  // 10 degrees
// metres: a priori uncertainty of a direction that is left unchanged
constexpr double kHeldDirectionStd = 1.0;
constexpr double kNoVariance = 1e-18;  // m^2: an unknown in directions that are not determined

std::string describeUncertainty(double std) {
  char text[120];
  std::snprintf(text, sizeof text,
                "its standard deviation is %.2g m, with the errors that neighbouring points share",
                std);
  return text;
}

DistanceSummary summary(const RunningStatistics& statistics) {
  return {statistics.mean(), statistics.rms()};
}

}  // namespace

AlignmentReport::Matrix6d AlignmentReport::ofParameters(const UnknownsMatrix& covariance,
                                                        const RigidMotion& motion) const {
  Matrix6d jacobian = Matrix6d::Identity();
  jacobian.bottomRightCorner<3, 3>() = motion.anglesFromTurn() / frame_.radius;
  return jacobian * covariance.topLeftCorner<6, 6>() * jacobian.transpose();
}

UnknownsMatrix AlignmentReport::ofWeakDirections() const {
  UnknownsMatrix weak = UnknownsMatrix::Zero();
  for (int i = 0; i < directions_.weak; ++i) {
    const double std = std::min(directions_.std[i], kHeldDirectionStd);
    weak += std * std * directions_.vectors.col(i) * directions_.vectors.col(i).transpose();
  }
  return weak;
}

void AlignmentReport::estimate(const PlanGrid& groups, PatchAlignmentResult& result) {
  const PatchAdjustment adjustment(pairs_, frame_, RobustWeight(), 1);
  const auto parts = adjustment.accumulateGroups(scatter_, groups.size());
  groups_ = 0;
  NormalEquations all;
  for (const NormalEquations& part : parts) {
    all.merge(part);
    groups_ += part.weights > 0.0 ? 1 : 0;
  }
  formal_ = cofactor(all, directions_);
  jackknife_ = jackknifeOfParts(parts, groups, directions_);
  correlated_ = adjustment.correlated(scatter_, directions_);
  const Unknowns bent = deformationOf(pairs_, frame_, scatter_, directions_);
  Unknowns raise = Unknowns::Zero();
  for (int i = 0; i < directions_.unknowns; ++i) {
    double excess = 0.0;
    if (i < PatchAlignmentResult::kParameters) {
      const double scale = i < 3 ? 1.0 : frame_.radius;
      excess = scale * scale *
               (std::pow(result.surface_std[i], 2) + std::pow(result.convergence_std[i], 2));
      result.deformation_std[i] = std::sqrt(bent[i]) / scale;
    }
    const double formal = formal_(i, i);
    const double variance =
        std::max({formal + bent[i], jackknife_(i, i), correlated_(i, i)}) + excess;
    raise[i] = formal > kNoVariance ? std::sqrt(variance / formal) : 0.0;
  }
  // Raised along the axes, of the determined directions alone.
  UnknownsMatrix determined = UnknownsMatrix::Zero();
  const int n = directions_.unknowns;
  const Eigen::MatrixXd basis = directions_.basis().topRows(n);
  determined.topLeftCorner(n, n) = basis * basis.transpose();
  covariance_ = determined * raise.asDiagonal() * formal_ * raise.asDiagonal() * determined;
}

HeldDirections AlignmentReport::undetermined() const {
  const double limit = settings_.determined_std * settings_.determined_std;
  const Eigen::MatrixXd basis = directions_.basis();
  const int n = directions_.unknowns, strong = directions_.strong();
  HeldDirections held;
  if (strong == 0) return held;
  const Eigen::MatrixXd part = covariance_.topLeftCorner(n, n), own = basis.topRows(n);
  const auto eigen = symmetricEigen(own.transpose() * part * own);
  const Eigen::MatrixXd vectors = basis * eigen.vectors;
  Unknowns left = covariance_.diagonal();
  for (int i = strong - 1; i >= 0; --i) {
    if (eigen.values[i] < limit && left.maxCoeff() < limit) break;
    held.vectors.emplace_back(vectors.col(i));
    held.std.push_back(std::sqrt(std::max(0.0, eigen.values[i])));
    left -= eigen.values[i] * vectors.col(i).cwiseAbs2();
  }
  return held;
}

void AlignmentReport::fillParameters(PatchAlignmentResult& result) const {
  const Unknowns of_weak = ofWeakDirections().diagonal(), all = of_weak + covariance_.diagonal();
  const double limit = settings_.determined_std * settings_.determined_std;
  std::string weak;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    auto& parameter = result.parameters[p];
    parameter.determined = all[p] < limit;
    if (parameter.determined) continue;
    parameter.reason = of_weak[p] < limit ? describeUncertainty(std::sqrt(all[p]))
                                          : describeWeakness(directions_, p, frame_.radius);
    weak += (weak.empty() ? "" : ", ") + std::string(PatchAlignmentResult::name(p));
  }
  if (!weak.empty()) result.message = "not determined: " + weak;
}

void AlignmentReport::fillCovariance(PatchAlignmentResult& result) const {
  const UnknownsMatrix weak = ofWeakDirections();
  Eigen::Matrix<double, PatchAlignmentResult::kParameters, 1> keep;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p)
    keep[p] = result.parameters[p].determined ? 1.0 : 0.0;
  const auto filled = [&](const UnknownsMatrix& covariance) -> Matrix6d {
    if (!(covariance.trace() > 0.0)) return Matrix6d::Zero();
    return keep.asDiagonal() * ofParameters(covariance + weak, result.motion) * keep.asDiagonal();
  };
  result.jackknife_groups = groups_;
  result.covariance = filled(covariance_);
  result.covariance_formal = filled(formal_);
  result.covariance_jackknife = filled(jackknife_);
  result.covariance_correlated = filled(correlated_);
  if (frame_.with_scale) result.scale_std = std::sqrt(covariance_(6, 6)) / frame_.radius;
}

void AlignmentReport::fillFit(PatchAlignmentResult& result) const {
  RunningStatistics before, after, vertical_before, vertical_after;
  for (const PatchPair& pair : pairs_) {
    if (pair.source_point) ++result.source_points;
    if (RobustWeight().rejects(pair.distance, scatter_.sigmaOf(pair))) continue;
    before.add(pair.start_distance);
    after.add(pair.distance);
    const double up = pair.normal.z();
    if (up < kGentleCosine) continue;
    vertical_before.add(pair.start_distance / up);
    vertical_after.add(pair.distance / up);
  }
  result.pairs = pairs_.size();
  result.normal_before = summary(before);
  result.normal_after = summary(after);
  result.vertical_before = summary(vertical_before);
  result.vertical_after = summary(vertical_after);
  result.vertical_pairs = vertical_before.count();
}

void AlignmentReport::fill(PatchAlignmentResult& result) const {
  result.sigma0 = scatter_.all();
  result.radius = frame_.radius;
  fillParameters(result);
  fillCovariance(result);
  fillFit(result);
  const auto unknowns = static_cast<std::size_t>(directions_.strong());
  result.redundancy = result.pairs - std::min(result.pairs, unknowns);
  if (result.status == PatchAlignmentResult::Status::not_converged)
    result.message = "no convergence in " + std::to_string(result.iterations) + " iterations";
}

std::string describeWeakness(const Directions& directions, int parameter, double radius) {
  int worst = 0;
  const auto share = [&](int i) {
    return std::abs(directions.vectors(parameter, i)) * std::min(directions.std[i], 1.0);
  };
  for (int i = 1; i < directions.weak; ++i)
    if (share(i) > share(worst)) worst = i;
  const double information = std::max(directions.values[worst], 1e-12);
  const double effect = std::sqrt(information / std::max(directions.weights, 1e-12));
  char text[300];
  std::snprintf(text, sizeof text,
                "%s changes the patches' normal distances by %.2g mm (RMS) only, its standard "
                "deviation would be %.2g m%s; slopes that face the right way are missing",
                parameter < 3 ? "a shift of 1 m" : "a turn that moves points by 1 m", 1e3 * effect,
                std::min(directions.std[worst], 1e6),
                worst < directions.held ? ", with the errors that neighbouring points share" : "");
  return parameter < 3 ? text : std::string(text) + " (radius " + std::to_string(radius) + " m)";
}

}  // namespace registration
}  // namespace pcl_als
