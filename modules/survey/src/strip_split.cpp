// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/survey/strip_split.h>

#include "track_motion.h"

namespace pcl_als {
namespace {

using Eigen::Vector2d;
using Bins = TrackMotion::Bins;
using Span = TrackMotion::Span;
using Reason = std::optional<ExclusionReason>;

constexpr double kAtRest = 0.05;           // m/s: no platform is slower; courses of less are noise
constexpr double kLeastWindow = 1.0;       // s: shorter stretches have no course
constexpr double kTurnRateInterval = 2.0;  // s before and after, of a rate of turn
constexpr double kLeastRate = 1.5 * kRadiansPerDegree;  // rad/s: half a standard-rate turn
constexpr double kTurn = 60.0 * kRadiansPerDegree;      // in all: corridors have bends
constexpr double kGapTurn = 30.0 * kRadiansPerDegree;   // across a gap, of a trajectory
constexpr double kStep = 0.25;  // s between courses whose changes are added up over a gap
// Speed of hovering over the typical one; in a moment by the centre of the swath, which moves with
// roll and pitch, too.
constexpr double kHover = 0.15, kSwathHover = 0.25;
constexpr double kSlow = 0.5;      // speed over the typical one around it: braking and starting
constexpr double kAround = 60.0;   // s of the speed to which braking and starting refer
constexpr double kShortWay = 0.5;  // way of a passage over that of the lines that it joins
constexpr double kOpposite = 135.0 * kRadiansPerDegree;  // between lines that a passage joins
constexpr double kEndOfLine = 4.0;  // s at an end of a line that show its course there
constexpr double kBehind = 0.5;     // cosine: more than 120 degrees from ahead
constexpr double kAcross = 45.0 * kRadiansPerDegree;  // between these and the passage
constexpr double kSharpest = 20.0;  // m/s^2, twice gravity: acceleration that no platform exceeds

/// Divides the bins of one track.
class Division {
 public:
  Division(const Bins& bins, const Trajectory* flight)
      : bins_(bins), motion_(bins, flight), reasons_(bins.size()), least_(bins.size(), 0.0) {
    for (const Span& session : motion_.sessions()) {
      const double least = std::max(kAtRest, hover() * motion_.typicalSpeed(session));
      for (std::size_t i = session.first; i < session.second; ++i) least_[i] = least;
    }
    for (const Span& run : motion_.runs()) markTurns(run);
    for (const Span& session : motion_.sessions()) markHovering(session);
  }
  std::vector<TimeStretch> stretches() const;

 private:
  struct Part {
    Span bins;
    Reason reason;
  };

  double hover() const { return motion_.isFlown() ? kHover : kSwathHover; }
  void mark(const Span& span, ExclusionReason reason);
  std::vector<double> ratesOfTurn(const Span& run) const;
  void markTurns(const Span& run);
  void markHovering(const Span& session);
  std::size_t startOfBraking(const Span& session, std::size_t rest) const;
  std::size_t endOfStarting(const Span& session, std::size_t rest) const;
  double turnedBetween(double from, double to, double least) const;
  bool cutsAt(std::size_t start, std::size_t at) const;
  std::vector<Part> parts() const;
  double duration(const Span& span) const {
    return bins_[span.second - 1].last - bins_[span.first].first;
  }
  bool isPassage(const Part& before, const Part& part, const Part& after) const;
  void excludeRemnants(std::vector<Part>& parts) const;

