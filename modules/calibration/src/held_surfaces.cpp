// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Strips and reference surfaces that SystemCalibrationEngine holds fixed.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>

#include "calibration_state.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

// metres: a priori standard deviation of a height that counts as unknown; larger than any error of
// a datum that checkReferences() lets pass
constexpr double kUnknownHeight = 10.0;
constexpr double kDetermined = 0.1;   // metres: largest standard deviation of a height that is
constexpr double kSignificant = 4.0;  // standard deviations of a height: once in 16,000
constexpr double kRelevant = 0.01;    // metres: smaller heights are not reported
constexpr double kAffected = 1.0;     // standard deviations, of a change of a parameter
constexpr const char* kFixedStrips = "fixed strips";

std::string metres(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

bool SystemCalibrationEngine::isReference(int strip) const {
  const int held = held_of_[static_cast<std::size_t>(strip)];
  return held >= 0 && held_[static_cast<std::size_t>(held)].is_reference;
}

std::vector<bool> SystemCalibrationEngine::correctedStrips() const {
  std::vector<bool> corrected = used_;
  for (std::size_t i = 0; i < corrected.size(); ++i)
    corrected[i] = used_[i] && !isHeld(static_cast<int>(i));
  return corrected;
}

int SystemCalibrationEngine::addReference(const ReferenceSurface& surface) {
  if (!(surface.std > 0.0) || !std::isfinite(surface.std) || !(surface.offset >= 0.0))
    throw UsageError("reference surface " + surface.name +
                     ": its standard deviation must be positive");
  if (std::find(ids_.begin(), ids_.end(), surface.name) != ids_.end())
    throw UsageError("reference surface " + surface.name +
                     ": a strip or another surface has this name");
  ids_.push_back(surface.name);
  used_.push_back(true);
  held_of_.push_back(static_cast<int>(held_.size()));
  held_.push_back({surface, true});
  plausibility_.addStrip(surface.name);
  if (attitude_ == AttitudeSource::none) recoveries_.emplace_back(trajectory_);
  return map_.addSurface();
}

void SystemCalibrationEngine::holdSurfaces() {
  const int fixed = static_cast<int>(held_.size());
  if (!(settings_.fixed_sigma >= 0.0))
    throw UsageError("the standard deviation of fixed strips must not be negative");
  if (!settings_.fixed.empty())
    held_.push_back({{kFixedStrips, settings_.noise.range, settings_.fixed_sigma}, false});
  for (const std::string& name : settings_.fixed) {
    bool found = false;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (isReference(static_cast<int>(i)) || (ids_[i] != name && passOfStrip(ids_[i]) != name))
        continue;
      held_of_[i] = fixed;
      found = true;
    }
    if (!found) throw UsageError("there is no strip " + name + " to be held fixed");
  }
  const int first = systems_.count;
  systems_.count += static_cast<int>(held_.size());
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (held_of_[i] < 0) continue;
    systems_.system[i] = first + held_of_[i];
    // A surface has no trajectory errors.
    if (isReference(static_cast<int>(i))) systems_.pass[i] = static_cast<int>(i);
  }
  for (const HeldStrips& held : held_) {
    if (held.is_reference)
      systems_.held.push_back({held.surface.offset, 0.0, held.surface.std, false});
    else
      systems_.held.push_back({held.surface.offset, held.surface.offset, 0.0, true});
  }
  if (!held_.empty() && std::all_of(held_of_.begin(), held_of_.end(), [](int i) { return i >= 0; }))
    throw UsageError("all strips are held fixed: there is nothing to calibrate");
}

