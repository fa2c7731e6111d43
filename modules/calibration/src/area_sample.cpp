// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

#include "area_matcher.h"
#include "block_calibration.h"
#include "pair_observation.h"
#include "strip_corrections.h"

namespace pcl_als {
namespace {

// times the median of plain ground: rougher neighbourhoods are no planes
constexpr double kRoughnessFactor = 3.0;

AreaMatcher matcherOf(const SurveyArea& area, const BlockStrips& strips) {
  AreaMatcher matcher(area, strips.size());
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips.fixed_surface_of[i] < 0) continue;
    const BlockStrips::Held& held =
        strips.held[static_cast<std::size_t>(strips.fixed_surface_of[i])];
    matcher.hold(static_cast<int>(i), held.surface.std, !held.is_reference);
  }
  return matcher;
}

}  // namespace

bool Corrections::isZero() const {
  return biases.isZero(0.0) && sources.isZero(0.0) &&
         std::all_of(differences.begin(), differences.end(),
                     [](const SystemUnknowns& difference) { return difference.isZero(0.0); });
}

StripCorrections::StripCorrections(const SurveyBlock& block, const Corrections& corrections) {
  for (const SystemUnknowns& difference : corrections.differences)
    of_systems_.emplace_back(block.flight.trajectory,
                             corrections.biases + difference.head<kSystemParameterCount>());
  for (int strip = 0; strip < static_cast<int>(block.strips.size()); ++strip) {
    const auto system = static_cast<std::size_t>(block.systems.of(strip));
    strips_.push_back({&of_systems_[system], corrections.differences[system].tail<3>()});
  }
}

AreaSample::AreaSample(const SurveyBlock& block) : block_(block), index_(block.areas) {
  for (const SurveyArea& area : block.areas) matchers_.push_back(matcherOf(area, block.strips));
  shares_ = SharedItems(nullptr, std::vector<double>(matchers_.size(), 1.0));
}

AreaSample::~AreaSample() = default;

const AreaMatcher& AreaSample::area(std::size_t index) const {
  return matchers_[index];
}

AreaMatcher& AreaSample::area(std::size_t index) {
  return matchers_[index];
}

void AreaSample::add(int strip, const LidarReturn* points, std::size_t count,
                     const double* range_std) {
  if (!block_.strips.used[static_cast<std::size_t>(strip)]) return;
  std::size_t with_std = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const LidarReturn& point = points[i];
    if (!point.position.allFinite() || !std::isfinite(point.time)) continue;
    const bool known = range_std != nullptr && std::isfinite(range_std[i]) && range_std[i] > 0.0;
    const float std = known ? static_cast<float>(range_std[i]) : 0.0F;
    const std::vector<int>& areas = index_.candidates(point.position);
    with_std += known && !areas.empty() ? 1 : 0;
    for (const int area : areas) matchers_[static_cast<std::size_t>(area)].add(strip, point, std);
  }
  with_range_std_ += with_std;
}

std::size_t AreaSample::pointCount() const {
  if (areShared(processes_)) return loaded_points_;
  std::size_t count = 0;
  for (const AreaMatcher& matcher : matchers_) count += matcher.pointCount();
  return count;
}

void AreaSample::distribute(Communicator* processes, const SharedItems& strips) {
  if (!areShared(processes)) return;
  processes_ = processes;
  std::vector<double> points;
  for (const AreaMatcher& matcher : matchers_)
    points.push_back(static_cast<double>(matcher.pointCount()));
  const std::vector<std::string> all = processes->gatherAll(ByteWriter().put(points).take());
  std::fill(points.begin(), points.end(), 0.0);
  for (const std::string& bytes : all) {
    const auto theirs = ByteReader(bytes).take<std::vector<double>>();
    for (std::size_t area = 0; area < points.size(); ++area) points[area] += theirs[area];
  }
  for (const double count : points) loaded_points_ += static_cast<std::size_t>(count);
  shares_ = SharedItems(processes, points);
  std::vector<ByteWriter> sent(static_cast<std::size_t>(processes->size()));
  for (std::size_t area = 0; area < matchers_.size(); ++area) {
    if (shares_.mine(area)) continue;
    ByteWriter& out = sent[static_cast<std::size_t>(shares_.owner(area))];
    for (const std::size_t strip : strips.ownItems()) {
      if (!matchers_[area].hasPoints(static_cast<int>(strip))) continue;
      out.put(area).put(strip);
      matchers_[area].put(static_cast<int>(strip), out);
    }
    matchers_[area].clear();
  }
  std::vector<std::string> bytes;
  for (ByteWriter& out : sent) bytes.push_back(out.take());
  for (const std::string& received : processes->exchange(bytes)) {
    for (ByteReader in(received); !in.done();) {
      const auto area = in.take<std::size_t>();
      matchers_[area].get(static_cast<int>(in.take<std::size_t>()), in);
    }
  }
}

