// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Strips and reference surfaces that are held fixed: their fit, and their heights.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/statistics.h>

#include "block_diagnosis.h"

namespace pcl_als {
namespace {

// metres: a priori standard deviation of a height that counts as unknown; larger than any error of
// a datum that checkReferences() lets pass
constexpr double kUnknownHeight = 10.0;
constexpr double kDetermined = 0.1;   // metres: largest standard deviation of a height that is
constexpr double kSignificant = 4.0;  // standard deviations of a height: once in 16,000
constexpr double kRelevant = 0.01;    // metres: smaller heights are not reported
constexpr double kAffected = 1.0;     // standard deviations, of a change of a parameter

std::string metres(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

void addHeldFit(const SurveyBlock& block, const PairSet& pairs, const SystemVector& biases,
                bool after, CalibrationResult& result) {
  const BlockStrips& strips = block.strips;
  std::vector<RunningStatistics> fits(strips.held.size());
  for (const AreaObservations& area : pairs.observations) {
    for (const PairObservation& o : area) {
      if (!strips.isFixed(o)) continue;
      const bool patch = strips.isFixed(o.b);
      const int held = strips.fixed_surface_of[static_cast<std::size_t>(patch ? o.b : o.a)];
      fits[static_cast<std::size_t>(held)].add(patch ? o.distance(biases) : -o.distance(biases));
    }
  }
  result.held.resize(strips.held.size());
  for (std::size_t k = 0; k < strips.held.size(); ++k) {
    FixedSurface& fit = result.held[k];
    fit.name = strips.held[k].surface.name;
    fit.std = strips.held[k].surface.std;
    fit.offset_prior = strips.held[k].surface.offset;
    fit.strips.clear();
    for (std::size_t i = 0; i < strips.size() && !strips.held[k].is_reference; ++i)
      if (strips.fixed_surface_of[i] == static_cast<int>(k)) fit.strips.push_back(strips.ids[i]);
    fit.correspondences = fits[k].count();
    (after ? fit.mean_after : fit.mean_before) = fits[k].mean();
    (after ? fit.rms_after : fit.rms_before) = fits[k].rms();
    if (after && fits[k].count() == 0)
      result.warnings.push_back(fit.name +
                                ": no smooth surface in common with other strips was "
                                "found; it has no effect on the calibration");
  }
}

namespace {

/// The parameters that depend on the height of a held surface; their standard deviations include
/// the change.
std::string affectedBy(const std::string& surface, const ParameterChoice& choice,
                       const AdjustmentSolution& other, CalibrationResult& result) {
  std::string names;
  for (const SystemParameter p : choice.estimate) {
    const double change = other.biases[indexOf(p)] - choice.solution.biases[indexOf(p)];
    ParameterEstimate& estimate = result[p];
    if (!(std::abs(change) > kAffected * estimate.std)) continue;
    estimate.std = std::hypot(estimate.std, change);
    estimate.reason = "depends on the height of " + surface +
                      ", which the rest of the block "
                      "contradicts";
    names += (names.empty() ? "" : ", ") + std::string(infoOf(p).name);
  }
  return names;
}

void judgeHeight(const FixedSurface& surface, const ParameterChoice& choice,
                 const AdjustmentSolution& other, CalibrationResult& result) {
  const double size = std::abs(surface.offset);
  if (!surface.offset_determined || size < std::max(kSignificant * surface.offset_std, kRelevant))
    return;
  const std::string what = surface.name + " " + (surface.strips.empty() ? "lies" : "lie") +
                           metres(" %.3f", size) + metres(" +- %.3f m ", surface.offset_std) +
                           (surface.offset > 0.0 ? "above" : "below") +
                           " the heights that the rest of the block shows (control, trajectory, "
                           "other surfaces): check its vertical datum";
  const std::string affected = affectedBy(surface.name, choice, other, result);
  result.warnings.push_back(
      what + (affected.empty() ? "; no parameter depends on it"
                               : "; the standard deviations of " + affected + " allow for it"));
  if (affected.empty()) return;
  result.verdict.downgrade(CalibrationStatus::parameters_affected,
                           what + "; it affects " + affected);
}

}  // namespace

void checkHeldHeights(const SurveyBlock& block, const BlockSolution& solution,
                      CalibrationResult& result) {
  if (!solution.solution().solved) return;
  const std::vector<SystemParameter>& estimate = solution.choice.estimate;
  for (std::size_t k = 0; k < block.strips.held.size(); ++k) {
    if (result.held[k].correspondences == 0) continue;
    SharedErrors errors = solution.adjustment.errors();
    errors.setHeldOffset(k, kUnknownHeight);
    Adjustment adjustment = solution.adjustment;
    adjustment.setErrors(errors);
    adjustment.setVarianceFactors(solution.adjustment.levels());
    const AdjustmentSolution other = adjustment.solve(estimate, solution.solution().biases);
    const Adjustment::SystemSolution found =
        adjustment.systemSolution(errors.systems().heldSystem(k), estimate, other);
    FixedSurface& surface = result.held[k];
    constexpr int kUp = kSystemUnknownCount - 1;
    surface.offset = found.difference[kUp];
    surface.offset_std = found.difference_std[kUp];
    surface.offset_determined = other.solved && surface.offset_std < kDetermined;
    judgeHeight(surface, solution.choice, other, result);
  }
}

namespace {

/// The distance of a strip from a held surface as one from control, which is compared with the
/// strip's patch.
void becomeControl(bool held_patch, PairObservation& o) {
  if (held_patch) {
    o.b = o.a;
    o.half_b = o.half_a;
    o.time_b = o.time_a;
    o.row_b = o.row_a;
    if (o.special) {
      PairObservation::Special special;
      special.boresight_a = special.boresight_b = o.special->boresight_a;
      o.special = std::make_shared<const PairObservation::Special>(special);
    }
    o.sources = -o.sources;
    o.misclosure = -o.misclosure;
    o.other_effects = -o.other_effects;
    o.offset = -o.offset;
  }
  o.a = PairObservation::kControl;
  o.row_a.setZero();
  o.time_a = o.time_b;
}

}  // namespace

void replaceHeld(const BlockStrips& strips, std::vector<AreaObservations>& observations) {
  for (AreaObservations& area : observations)
    for (PairObservation& o : area)
      if (strips.isFixed(o)) becomeControl(strips.isFixed(o.b), o);
}

}  // namespace pcl_als
