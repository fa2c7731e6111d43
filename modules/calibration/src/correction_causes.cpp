// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "correction_causes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

constexpr double kWholeStrip = 0.8;                // of its duration
constexpr double kNearEnd = 2.0;                   // seconds: twice the distance of knots
constexpr double kNearTurn = 3.0;                  // seconds
constexpr double kFast = 3.0 * kRadiansPerDegree;  // per second: the rate of a standard turn
constexpr double kFasterThanRest = 2.0;
constexpr double kCoarse = 3.0;        // median distances between samples
constexpr double kNoticed = 0.1;       // seconds between samples
constexpr double kSecond = 1.0;        // on either side of an interval
constexpr double kRateStep = 0.25;     // seconds over which rates are measured
constexpr std::size_t kPositions = 3;  // axes that are positions

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

struct Examined {
  const CauseEvidence& evidence;
  const std::vector<LargeCorrection>& all;
  const LargeCorrection& correction;
  std::size_t index;  ///< of the strip

  const TimeSpan& span() const { return evidence.strips[index].span; }
  bool isWholeStrip() const {
    return correction.to - correction.from >= kWholeStrip * (span().second - span().first);
  }
  bool isNear(double from, double to, double reach) const {
    return from <= correction.to + reach && to >= correction.from - reach;
  }
};

/// The distances between samples of the trajectory that a time span touches, with their starts.
std::vector<std::pair<double, double>> samplePieces(const Trajectory& trajectory, double from,
                                                    double to) {
  std::vector<std::pair<double, double>> pieces;
  std::size_t cursor = 0;
  PathSpan piece;
  for (double time = from; time <= to && trajectory.pathAt(time, piece, cursor);) {
    if (!(piece.to > time)) break;
    pieces.emplace_back(piece.to - piece.from, piece.from);
    time = piece.to;
  }
  for (const Trajectory::Gap& gap : trajectory.gaps())
    if (gap.from <= to && gap.to >= from) pieces.emplace_back(gap.to - gap.from, gap.from);
  return pieces;
}

std::string gapText(const Examined& e) {
  const auto all = samplePieces(e.evidence.trajectory, e.span().first, e.span().second);
  const auto near =
      samplePieces(e.evidence.trajectory, e.correction.from - kSecond, e.correction.to + kSecond);
  if (all.empty() || near.empty()) return {};
  std::vector<double> lengths;
  for (const auto& piece : all) lengths.push_back(piece.first);
  const double usual = medianInPlace(lengths);
  const auto longest = *std::max_element(near.begin(), near.end());
  if (!(longest.first > std::max(kCoarse * usual, kNoticed))) return {};
  return formatted("the trajectory has no sample for %.2f s from %.1f s (elsewhere every %.3g s)",
                   longest.first, longest.second, usual);
}

std::string jumpText(const Examined& e) {
  const auto& jump = e.evidence.jump;
  if (!jump || jump->strip != e.correction.strip || jump->axis != e.correction.axis ||
      !e.isNear(jump->from, jump->to, kNearEnd))
    return {};
  return formatted(
      "the position jumps by %+.2f m between %.1f and %.1f s, as after a wrong GNSS ambiguity or a "
      "change of the satellites",
      jump->value, jump->from, jump->to);
}

std::string wholeStripText(const Examined& e) {
  if (!e.isWholeStrip()) return {};
  return e.correction.axis < kPositions
             ? "it lasts for the whole strip, as an error of the GNSS ambiguities, the base "
               "station "
               "or the datum does"
             : "it lasts for the whole strip, as an error of the alignment of the inertial system "
               "does";
}

std::string severalStripsText(const Examined& e) {
  std::vector<std::string> names;
  for (const LargeCorrection& other : e.all)
    if (other.strip != e.correction.strip && other.axis == e.correction.axis &&
        other.value * e.correction.value > 0.0 &&
        std::find(names.begin(), names.end(), other.strip) == names.end())
      names.push_back(other.strip);
  if (names.empty()) return {};
  return "the same axis is wrong in the same direction in strip " + listedNames(names) +
         ", as with one cause for the flight";
}

/// The largest rates of the course and of the body (0 without attitude) in a time span, rad/s.
struct Rates {
  double course = 0.0, body = 0.0;
};