void AreaSample::forAreas(const std::function<void(std::size_t area)>& work) const {
  doTogether(processes_, [&] {
    const std::vector<std::size_t>& own = shares_.ownItems();
    parallelFor(own.size(), block_.settings().threads, [&](std::size_t i) { work(own[i]); });
  });
}

AreaSample::Candidates AreaSample::candidates() const {
  const auto counts = collect<std::size_t>([&](std::size_t area, std::vector<std::size_t>& count) {
    count.push_back(matchers_[area].stripCount());
  });
  // Strips that are divided form pairs of each half-scan with both half-scans of the others.
  const std::size_t halves =
      block_.scanner.conical || !block_.trajectory().scanPlanes().empty() ? 2 : 1;
  std::size_t strips = 1, pairs = 0;
  for (std::size_t area = 0; area < block_.pairAreas(); ++area) {
    const std::size_t count = counts[area].front();
    strips += count;
    if (count > 0) pairs += count * (halves * count - 1);
  }
  const std::size_t per_strip = candidatesPerStrip(block_.settings().candidates, strips, pairs);
  return {per_strip, per_strip * pairs};
}

Warnings AreaSample::prepare() {
  const Warnings warnings = distributeRounded();
  const std::size_t candidates = this->candidates().per_strip;
  const CalibrationSettings& settings = block_.settings();
  const auto roughness = collect<double>([&](std::size_t i, std::vector<double>& values) {
    const bool control = block_.isControl(i);
    if (block_.scanner.rosette && !control) matchers_[i].evenOut();
    matchers_[i].prepare(settings.patches, control ? 0 : candidates, settings.resolution,
                         block_.trajectory());
    matchers_[i].collectRoughness(values);
  });
  std::vector<double> all;
  for (const auto& values : roughness) all.insert(all.end(), values.begin(), values.end());
  if (all.empty()) return warnings;
  const double plain = medianInPlace(all);
  const double most = std::min(settings.patches.roughness, kRoughnessFactor * plain);
  for (AreaMatcher& matcher : matchers_) matcher.limitRoughness(most, plain);
  return warnings;
}

void AreaSample::correct(const Corrections& corrections) {
  if (corrections == corrected_ || (corrected_.isZero() && corrections.isZero())) return;
  corrected_ = corrections;
  const StripCorrections of(block_, corrections);
  forAreas([&](std::size_t i) {
    matchers_[i].correct(of.strips(), corrections.sources, block_.trajectory());
  });
}

void AreaSample::considerSources(const ErrorSourceScale& scale) {
  for (AreaMatcher& matcher : matchers_) matcher.considerSources(scale);
}

std::vector<std::vector<TimeSpan>> measuredTimes(const AreaSample& sample) {
  const BlockStrips& strips = sample.block().strips;
  using StripSpan = std::pair<int, TimeSpan>;
  const auto spans = sample.collect<StripSpan>([&](std::size_t i, std::vector<StripSpan>& found) {
    for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
      if (strips.isReference(strip)) continue;
      for (const TimeSpan& span : sample.area(i).timesOf(strip)) found.emplace_back(strip, span);
    }
  });
  std::vector<std::vector<TimeSpan>> times(strips.size());
  for (const std::vector<StripSpan>& of_area : spans)
    for (const auto& [strip, span] : of_area)
      times[static_cast<std::size_t>(strip)].push_back(span);
  return times;
}

}  // namespace pcl_als
