// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "alignment_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {

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

void AlignmentReport::fillParameters(PatchAlignmentResult& result) const {
  std::string weak;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    double variance = 0.0;
    for (int i = 0; i < directions_.weak; ++i) {
      const double sigma = 1.0 / std::sqrt(std::max(directions_.values[i], 1e-12));
      const double share = directions_.vectors(p, i) * std::min(sigma, kHeldDirectionStd);
      variance += share * share;
    }
    auto& parameter = result.parameters[p];
    parameter.determined = variance < settings_.determined_std * settings_.determined_std;
    if (parameter.determined) continue;
    parameter.reason = describeWeakness(directions_, p, frame_.radius);
    weak += (weak.empty() ? "" : ", ") + std::string(PatchAlignmentResult::name(p));
  }
  if (!weak.empty()) result.message = "not determined: " + weak;
}

void AlignmentReport::fillCovariance(std::size_t groups, PatchAlignmentResult& result) const {
  const PatchAdjustment adjustment(pairs_, frame_, Robustness(), 1);
  const auto parts = adjustment.accumulateGroups(scatter_, groups);
  result.jackknife_groups = parts.size();
  UnknownsMatrix weak = UnknownsMatrix::Zero();
  for (int i = 0; i < directions_.weak; ++i) {
    const double sigma = 1.0 / std::sqrt(std::max(directions_.values[i], 1e-12));
    const double variance = std::min(sigma, kHeldDirectionStd) * std::min(sigma, kHeldDirectionStd);
    weak += variance * directions_.vectors.col(i) * directions_.vectors.col(i).transpose();
  }
  NormalEquations all;
  for (const NormalEquations& part : parts) all.merge(part);
  const UnknownsMatrix formal = cofactor(all, directions_) + weak;
  const UnknownsMatrix scatter = jackknife(parts, directions_) + weak;
  const UnknownsMatrix correlated = adjustment.correlated(scatter_, directions_) + weak;
  result.covariance_formal = ofParameters(formal, result.motion);
  if (scatter.trace() > 0.0) result.covariance_jackknife = ofParameters(scatter, result.motion);
  if (correlated.trace() > 0.0)
    result.covariance_correlated = ofParameters(correlated, result.motion);
  Matrix6d raise = Matrix6d::Identity();
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    const double formal_variance = result.covariance_formal(p, p);
    const double excess = result.surface_std[p] * result.surface_std[p] +
                          result.convergence_std[p] * result.convergence_std[p];
    const double bent = result.deformation_std[p] * result.deformation_std[p];
    const double variance = std::max({formal_variance + bent, result.covariance_jackknife(p, p),
                                      result.covariance_correlated(p, p)}) +
                            excess;
    raise(p, p) = !result.parameters[p].determined ? 0.0 : std::sqrt(variance / formal_variance);
  }
  result.covariance = raise * result.covariance_formal * raise;
  const auto keep = (raise.diagonal().array() > 0.0).cast<double>().matrix().asDiagonal();
  result.covariance_formal = keep * result.covariance_formal * keep;
  result.covariance_jackknife = keep * result.covariance_jackknife * keep;
  result.covariance_correlated = keep * result.covariance_correlated * keep;
  if (frame_.with_scale)
    result.scale_std =
        std::sqrt(std::max({formal(6, 6), scatter(6, 6), correlated(6, 6)})) / frame_.radius;
}

/// How rotations vary over the overlap where the clouds are bent against each other.
void AlignmentReport::fillDeformation(PatchAlignmentResult& result) const {
  constexpr std::size_t kEnough = 20'000;
  const double cut = Robustness().cut;
  const std::size_t stride = 1 + pairs_.size() / kEnough;
  OverlapVariation variation;
  for (std::size_t i = 0; i < pairs_.size(); i += stride) {
    const PatchPair& pair = pairs_[i];
    if (pair.normal.z() < kGentleCosine ||
        std::abs(pair.distance) > cut * scatter_.of(pair) * std::sqrt(pair.variance))
      continue;
    variation.add(pair.group, pair.position.head<2>(), pair.distance / pair.normal.z());
  }
  result.deformation_std.segment<2>(3) = variation.ofRotations().cwiseSqrt();
}

void AlignmentReport::fillFit(PatchAlignmentResult& result) const {
  const double cut = Robustness().cut;
  RunningStatistics before, after, vertical_before, vertical_after;
  for (const PatchPair& pair : pairs_) {
    if (pair.source_point) ++result.source_points;
    if (std::abs(pair.distance) > cut * scatter_.of(pair) * std::sqrt(pair.variance)) continue;
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

void AlignmentReport::fill(std::size_t groups, PatchAlignmentResult& result) const {
  result.sigma0 = scatter_.all();
  result.radius = frame_.radius;
  fillParameters(result);
  fillDeformation(result);
  fillCovariance(groups, result);
  fillFit(result);
  const auto unknowns = static_cast<std::size_t>(directions_.unknowns - directions_.weak);
  result.redundancy = result.pairs - std::min(result.pairs, unknowns);
  if (result.status == PatchAlignmentResult::Status::not_converged)
    result.message = "no convergence in " + std::to_string(result.iterations) + " iterations";
}

std::string describeWeakness(const Directions& directions, int parameter, double radius) {
  int worst = 0;
  for (int i = 1; i < directions.weak; ++i)
    if (std::abs(directions.vectors(parameter, i)) > std::abs(directions.vectors(parameter, worst)))
      worst = i;
  const double information = std::max(directions.values[worst], 1e-12);
  const double effect = std::sqrt(information / std::max(directions.weights, 1e-12));
  char text[240];
  std::snprintf(text, sizeof text,
                "%s changes the patches' normal distances by %.2g mm (RMS) only, its standard "
                "deviation would be %.2g m; slopes that face the right way are missing",
                parameter < 3 ? "a shift of 1 m" : "a turn that moves points by 1 m", 1e3 * effect,
                std::min(1.0 / std::sqrt(information), 1e6));
  return parameter < 3 ? text : std::string(text) + " (radius " + std::to_string(radius) + " m)";
}

}  // namespace registration
}  // namespace pcl_als
