// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "quality_verdict.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {
namespace {

constexpr double kSignificant = 3.0;     // standard deviations
constexpr std::size_t kNamedPairs = 5;   // in a sentence; more are counted
constexpr double kSlackOfLimit = 1e-12;  // metres

double rmsOf(const CheckedPair& pair) {
  return pair.assessment.vertical.rms;
}

std::string nameOf(const CheckedPair& pair) {
  return pair.a + " and " + pair.b;
}

std::string withStd(double value, double std, double unit, int digits, const std::string& name) {
  return numberText(value / unit, digits) + " ± " + numberText(std / unit, digits) + " " + name;
}

std::vector<const CheckedPair*> judgedPairs(const CheckedBlock& block) {
  std::vector<const CheckedPair*> pairs;
  for (const CheckedPair& pair : block.pairs)
    if (judged(pair) && !pair.of_one_pass) pairs.push_back(&pair);
  return pairs;
}

const CheckedPair& worstOf(const std::vector<const CheckedPair*>& pairs) {
  return **std::max_element(
      pairs.begin(), pairs.end(),
      [](const CheckedPair* a, const CheckedPair* b) { return rmsOf(*a) < rmsOf(*b); });
}

/// "1.9 cm to 2.9 cm", or the one value there is.
std::string rangeText(const std::vector<const CheckedPair*>& pairs) {
  const auto [low, high] =
      std::minmax_element(pairs.begin(), pairs.end(),
                          [](const auto* a, const auto* b) { return rmsOf(*a) < rmsOf(*b); });
  if (pairs.size() == 1) return centimetres(rmsOf(**low));
  return centimetres(rmsOf(**low)) + " to " + centimetres(rmsOf(**high));
}

class VerdictOnStrips {
 public:
  explicit VerdictOnStrips(const QualityReport& report)
      : report_(report),
        limits_(qualityLevels()[static_cast<std::size_t>(report.quality_level)]),
        pairs_(judgedPairs(report.block)) {}

  Verdict verdict() {
    judgePairs();
    judgeControl();
    sayHeights();
    saySeparation();
    sayShift();
    sayRoll();
    sayControl();
    sayNotJudged();
    const bool answered = hasAnswer(report_.block);
    verdict_.headline = answered ? pair_headline_ + control_headline_
                                 : "No reliable answer: nothing could be measured.";
    verdict_.grade = failed_ || !answered                               ? VerdictGrade::bad
                     : unjudged_ > 0 || !report_.block.warnings.empty() ? VerdictGrade::attention
                                                                        : VerdictGrade::good;
    return verdict_;
  }

 private:
  std::string level() const { return "QL" + std::to_string(report_.quality_level); }

  void say(const std::string& sentence) { verdict_.sentences.push_back(sentence); }

  void judgePairs() {
    const PairCounts counts = countPairs(report_.block.pairs);
    unjudged_ = report_.block.pairs.size() - pairs_.size();
    failed_ = counts.too_far > 0;
    if (pairs_.empty()) return;
    const double limit = limits_.swath_overlap_rmsdz;
    const auto beyond = std::count_if(pairs_.begin(), pairs_.end(), [&](const CheckedPair* pair) {
      return rmsOf(*pair) > limit + kSlackOfLimit;
    });
    const CheckedPair& worst = worstOf(pairs_);
    const std::string figures =
        "an RMSDz of " + centimetres(rmsOf(worst)) + ", " + centimetres(limit) + " are allowed.";
    const std::string all = std::to_string(counts.all());
    if (beyond > 0) {
      failed_ = true;
      pair_headline_ = std::to_string(beyond) + " of " + all + " pairs of strips " +
                       (beyond == 1 ? "does" : "do") + " not keep " + level() + ": strips " +
                       nameOf(worst) + " differ by " + figures;
    } else if (counts.all() > counts.measured) {
      pair_headline_ = std::to_string(counts.measured) + " of " + all + " pairs of strips keep " +
                       level() + ", the others could not be compared: " + "the worst that was, " +
                       nameOf(worst) + ", has " + figures;
    } else {
      pair_headline_ = (pairs_.size() == 1
                            ? "The pair of strips keeps " + level() + ": strips "
                            : "All " + all + " pairs of strips keep " + level() + ": the worst, ") +
                       nameOf(worst) + (pairs_.size() == 1 ? " differ by " : ", have ") + figures;
    }
  }

  void judgeControl() {
    const auto& control = report_.block.control;
    if (!control) return;
    failed_ = failed_ || !control->no_class.empty();
    if (!control->accuracy) return;
    const bool kept = control->accuracy->fit <= limits_.absolute_rmsez + kSlackOfLimit;
    failed_ = failed_ || !kept;
    control_headline_ = std::string(pair_headline_.empty() ? "" : " ") + "Heights fit control " +
                        "with an RMSE of " + centimetres(control->all.rms) + ", " +
                        (kept ? "inside" : "outside") + " the " +
                        centimetres(limits_.absolute_rmsez) + " of " + level() + ".";
  }

  /// The best level that all pairs keep.
  std::string commonLevel(const CheckedBlock& block) const {
    int worst = -1;
    for (const CheckedPair* pair : judgedPairs(block)) {
      if (!pair->assessment.quality_level) return "no quality level is kept by all pairs";
      worst = std::max(worst, *pair->assessment.quality_level);
    }
    return "all pairs keep QL" + std::to_string(worst);
  }