  const Bins& bins_;
  TrackMotion motion_;
  std::vector<Reason> reasons_;
  std::vector<double> least_;  // m/s by bin: slower is hovering
};

void Division::mark(const Span& span, ExclusionReason reason) {
  for (std::size_t i = span.first; i < span.second; ++i) reasons_[i] = reason;
}

/// Radians per second by bin; 0 where courses are not known.
std::vector<double> Division::ratesOfTurn(const Span& run) const {
  const auto [first, last] = run;
  std::vector<double> rates(last - first, 0.0);
  for (std::size_t i = first; i < last; ++i) {
    const double early = std::max(bins_[i].middle() - kTurnRateInterval, bins_[first].first);
    const double late = std::min(bins_[i].middle() + kTurnRateInterval, bins_[last - 1].last);
    if (!(late - early >= kLeastWindow)) continue;
    const auto before = motion_.velocity(early, run, least_[i]);
    const auto after = motion_.velocity(late, run, least_[i]);
    if (before && after) rates[i - first] = turned(*before, *after) / (late - early);
  }
  return rates;
}

void Division::markTurns(const Span& run) {
  const std::vector<double> rates = ratesOfTurn(run);
  for (std::size_t i = 0; i < rates.size();) {
    const double sign = rates[i];
    std::size_t end = i + 1;
    if (std::abs(sign) < kLeastRate) {
      i = end;
      continue;
    }
    while (end < rates.size() && rates[end] * sign > 0.0 && std::abs(rates[end]) >= kLeastRate)
      ++end;
    double change = 0.0;
    for (std::size_t k = i + 1; k < end; ++k) {
      const std::size_t bin = run.first + k;
      change += rates[k] * (bins_[bin].middle() - bins_[bin - 1].middle());
    }
    if (std::abs(change) > kTurn) mark({run.first + i, run.first + end}, ExclusionReason::in_turn);
    i = end;
  }
}

/// The speed to which braking refers is that before it: a file may have lines of other speeds.
std::size_t Division::startOfBraking(const Span& session, std::size_t rest) const {
  std::size_t from = rest;
  while (from > session.first && bins_[from - 1].middle() > bins_[rest].middle() - kAround) --from;
  const double slow = std::max(kSlow * motion_.typicalSpeed({from, rest}), least_[rest]);
  while (rest > session.first && motion_.speed(rest - 1) < slow) --rest;
  return rest;
}

std::size_t Division::endOfStarting(const Span& session, std::size_t rest) const {
  std::size_t to = rest;
  while (to < session.second && bins_[to].middle() < bins_[rest - 1].middle() + kAround) ++to;
  const double slow = std::max(kSlow * motion_.typicalSpeed({rest, to}), least_[rest - 1]);
  while (rest < session.second && motion_.speed(rest) < slow) ++rest;
  return rest;
}

void Division::markHovering(const Span& session) {
  // A sensor that never moves is a terrestrial station and has no flight lines.
  const double typical = motion_.typicalSpeed(session);
  if (typical <= kAtRest) return;
  for (std::size_t i = session.first; i < session.second;) {
    std::size_t end = i;
    while (end < session.second && motion_.speed(end) < least_[end]) ++end;
    if (end == i || duration({i, end}) < motion_.halfWindow() ||
        motion_.moved({i, end}).norm() > kHover * typical * duration({i, end})) {
      i = std::max(end, i + 1);
      continue;
    }
    const Span hovering{startOfBraking(session, i), endOfStarting(session, end)};
    mark(hovering, ExclusionReason::hovering);
    i = hovering.second;
  }
}

/// Change of course over a time span of the trajectory, all turns added up; 0 without one.
double Division::turnedBetween(double from, double to, double least) const {
  double sum = 0.0;
  if (!motion_.isFlown()) return sum;
  std::optional<Vector2d> last;
  for (double time = from; time <= to + 0.5 * kStep; time += kStep) {
    const auto now = motion_.flown(std::min(time, to), least);
    if (now && last) sum += turned(*last, *now);
    if (now) last = now;
    if (std::abs(sum) > kGapTurn) return std::abs(sum);
  }
  return std::abs(sum);
}

/// Whether the points after the gap before bin \a at belong to another line.
bool Division::cutsAt(std::size_t start, std::size_t at) const {
  const double gap = bins_[at].first - bins_[at - 1].last;
  if (gap <= TrackMotion::kGap) return false;
  if (gap > StripNaming::kLargestGap) return true;
  const double from = bins_[at - 1].last, to = bins_[at].first, least = least_[at];
  if (turnedBetween(from - kStep, to + kStep, least) > kGapTurn) return true;
  std::size_t end = at + 1;
  while (end < bins_.size() && bins_[end].first - bins_[end - 1].last <= TrackMotion::kGap) ++end;
  const auto before = motion_.velocity(from, {start, at}, least);
  const auto after = motion_.velocity(to, {at, end}, least);
  if (!before || !after) return false;
  if (std::abs(turned(*before, *after)) > (motion_.isFlown() ? kGapTurn : kTurn)) return true;
  const Vector2d moved = bins_[at].mean() - bins_[at - 1].mean();
  return bins_[at].placed > 0 && bins_[at - 1].placed > 0 && moved.norm() > before->norm() * gap &&
         std::abs(turned(*before, moved)) > kTurn;
}

std::vector<Division::Part> Division::parts() const {
  std::vector<Part> parts;
  std::size_t start = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (i == 0 || reasons_[i] != reasons_[i - 1] || cutsAt(start, i)) {
      parts.push_back({{i, i}, reasons_[i]});
      start = i;
    }
    parts.back().bins.second = i + 1;
  }
  return parts;
}

/// A turn in several steps: a short way across from a line to the next one, back beside it.
bool Division::isPassage(const Part& before, const Part& part, const Part& after) const {
  const Vector2d last = motion_.moved(before.bins), across = motion_.moved(part.bins),
                 next = motion_.moved(after.bins);
  return across.norm() < kShortWay * std::min(last.norm(), next.norm()) &&
         std::abs(turned(last, next)) > kOpposite && std::abs(turned(last, across)) > kAcross &&
         std::abs(turned(next, -across)) > kAcross;
}

/// Lines between turns or hovering that are none: passages, and those too short to have a course.
void Division::excludeRemnants(std::vector<Part>& parts) const {
  std::vector<std::size_t> lines, remnants;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!parts[i].reason) lines.push_back(i);
  // Whether line k and the one before are parted by points that are excluded, and by no long gap.
  const auto joined = [&](std::size_t k) {
    bool near = lines[k] > lines[k - 1] + 1;
    for (std::size_t i = lines[k - 1] + 1; i <= lines[k]; ++i)
      near = near && bins_[parts[i].bins.first].first - bins_[parts[i].bins.first - 1].last <=
                         StripNaming::kLargestGap;
    return near;
  };
  for (std::size_t k = 1; k + 1 < lines.size(); ++k) {
    if (!joined(k) || !joined(k + 1)) continue;
    const Part& part = parts[lines[k]];
    if (duration(part.bins) < 2.0 * std::max(kTurnRateInterval, motion_.halfWindow()) ||
        isPassage(parts[lines[k - 1]], part, parts[lines[k + 1]]))
      remnants.push_back(lines[k]);
  }
  for (const std::size_t i : remnants) parts[i].reason = ExclusionReason::in_turn;
}