std::string SystemCalibrationEngine::objectionTo(int reference) const {
  SurveyMap::HeightOffset best;
  int strip = -1;
  for (const SurveyMap::Overlap& overlap : map_.overlaps(settings_.minimum_overlap)) {
    const auto [a, b] = overlap.strips;
    const int other = a == reference ? b : a;
    if ((a != reference && b != reference) || isReference(other) || !used_[other]) continue;
    SurveyMap::HeightOffset found = map_.heightOffset({reference, other});
    if (strip >= 0 && found.cells <= best.cells) continue;
    best = found;
    strip = other;
  }
  if (strip < 0)
    return "overlaps no strip by " + metres("%.0f m²", settings_.minimum_overlap) +
           " or more: give a surface of this block, in its CRS";
  if (std::abs(best.offset) <= settings_.max_normal_distance) return {};
  return "lies " + metres("%.2f m ", std::abs(best.offset)) +
         (best.offset > 0.0 ? "above" : "below") + " strip " +
         ids_[static_cast<std::size_t>(strip)] + " (median of " + std::to_string(best.cells) +
         " cells of 10 m): its heights are in another unit, or refer to another vertical datum";
}

void SystemCalibrationEngine::checkReferences() const {
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (!isReference(static_cast<int>(i))) continue;
    const std::string objection = objectionTo(static_cast<int>(i));
    if (!objection.empty()) throw InputError("reference surface " + ids_[i] + ": " + objection);
  }
}

void SystemCalibrationEngine::addHeldFit(const std::vector<AreaObservations>& observations,
                                         const SystemVector& biases, bool after,
                                         CalibrationResult& result) const {
  std::vector<RunningStatistics> fits(held_.size());
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      if (!isHeld(o)) continue;
      const bool patch = isHeld(o.b);
      const int held = held_of_[static_cast<std::size_t>(patch ? o.b : o.a)];
      fits[static_cast<std::size_t>(held)].add(patch ? o.distance(biases) : -o.distance(biases));
    }
  }
  result.held.resize(held_.size());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    HeldSurface& fit = result.held[k];
    fit.name = held_[k].surface.name;
    fit.std = held_[k].surface.std;
    fit.offset_prior = held_[k].surface.offset;
    fit.strips.clear();
    for (std::size_t i = 0; i < ids_.size() && !held_[k].is_reference; ++i)
      if (held_of_[i] == static_cast<int>(k)) fit.strips.push_back(ids_[i]);
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

void judgeHeight(const HeldSurface& surface, const ParameterChoice& choice,
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
  result.verdict.object(CalibrationStatus::parameters_affected, what + "; it affects " + affected);
}

}  // namespace

void SystemCalibrationEngine::checkHeldHeights(State& state, SharedErrors& errors,
                                               CalibrationResult& result) const {
  if (!state.choice.solution.solved) return;
  const SharedErrorLevels levels = state.adjustment.levels();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (result.held[k].correspondences == 0) continue;
    errors.setHeldOffset(k, kUnknownHeight);
    state.adjustment.setLevels(levels);
    const AdjustmentSolution other =
        state.adjustment.solve(state.choice.estimate, state.choice.solution.biases);
    const Adjustment::SystemSolution found = state.adjustment.systemSolution(
        errors.systems().heldSystem(k), state.choice.estimate, other);
    errors.setHeldOffset(k, held_[k].surface.offset);
    HeldSurface& surface = result.held[k];
    constexpr int kUp = kSystemUnknownCount - 1;
    surface.offset = found.difference[kUp];
    surface.offset_std = found.difference_std[kUp];
    surface.offset_determined = other.solved && surface.offset_std < kDetermined;
    judgeHeight(surface, state.choice, other, result);
  }
  state.adjustment.setLevels(levels);
}

bool SystemCalibrationEngine::replaceHeld(std::vector<AreaObservations>& observations) const {
  bool any = false;
  for (AreaObservations& area : observations) {
    for (PairObservation& o : area) {
      if (!isHeld(o)) continue;
      any = true;
      if (isHeld(o.b)) {  // control is compared with the strip's patch
        o.b = o.a;
        o.look_b = o.look_a;
        o.time_b = o.time_a;
        o.row_b = o.row_a;
        o.turn_b = o.turn_a;
        o.mixed_times = false;
        o.design = -o.design;
        o.sources = -o.sources;
        o.misclosure = -o.misclosure;
        o.further = -o.further;
        o.offset = -o.offset;
      }
      o.a = PairObservation::kControl;
      o.row_a.setZero();
      o.time_a = o.time_b;
    }
  }
  return any;
}

}  // namespace pcl_als
