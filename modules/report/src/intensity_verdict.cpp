// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_verdict.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/number_text.h>

namespace pcl_als {
namespace {

std::string percent(double share, int digits = 1) {
  return numberText(100.0 * share, digits) + " %";
}

/// "−20.3 %"
std::string change(double before, double after) {
  const double relative = before > 0.0 ? after / before - 1.0 : 0.0;
  return (relative > 0.0 ? "+" : "") + percent(relative);
}

/// Differences in the overlaps after the correction.
const CellVariation& variationAfter(const OverlapResult& overlaps) {
  return overlaps.order.empty() ? overlaps.physics : overlaps.after;
}

IntensityCounts allCounts(const IntensityReport& report) {
  IntensityCounts all;
  for (const IntensityCounts& counts : report.result->outcome.counts) all.merge(counts);
  return all;
}

std::string termText(const EstimatedTerm& term, int digits) {
  std::string text = numberText(term.value, digits);
  if (term.status == TermStatus::estimated) return text + " ± " + numberText(term.std, digits);
  if (term.status == TermStatus::fixed) return text + " (given)";
  return text + " (not determined: " + term.reason + ")";
}

class VerdictOnIntensity {
 public:
  explicit VerdictOnIntensity(const IntensityReport& report)
      : report_(report),
        all_(report.result->outcome.statistics.all()),
        scale_(meanScale(all_)),
        before_(varianceToMean(all_.before)),
        after_(scale_ * varianceToMean(all_.after)) {}

  Verdict verdict(bool reliable) {
    bool worse = after_ > before_;
    if (overlapping()) {
      const double before = report_.result->overlaps->before.median,
                   after = variationAfter(*report_.result->overlaps).median;
      worse = after > before;
      verdict_.headline = "Where strips overlap their intensities differ by " + percent(after) +
                          " (" + percent(before) + " as received).";
    } else {
      verdict_.headline = ratioText() + ".";
    }
    if (!reliable)
      verdict_.headline = "Not all that was asked for could be estimated. " + verdict_.headline;
    sayRatio();
    sayModel();
    sayGains();
    sayTargets();
    sayCounts();
    const IntensityCounts counts = allCounts(report_);
    const bool remarks = !report_.result->warnings.empty() || counts.clipped > 0 || worse;
    verdict_.grade = !reliable ? VerdictGrade::bad
                     : remarks ? VerdictGrade::attention
                               : VerdictGrade::good;
    return verdict_;
  }

 private:
  bool overlapping() const {
    return report_.result->overlaps && report_.result->overlaps->cells > 0;
  }
  void say(const std::string& sentence) { verdict_.sentences.push_back(sentence); }

  std::string ratioText() const {
    return "The variance-to-mean ratio of all intensities goes from " + numberText(before_, 2) +
           " to " + numberText(after_, 2) + " (" + change(before_, after_) + ")";
  }

  void sayRatio() {
    if (overlapping()) {
      say(ratioText() + ", at the same mean.");
      say("Differences are standard deviation over mean in " +
          grouped(report_.result->overlaps->cells) +
          " smooth cells that several strips cover, median of the cells; the given model alone "
          "leaves " +
          percent(report_.result->overlaps->physics.median) + ".");
    }
    double best = 0.0;
    std::size_t best_bin = 0;
    for (std::size_t bin = 0; bin < IntensityStatistics::kSlopeBins; ++bin) {
      const BeforeAfter pair = report_.result->outcome.statistics.slope(bin);
      const double before = varianceToMean(pair.before);
      if (pair.before.count() < 1000 || before <= 0.0) continue;
      const double relative = scale_ * varianceToMean(pair.after) / before - 1.0;
      if (relative >= best) continue;
      best = relative;
      best_bin = bin;
    }
    if (best < 0.0)
      say("By slope it falls most at " + slopeName(best_bin) + " degrees: " + percent(best) + ".");
  }

  void sayModel() {
    const RadiometricModel& model = report_.result->run->model();
    std::string text =
        "Corrected to a range of " + numberText(model.reference_range, 0) + " m with ";
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
      const auto term = static_cast<RadiometricTerm>(t);
      std::string name = nameOf(term);
      std::replace(name.begin(), name.end(), '_', ' ');
      EstimatedTerm known;
      known.value = valueOf(term, model);
      if (report_.result->overlaps) known = report_.result->overlaps->terms[t];
      text += (t == 0 ? "" : ", ") + name + " " + termText(known, 3);
    }
    say(text + " per km.");
  }

  void sayGains() {
    if (!report_.result->overlaps) return;
    const std::vector<EstimatedTerm>& gains = report_.result->overlaps->gains;
    const auto off = [](const EstimatedTerm& gain) {
      return gain.status == TermStatus::estimated ? std::abs(gain.value - 1.0) : -1.0;
    };
    const auto most = std::max_element(
        gains.begin(), gains.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    if (most == gains.end() || off(*most) < 0.0) return;
    const auto strip = static_cast<std::size_t>(most - gains.begin());
    say("Of the strips' gains, that of strip " + report_.result->run->strips()[strip] +
        " is farthest from 1: " + numberText(most->value, 4) + " ± " +
        numberText(most->value * most->std, 4) + ".");
  }

  void sayTargets() {
    if (!report_.result->reference) return;
    if (report_.result->reference->constant <= 0.0) {
      say("No reflectance: no target has enough points.");
      return;
    }
    say("Reflectance is corrected intensity / " +
        significantText(report_.result->reference->constant, 5) + ", good to " +
        percent(report_.result->reference->relative_std) + ".");
  }

  void sayCounts() {
    const IntensityCounts counts = allCounts(report_);
    const auto of = [&](RadiometryStatus status) {
      return counts.status[static_cast<std::size_t>(status)];
    };
    const std::uint64_t full = of(RadiometryStatus::surface) + of(RadiometryStatus::limited);
    const std::uint64_t left = of(RadiometryStatus::uncovered) +
                               of(RadiometryStatus::above_sensor) +
                               of(RadiometryStatus::not_finite);
    say("Of " + grouped(counts.points) + " points " + grouped(full) +
        " are corrected for range, atmosphere and incidence, " +
        grouped(counts.points - full - left) + " for range and atmosphere only, " + grouped(left) +
        " are left as they are.");
    if (counts.saturated > 0)
      say(grouped(counts.saturated) + " points were saturated: their values are lower bounds.");
    if (counts.clipped > 0)
      say(grouped(counts.clipped) +
          " points are beyond 65535 after the correction; a smaller scale keeps them.");
  }

  const IntensityReport& report_;
  const BeforeAfter all_;
  const double scale_, before_, after_;
  Verdict verdict_;
};

}  // namespace

Verdict verdictOf(const IntensityReport& report) {
  return VerdictOnIntensity(report).verdict(report.result->unreliable.empty());
}

}  // namespace pcl_als
