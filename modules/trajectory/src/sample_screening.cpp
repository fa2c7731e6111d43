// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "sample_screening.h"

#include <algorithm>
#include <limits>

#include "sample_repair.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kLongestRun = 10;    // samples
constexpr std::size_t kBeside = 4;         // samples on each side of a run
constexpr std::size_t kFewestAnchors = 5;  // a parabola with redundancy
constexpr std::size_t kScaleSamples = 20000;
constexpr int kRounds = 3;  // an outlier may hide another one beside it
constexpr double kLocalFactor = 6.0, kFlightFactor = 6.0;  // times residuals
constexpr double kEndFactor = 2.5;                         // times the way flown in a step, at ends
constexpr double kBreakShare = 0.4;     // of the limit: bend at the edges of a run
constexpr double kLeastDistance = 0.2;  // metres
constexpr double kLeastTurn = 2.0 * kRadiansPerDegree;
constexpr double kRoundings = 3.0, kLeastRounding = 1e-6;  // steps of rounding; metres or radians
constexpr double kAcceleration = 10.0;                     // m/s^2
constexpr double kFastest = 340.0;                         // m/s
constexpr double kFast = 25.0;  // m/s: an aircraft, which cannot turn on the spot
constexpr double kFastTurn = 45.0 * kRadiansPerDegree, kFastTurnAcceleration = 10.0;  // rad/s(^2)
constexpr double kSlowTurn = 360.0 * kRadiansPerDegree, kSlowTurnAcceleration = 40.0;

/// The value at a share of the sorted order; zero without values.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// An outlier disturbs the residuals of eight others, which in a short flight are many.
double undisturbedShare(std::size_t count) {
  return std::max(0.4, 0.8 - 10.0 / static_cast<double>(std::max<std::size_t>(count, 1)));
}

double speedBetween(const TrajectorySample& a, const TrajectorySample& b) {
  return (b.position - a.position).norm() / std::max(std::abs(b.time - a.time), 1e-9);
}

}  // namespace

SampleScreening::SampleScreening(const std::vector<TrajectorySample>& samples)
    : samples_(samples), breaks_(samples.size(), 0), excluded_(samples.size(), 0) {
  screening_.samples = samples.size();
}

TrajectoryScreening SampleScreening::result() {
  if (samples_.size() <= kFewestAnchors) return screening_;
  sort();
  divide();
  findScale();
  findRounding();
  findBreaks();
  for (const Piece& piece : pieces_) searchPiece(piece);
  for (const Piece& piece : pieces_) findLongRuns(piece);
  findJumps();
  std::sort(screening_.outliers.begin(), screening_.outliers.end(),
            [](const OutlierRun& a, const OutlierRun& b) { return a.from < b.from; });
  return screening_;
}

void SampleScreening::sort() {
  const auto earlier = [](const TrajectorySample& a, const TrajectorySample& b) {
    return a.time < b.time;
  };
  if (std::is_sorted(samples_.begin(), samples_.end(), earlier)) return;
  order_.resize(samples_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
  std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return earlier(samples_[a], samples_[b]);
  });
}

void SampleScreening::divide() {
  std::vector<double> steps;
  for (std::size_t rank = 1; rank < samples_.size(); ++rank) {
    const double step = at(rank).time - at(rank - 1).time;
    if (step > 0.0) steps.push_back(step);
  }
  gap_threshold_ = gapThreshold(std::move(steps));
  std::size_t first = 0;
  for (std::size_t last = 1; last <= samples_.size(); ++last) {
    if (last < samples_.size() && at(last).time - at(last - 1).time <= gap_threshold_) continue;
    pieces_.push_back({first, last});
    first = last;
  }
}

void SampleScreening::findScale() {
  std::vector<double> speeds, rates;
  std::array<std::vector<double>, kSampleChannels> residuals;
  const std::size_t every = samples_.size() / kScaleSamples + 1;
  for (const Piece& piece : pieces_) {
    for (std::size_t rank = piece.first + 1; rank + 1 < piece.last; rank += every) {
      const double step = at(rank + 1).time - at(rank).time;
      if (step > 0.0) {
        const ChannelValues moved = channelsOf(valuesRelativeTo(at(rank + 1), at(rank)));
        speeds.push_back(std::hypot(moved[kChannelPlan], moved[kChannelHeight]) / step);
        const double turned =
            std::max({moved[kChannelRoll], moved[kChannelPitch], moved[kChannelHeading]});
        if (std::isfinite(turned)) rates.push_back(turned / step);
      }
      std::size_t before = 0, behind = 0;
      const auto beside = anchors({rank, rank, piece}, before, behind);
      if (beside.size() < kFewestAnchors || before == 0 || behind == 0) continue;
      const ChannelValues deviation = SampleWindow(beside).deviation(at(rank));
      for (std::size_t c = 0; c < kSampleChannels; ++c)
        if (std::isfinite(deviation[c])) residuals[c].push_back(deviation[c]);
    }
  }
  scale_.speed = quantile(speeds, std::max(0.5, 0.95 - 3.0 / static_cast<double>(speeds.size())));
  // No aircraft is as fast: many samples are wrong, and the speed of the others is the flight's.
  if (scale_.speed > kFastest) scale_.speed = std::min(quantile(speeds, 0.5), kFastest);
  scale_.turn_rate = quantile(rates, std::max(0.5, 0.95 - 3.0 / static_cast<double>(rates.size())));
  for (std::size_t c = 0; c < kSampleChannels; ++c)
    scale_.residual[c] = quantile(residuals[c], undisturbedShare(residuals[c].size()));
}