std::vector<TimeStretch> Division::stretches() const {
  std::vector<Part> all = parts();
  excludeRemnants(all);
  std::vector<TimeStretch> found;
  for (const Part& part : all) {
    TimeStretch stretch{bins_[part.bins.first].first, bins_[part.bins.first].last, part.reason};
    for (std::size_t i = part.bins.first; i < part.bins.second; ++i)
      stretch.to = std::max(stretch.to, bins_[i].last);
    found.push_back(stretch);
  }
  return found;
}

/// Where and when a line begins and ends, its courses there and its mean speed.
struct LineEnds {
  Vector2d start, end, first_course, last_course;
  double from, to;  ///< seconds
  double speed;     ///< m/s
};

Vector2d meanOf(const Bins& bins, std::size_t from, std::size_t to) {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = from; i < to; ++i) sum += bins[i].mean();
  return sum / static_cast<double>(to - from);
}

/// Empty for lines that are too short for a course.
std::optional<LineEnds> endsOf(const Bins& all, const TimeStretch& line) {
  Bins bins;
  for (const SwathTrack::Bin& bin : all)
    if (bin.placed > 0 && bin.first >= line.from && bin.last <= line.to) bins.push_back(bin);
  const std::size_t count = bins.size();
  if (count < 4) return std::nullopt;
  std::size_t head = 1, tail = count - 1;
  while (head + 1 < count && bins[head].last < bins.front().first + kEndOfLine) ++head;
  while (tail > 1 && bins[tail].first > bins.back().last - kEndOfLine) --tail;
  const std::size_t a = std::max<std::size_t>(1, head / 2);
  const std::size_t b = std::min(count - 1, tail + (count - tail) / 2);
  return LineEnds{bins.front().mean(),
                  bins.back().mean(),
                  meanOf(bins, a, head + 1) - meanOf(bins, 0, a),
                  meanOf(bins, b, count) - meanOf(bins, tail - 1, b),
                  bins.front().first,
                  bins.back().last,
                  (bins.back().mean() - bins.front().mean()).norm() /
                      (bins.back().middle() - bins.front().middle())};
}

/// In less time than a half turn takes, no platform comes back: a conical scanner or one of several
/// planes measures a small area ahead of the sensor and, after a gap, again behind it.
bool leadsBack(const LineEnds& before, const LineEnds& after) {
  const double half_turn = kPi * std::max(before.speed, after.speed) / kSharpest;
  if (after.from - before.to < half_turn) return false;
  const Vector2d gap = after.start - before.end;
  return std::abs(turned(before.last_course, after.first_course)) > kOpposite ||
         gap.dot(before.last_course) < -kBehind * gap.norm() * before.last_course.norm();
}

}  // namespace

bool leadBack(const SwathTrack& track, const std::vector<TimeStretch>& stretches) {
  Bins bins;
  std::uint64_t in_lines = 0;
  for (const auto& entry : track.bins()) {
    bins.push_back(entry.second);
    const double time = entry.second.middle();
    if (std::any_of(stretches.begin(), stretches.end(), [&](const TimeStretch& one) {
          return one.isLine() && time >= one.from && time <= one.to;
        }))
      in_lines += entry.second.points;
  }
  if (2 * in_lines < track.pointCount()) return false;
  std::optional<LineEnds> before;
  for (const TimeStretch& stretch : stretches) {
    if (!stretch.isLine()) continue;
    const std::optional<LineEnds> line = endsOf(bins, stretch);
    if (!line) continue;
    if (before && leadsBack(*before, *line)) return true;
    before = line;
  }
  return false;
}

std::vector<TimeStretch> splitTrack(const SwathTrack& track, const Trajectory* flight) {
  Bins bins;
  bins.reserve(track.bins().size());
  for (const auto& entry : track.bins()) bins.push_back(entry.second);
  return Division(bins, flight).stretches();
}

}  // namespace pcl_als