Rates largestRates(const Trajectory& trajectory, double from, double to) {
  Rates rates;
  std::size_t cursor = 0;
  SensorPose before, pose;
  Eigen::Vector2d way = Eigen::Vector2d::Zero();
  bool known = false;
  for (double time = from; time <= to; time += kRateStep) {
    if (!trajectory.poseAt(time, pose, cursor)) {
      known = false;
      way.setZero();
      continue;
    }
    if (known) {
      const Eigen::Vector2d step = (pose.position - before.position).head<2>();
      if (way.squaredNorm() > 0.0 && step.squaredNorm() > 0.0)
        rates.course =
            std::max(rates.course,
                     std::abs(std::atan2(way.x() * step.y() - way.y() * step.x(), way.dot(step))) /
                         kRateStep);
      way = step;
      if (pose.has_attitude)
        rates.body = std::max(
            rates.body,
            Eigen::AngleAxisd(before.rotation.transpose() * pose.rotation).angle() / kRateStep);
    }
    before = pose;
    known = true;
  }
  return rates;
}

std::string turnText(const Examined& e) {
  const Trajectory& trajectory = e.evidence.trajectory;
  const double from = e.correction.from - kNearTurn, to = e.correction.to + kNearTurn;
  const Rates here = largestRates(trajectory, from, to);
  const double degree = kRadiansPerDegree;
  if (here.course > kFast)
    return formatted("the aircraft turns by up to %.1f degrees per second within %.0f s of it",
                     here.course / degree, kNearTurn);
  const double rest = std::max(largestRates(trajectory, e.span().first, from).body,
                               largestRates(trajectory, to, e.span().second).body);
  if (!(here.body > kFast) || !(here.body > kFasterThanRest * rest)) return {};
  return formatted(
      "the body rotates by up to %.1f degrees per second within %.0f s of it (elsewhere in the "
      "strip %.1f)",
      here.body / degree, kNearTurn, rest / degree);
}

std::string startText(const Examined& e) {
  if (e.isWholeStrip() || e.correction.from > e.span().first + kNearEnd) return {};
  return formatted(
      "it is at the start of the strip, %.0f s long: the trajectory is least reliable after a turn "
      "and where processing begins",
      e.correction.to - e.correction.from);
}

std::string endText(const Examined& e) {
  if (e.isWholeStrip() || e.correction.to < e.span().second - kNearEnd) return {};
  return formatted(
      "it is at the end of the strip, %.0f s long: the trajectory is least reliable before a turn "
      "and where processing ends",
      e.correction.to - e.correction.from);
}

/// The passes that were compared with that of the correction in its interval.
std::set<int> comparedPasses(const Examined& e) {
  const auto pass_of = [&](int strip) {
    const auto& pass = e.evidence.pass;
    return strip < 0 || pass.empty() ? strip : pass[static_cast<std::size_t>(strip)];
  };
  const int own = pass_of(static_cast<int>(e.index));
  const auto is_inside = [&](double time) {
    return time >= e.correction.from && time <= e.correction.to;
  };
  std::set<int> passes;
  for (const AreaObservations& area : e.evidence.observations) {
    for (const PairObservation& o : area) {
      const int a = pass_of(o.a), b = pass_of(o.b);
      if (b == own && is_inside(o.time_b)) passes.insert(a);
      if (a == own && is_inside(o.time_a)) passes.insert(b);
    }
  }
  passes.erase(own);
  return passes;
}

std::string singlePairText(const Examined& e) {
  const std::set<int> passes = comparedPasses(e);
  if (passes.size() != 1 || *passes.begin() == PairObservation::kControl) return {};
  return "only strip " + e.evidence.strips[static_cast<std::size_t>(*passes.begin())].id +
         " was compared with it there: the error may as well be of that strip, with the opposite "
         "sign";
}

/// A possible cause: a row for each.
struct CauseRow {
  const char* name;
  std::string (*evidence)(const Examined&);  ///< empty: none
};
constexpr std::array<CauseRow, 8> kCauses{{
    {"trajectory_gap", gapText},
    {"jump", jumpText},
    {"whole_strip", wholeStripText},
    {"several_strips", severalStripsText},
    {"turn", turnText},
    {"strip_start", startText},
    {"strip_end", endText},
    {"single_pair", singlePairText},
}};

}  // namespace

void addCauses(const CauseEvidence& evidence, std::vector<LargeCorrection>& corrections) {
  for (LargeCorrection& correction : corrections) {
    const auto strip =
        std::find_if(evidence.strips.begin(), evidence.strips.end(),
                     [&](const StripTrajectory& s) { return s.id == correction.strip; });
    if (strip == evidence.strips.end()) continue;
    const Examined examined{evidence, corrections, correction,
                            static_cast<std::size_t>(strip - evidence.strips.begin())};
    std::vector<CorrectionCause> causes;
    for (const CauseRow& row : kCauses)
      if (std::string text = row.evidence(examined); !text.empty())
        causes.push_back({row.name, std::move(text)});
    correction.causes = std::move(causes);
  }
}

}  // namespace pcl_als