/// The step of rounded values is the least change of their difference between samples.
void SampleScreening::findRounding() {
  std::array<std::vector<double>, 6> changes;
  const std::size_t every = samples_.size() / kScaleSamples + 1;
  for (std::size_t rank = 1; rank + 1 < samples_.size(); rank += every) {
    const SampleValues change =
        valuesRelativeTo(at(rank + 1), at(rank)) - valuesRelativeTo(at(rank), at(rank - 1));
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const double size = std::abs(change[static_cast<Eigen::Index>(i)]);
      if (size > kLeastRounding) changes[i].push_back(size);
    }
  }
  // Where few values change at all, outliers do.
  const std::size_t fewest = std::max<std::size_t>(20, samples_.size() / every / 20);
  const auto step = [&](std::size_t i) {
    return changes[i].size() < fewest ? 0.0
                                      : *std::min_element(changes[i].begin(), changes[i].end());
  };
  scale_.rounding = {std::max(step(0), step(1)), step(2), step(3), step(4), step(5)};
}

ChannelValues SampleScreening::bend(std::size_t rank, const Piece& piece) const {
  if (rank <= piece.first || rank + 1 >= piece.last) return {};
  const TrajectorySample &a = at(rank - 1), &b = at(rank + 1), &sample = at(rank);
  const double step = b.time - a.time;
  const double share = step > 0.0 ? (sample.time - a.time) / step : 0.5;
  const SampleValues whole = valuesRelativeTo(b, a), part = valuesRelativeTo(sample, a);
  return channelsOf(part - share * whole);
}

ChannelValues SampleScreening::floors(double step, double speed) const {
  const bool fast = speed >= kFast;
  const double quarter = 0.25 * step * step;  // from rest to rest
  const double distance = kLeastDistance + kAcceleration * quarter;
  const double turn =
      kLeastTurn + (fast ? std::min(kFastTurnAcceleration * quarter, kFastTurn * step)
                         : std::min(kSlowTurnAcceleration * quarter, kSlowTurn * step));
  ChannelValues least{distance, distance, turn, turn, turn};
  for (std::size_t c = 0; c < kSampleChannels; ++c) least[c] += kRoundings * scale_.rounding[c];
  return least;
}

void SampleScreening::findBreaks() {
  for (const Piece& piece : pieces_) {
    for (std::size_t rank = piece.first + 1; rank + 1 < piece.last; ++rank) {
      const ChannelValues bent = bend(rank, piece);
      const double step =
          std::min(at(rank).time - at(rank - 1).time, at(rank + 1).time - at(rank).time);
      const ChannelValues least = floors(step, kFast);
      for (std::size_t c = 0; c < kSampleChannels; ++c) {
        if (bent[c] > kBreakShare * std::max(least[c], kFlightFactor * scale_.residual[c]))
          breaks_[rank] = 1;
      }
    }
  }
}

std::size_t SampleScreening::before(std::size_t rank, const Piece& piece) const {
  while (rank-- > piece.first)
    if (!excluded_[rank]) return rank;
  return kNone;
}

std::size_t SampleScreening::behind(std::size_t rank, const Piece& piece) const {
  while (++rank < piece.last)
    if (!excluded_[rank]) return rank;
  return kNone;
}

std::vector<const TrajectorySample*> SampleScreening::anchors(const Hypothesis& h,
                                                              std::size_t& count_before,
                                                              std::size_t& count_behind) const {
  std::array<std::size_t, SampleWindow::kMaximumSamples> earlier, later;
  count_before = count_behind = 0;
  for (std::size_t r = before(h.first, h.piece); r != kNone && count_before < earlier.size();
       r = before(r, h.piece))
    earlier[count_before++] = r;
  for (std::size_t r = behind(h.last, h.piece); r != kNone && count_behind < later.size();
       r = behind(r, h.piece))
    later[count_behind++] = r;
  // Where one side has too few, the other one has more.
  const std::size_t from_before =
      std::min(count_before, SampleWindow::kMaximumSamples - std::min(kBeside, count_behind));
  count_behind =
      std::min(count_behind, SampleWindow::kMaximumSamples - std::min(kBeside, from_before));
  count_before = from_before;
  std::vector<const TrajectorySample*> samples;
  samples.reserve(count_before + count_behind);
  for (std::size_t i = count_before; i-- > 0;) samples.push_back(&at(earlier[i]));
  for (std::size_t i = 0; i < count_behind; ++i) samples.push_back(&at(later[i]));
  return samples;
}

