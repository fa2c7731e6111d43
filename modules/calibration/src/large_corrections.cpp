// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "large_corrections.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "block_diagnosis.h"
#include "correction_causes.h"
#include "correction_excursions.h"
#include "rejected_pairs.h"
#include "strip_covariance.h"

namespace pcl_als {
namespace {

/// The strip corrections of the passes by a solution.
std::vector<StripErrors> curvesOf(const std::vector<JumpSearch::Strip>& passes,
                                  const Adjustment& adjustment,
                                  const AdjustmentSolution& solution) {
  std::vector<StripErrors> curves;
  const auto covariance = adjustment.stripCovariance(solution);
  if (!covariance) return curves;
  for (const JumpSearch::Strip& pass : passes) {
    curves.push_back({pass.id, adjustment.errors().errorsOf(pass.index, solution.shared), {}});
    covariance->add(pass.index, {}, curves.back());
  }
  return curves;
}

/// The adjustment with a larger a priori variance of some curves.
class EnlargedAdjustment {
 public:
  EnlargedAdjustment(const BlockSolution& solution, std::vector<JumpSearch::Strip> passes)
      : solution_(solution),
        passes_(std::move(passes)),
        adjustment_(solution.adjustment),
        errors_(solution.adjustment.errors()),
        variances_(errors_.variances(solution.adjustment.levels())) {}

  /// Lets errors of a curve be as large as its excursion; returns the curves then, none where the
  /// adjustment cannot be solved.
  std::vector<StripErrors> enlarge(const CorrectionExcursion& excursion) {
    const auto& [curve, axis] = excursion.curve;
    errors_.setVarianceFactor(passes_[curve].index, static_cast<int>(axis),
                              std::max(1.0, excursion.value * excursion.value / variances_[axis]));
    adjustment_.setErrors(errors_);
    adjustment_.setVarianceFactors(solution_.adjustment.levels());
    const AdjustmentSolution solved =
        adjustment_.solve(solution_.choice.estimate, solution_.solution().biases);
    if (!solved.solved) return {};
    return curvesOf(passes_, adjustment_, solved);
  }

 private:
  const BlockSolution& solution_;
  std::vector<JumpSearch::Strip> passes_;
  Adjustment adjustment_;
  SharedErrors errors_;
  SharedErrors::Variances variances_;
};

/// The curves of the passes among those of all strips.
std::vector<StripErrors> ofPasses(const std::vector<JumpSearch::Strip>& passes,
                                  const std::vector<StripErrors>& strips) {
  std::vector<StripErrors> curves;
  for (const JumpSearch::Strip& pass : passes) {
    const auto same = [&](const StripErrors& strip) { return strip.id == pass.id; };
    curves.push_back(*std::find_if(strips.begin(), strips.end(), same));
  }
  return curves;
}

std::vector<CorrectionExcursion> excursionsOf(const BlockSolution& solution,
                                              const std::vector<JumpSearch::Strip>& passes,
                                              std::vector<StripErrors> curves) {
  const SharedErrorModel& model = solution.adjustment.errors().model();
  EnlargedAdjustment adjustment(solution, passes);
  std::set<CorrectionCurve> named;
  while (true) {
    std::vector<CorrectionExcursion> found =
        findExcursions(curves, OrdinaryErrors(curves, model, named));
    const auto is_named = [&](const CorrectionExcursion& e) { return named.count(e.curve) != 0; };
    const auto others = std::stable_partition(found.begin(), found.end(), is_named);
    const auto strongest = std::max_element(
        others, found.end(), [](const auto& a, const auto& b) { return a.evidence < b.evidence; });
    if (strongest == found.end() || named.size() == kMostLargeCorrections) {
      found.erase(others, found.end());
      return found;
    }
    named.insert(strongest->curve);
    curves = adjustment.enlarge(*strongest);
  }
}

std::vector<CorrectionExcursion> excursionsOfAll(const BlockSolution& solution,
                                                 const std::vector<JumpSearch::Strip>& passes) {
  return excursionsOf(solution, passes, curvesOf(passes, solution.adjustment, solution.solution()));
}

/// Metres by which one radian (or metre) of each axis moves a point at the edge of the swath.
double leverOf(std::size_t axis, const StripTrajectory& strip) {
  constexpr std::size_t kPitch = 3, kRoll = 4;
  if (axis < kPitch) return 1.0;
  if (axis == kPitch) return strip.height;
  return axis == kRoll ? strip.height / std::cos(strip.half_angle)
                       : strip.height * std::tan(strip.half_angle);
}

LargeCorrection correctionOf(const CorrectionExcursion& excursion, const StripTrajectory& strip,
                             const Trajectory& trajectory) {
  LargeCorrection correction;
  correction.strip = strip.id;
  correction.from = excursion.from;
  correction.to = excursion.to;
  correction.time = excursion.time;
  correction.axis = excursion.curve.second;
  correction.value = excursion.value;
  correction.std = excursion.std;
  correction.ordinary = excursion.ordinary;
  correction.on_ground = std::abs(excursion.value) * leverOf(correction.axis, strip);
  std::size_t cursor = 0;
  SensorPose pose;
  for (const auto& [time, place] :
       {std::pair(correction.from, &correction.begin), std::pair(correction.to, &correction.end)})
    if (trajectory.poseAt(time, pose, cursor)) *place = pose.position.head<2>();
  return correction;
}

}  // namespace

std::vector<LargeCorrection> largeCorrections(const SurveyBlock& block,
                                              const BlockEstimate& estimate,
                                              const std::vector<StripErrors>& errors,
                                              const std::vector<StripTrajectory>& strips,
                                              const LargeCorrectionHints& hints) {
  std::vector<LargeCorrection> found;
  if (!estimate.control.isConverged() || !estimate.solution.solution().solved) return found;
  const std::vector<JumpSearch::Strip> passes = correctedPasses(block);
  for (const CorrectionExcursion& excursion :
       hints.rejected_together
           ? excursionsOfAll(
                 solutionOfAll(estimate.solution, estimate.pairs, block.settings().threads), passes)
           : excursionsOf(estimate.solution, passes, ofPasses(passes, errors))) {
    const auto index = static_cast<std::size_t>(passes[excursion.curve.first].index);
    found.push_back(correctionOf(excursion, strips[index], block.trajectory()));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.on_ground > b.on_ground; });
  found.resize(std::min(found.size(), kMostLargeCorrections));
  addCauses(
      {block.trajectory(), strips, estimate.pairs.observations, block.systems.pass, hints.jump},
      found);
  return found;
}

}  // namespace pcl_als