  void sayHeights() {
    if (pairs_.empty()) return;
    std::string text =
        "Height differences between strips (RMSDz, level ground): " + rangeText(pairs_) + "; " +
        commonLevel(report_.block) + ".";
    if (report_.before) {
      const auto before = judgedPairs(*report_.before);
      if (!before.empty())
        text += " Before: " + rangeText(before) + "; " + commonLevel(*report_.before) + ".";
    }
    say(text);
  }

  void saySeparation() {
    if (!report_.block.separation) return;
    const SeparationSummary& s = *report_.block.separation;
    const double all = static_cast<double>(s.green + s.yellow + s.red);
    if (all == 0.0) return;
    const auto share = [all](std::uint64_t count) {
      return numberText(100.0 * static_cast<double>(count) / all, 1) + " %";
    };
    say("Of the ground that several strips cover, trees and walls included, " + share(s.green) +
        " is within " + centimetres(s.limit) + " and " + share(s.red) + " beyond " +
        centimetres(2.0 * s.limit) + ".");
  }

  void sayShift() {
    const CheckedPair* largest = nullptr;
    const auto size = [](const CheckedPair& pair) {
      return pair.assessment.horizontal.shift.head<2>().norm();
    };
    for (const CheckedPair* pair : pairs_) {
      if (!pair->assessment.horizontal.determined) continue;
      if (largest == nullptr || size(*pair) > size(*largest)) largest = pair;
    }
    if (largest == nullptr) {
      if (!pairs_.empty()) say("Slopes are too few to show shifts in plan.");
      return;
    }
    const HorizontalShift& h = largest->assessment.horizontal;
    say("Largest shift in plan that slopes show, strips " + nameOf(*largest) + ": east " +
        withStd(h.shift.x(), h.std.x(), 0.01, 1, "cm") + ", north " +
        withStd(h.shift.y(), h.std.y(), 0.01, 1, "cm") + ".");
  }

  void sayRoll() {
    const CheckedPair* worst = nullptr;
    std::size_t tilted = 0, known = 0;
    const auto significance = [](const CheckedPair& pair) {
      const OverlapTrends::Roll& roll = pair.assessment.trends.roll;
      return roll.determined && roll.std > 0.0 ? std::abs(roll.value) / roll.std : 0.0;
    };
    for (const CheckedPair* pair : pairs_) {
      if (!pair->assessment.trends.roll.determined) continue;
      ++known;
      if (significance(*pair) <= kSignificant) continue;
      ++tilted;
      const double size = std::abs(pair->assessment.trends.roll.value);
      if (worst == nullptr || size > std::abs(worst->assessment.trends.roll.value)) worst = pair;
    }
    if (known == 0) return;
    if (worst == nullptr) {
      say("No pair tilts across its overlap by more than three standard deviations.");
      return;
    }
    const OverlapTrends::Roll& roll = worst->assessment.trends.roll;
    say(std::to_string(tilted) + " of " + std::to_string(known) +
        (tilted == 1 ? " pairs tilts across its overlap" : " pairs tilt across their overlap") +
        " by more than three standard deviations; most strips " + nameOf(*worst) +
        ", as a roll error of " + withStd(roll.value, roll.std, kRadiansPerArcsec, 1, "arcsec") +
        " would.");
  }

  void sayControl() {
    const auto& control = report_.block.control;
    if (!control || !control->accuracy) return;
    const VerticalAccuracy& accuracy = *control->accuracy;
    const double mean = control->all.mean;
    std::string text = "Control: the strips lie " + centimetres(std::abs(mean)) +
                       (mean < 0.0 ? " below" : " above") + " it on average, RMSE " +
                       centimetres(control->all.rms) + " at " + grouped(control->points) +
                       " points";
    if (report_.before && report_.before->control && report_.before->control->points > 0)
      text += " (before: " + centimetres(report_.before->control->all.rms) + ")";
    if (control->no_class.empty())
      text += "; vertical accuracy class " + numberText(accuracy.class_cm, 0) + " cm (ASPRS 2023)";
    else
      text += "; no vertical accuracy class, because " + control->no_class;
    if (!accuracy.enough_points)
      text += ", from fewer than the " + std::to_string(kFewestCheckPoints) +
              " points that the standard asks for";
    say(text + ".");
  }

  void sayNotJudged() {
    std::string text;
    std::size_t named = 0;
    for (const CheckedPair& pair : report_.block.pairs) {
      if (judged(pair) || named++ >= kNamedPairs) continue;
      text += (text.empty() ? "" : "; ") + nameOf(pair) + " (" + pair.assessment.reason + ")";
    }
    if (text.empty()) return;
    if (named > kNamedPairs) text += "; and " + std::to_string(named - kNamedPairs) + " more";
    say("Not judged: strips " + text + ".");
  }

  const QualityReport& report_;
  const QualityLevelLimits& limits_;
  const std::vector<const CheckedPair*> pairs_;
  Verdict verdict_;
  std::string pair_headline_, control_headline_;
  std::size_t unjudged_ = 0;
  bool failed_ = false;
};

}  // namespace

Verdict verdictOf(const QualityReport& report) {
  return VerdictOnStrips(report).verdict();
}

}  // namespace pcl_als