bool SampleScreening::headingFollowsCourse(const Hypothesis& h, double turn) const {
  const std::size_t p = before(h.first, h.piece);
  if (h.first == h.last || p == kNone || before(p, h.piece) == kNone) return false;
  const auto course = [&](std::size_t from, std::size_t to) {
    const Eigen::Vector3d way = at(to).position - at(from).position;
    return std::atan2(way.x(), way.y());
  };
  const double changed = course(h.first, h.first + 1) - course(before(p, h.piece), p);
  return std::abs(std::remainder(changed, 2.0 * kPi)) > 0.5 * turn;
}

bool SampleScreening::isOutlier(const Hypothesis& h, OutlierRun& run) const {
  const std::size_t p = before(h.first, h.piece), q = behind(h.last, h.piece);
  std::size_t count_before = 0, count_behind = 0;
  const auto beside = anchors(h, count_before, count_behind);
  const bool at_end = count_before == 0 || count_behind == 0;
  if (beside.size() < std::max(kFewestAnchors, at_end ? 2 * (h.last - h.first + 1) : 0))
    return false;
  const SampleWindow window(beside);
  double speed = std::numeric_limits<double>::infinity();  // the lower one of the two sides
  if (count_before > 1) speed = speedBetween(*beside[0], *beside[count_before - 1]);
  if (count_behind > 1)
    speed = std::min(speed, speedBetween(*beside[count_before], *beside.back()));
  ChannelValues least{};  // of both edges
  const auto judge = [&](std::size_t rank, std::size_t neighbour, std::size_t channel) {
    const double step = std::abs(at(rank).time - at(neighbour).time);
    double limit =
        std::max({floors(step, speed)[channel], kFlightFactor * scale_.residual[channel],
                  kLocalFactor * window.misfit()[channel] * window.amplification(at(rank).time)});
    if (at_end) {
      limit += kEndFactor * step *
               (channel <= kChannelHeight ? std::max(speed, scale_.speed) : scale_.turn_rate);
    }
    const double off = window.deviation(at(rank))[channel];
    const double sudden = std::max(bend(rank, h.piece)[channel], bend(neighbour, h.piece)[channel]);
    if (!(off > limit) || sudden < kBreakShare * off) return false;
    least[channel] = least[channel] == 0.0 ? off : std::min(least[channel], off);
    return true;
  };
  std::array<bool, kSampleChannels> wrong{};
  for (std::size_t c = 0; c < kSampleChannels; ++c)
    wrong[c] = (p == kNone || judge(h.first, p, c)) && (q == kNone || judge(h.last, q, c));
  if (wrong[kChannelHeading] && headingFollowsCourse(h, least[kChannelHeading]))
    wrong[kChannelHeading] = false;
  if (wrong[kChannelPlan] || wrong[kChannelHeight]) {
    run.distance = std::hypot(wrong[kChannelPlan] ? least[kChannelPlan] : 0.0,
                              wrong[kChannelHeight] ? least[kChannelHeight] : 0.0);
  }
  for (const std::size_t c : {kChannelRoll, kChannelPitch, kChannelHeading})
    if (wrong[c]) run.turn = std::max(run.turn, least[c]);
  return run.distance > 0.0 || run.turn > 0.0;
}

bool SampleScreening::tryRun(const Hypothesis& h) {
  if (excluded_[h.first] || excluded_[h.last]) return false;
  const std::size_t p = before(h.first, h.piece), q = behind(h.last, h.piece);
  if (p == kNone && q == kNone) return false;
  if (p != kNone && q != kNone && h.first < h.last && at(q).time - at(p).time > gap_threshold_)
    return false;
  OutlierRun run;
  if (!isOutlier(h, run)) return false;
  for (std::size_t rank = h.first; rank <= h.last; ++rank) {
    if (excluded_[rank]) continue;
    excluded_[rank] = 1;
    run.samples.push_back(indexOf(rank));
  }
  run.from = at(h.first).time, run.to = at(h.last).time;
  screening_.outliers.push_back(std::move(run));
  return true;
}

void SampleScreening::searchPiece(const Piece& piece) {
  std::vector<std::size_t> starts;  // of possible runs
  for (std::size_t rank = piece.first; rank < piece.last; ++rank) {
    if (breaks_[rank] || (rank > piece.first && breaks_[rank - 1]) ||
        (rank == piece.first && breaksAfter(rank)))
      starts.push_back(rank);
  }
  if (starts.empty()) return;
  bool found = true;
  for (int round = 0; round < kRounds && found; ++round) {
    found = false;
    for (std::size_t length = 1; length <= kLongestRun; ++length) {
      for (const std::size_t first : starts) {
        const std::size_t last = first + length - 1;
        if (last >= piece.last || (last + 1 < piece.last && !breaksAfter(last))) continue;
        if (tryRun({first, last, piece})) found = true;
      }
    }
  }
}

}  // namespace pcl_als::detail
