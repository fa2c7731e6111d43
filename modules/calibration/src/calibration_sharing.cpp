// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// What the processes of a SystemCalibrationEngine tell each other.
#include <pcl_als/calibration/pairing_rules.h>
#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_vectors.h>

#include "area_matcher.h"

namespace pcl_als {

void SystemCalibrationEngine::shareSurvey() {
  if (!areShared(processes_)) return;
  std::vector<std::string> strips(ids_.size());
  for (const std::size_t index : strip_shares_.ownItems()) {
    const int strip = static_cast<int>(index);
    ByteWriter out;
    map_.putStrip(strip, out);
    plausibility_.putStrip(strip, out);
    if (!recoveries_.empty()) recoveries_[index].put(out);
    if (!scanners_.empty()) scanners_[index].put(out);
    strips[index] = out.take();
  }
  shareBytes(processes_, strip_shares_, strips);
  for (std::size_t index = 0; index < strips.size(); ++index) {
    if (strip_shares_.mine(index)) continue;
    const int strip = static_cast<int>(index);
    ByteReader in(strips[index]);
    map_.getStrip(strip, in);
    plausibility_.getStrip(strip, in);
    if (!recoveries_.empty()) recoveries_[index].get(in);
    if (!scanners_.empty()) scanners_[index].get(in);
  }
}

void SystemCalibrationEngine::shareAreas() {
  std::vector<double> points;
  for (const AreaMatcher& matcher : matchers_)
    points.push_back(static_cast<double>(matcher.pointCount()));
  if (!areShared(processes_)) return;
  const std::vector<std::string> all = processes_->gatherAll(ByteWriter().put(points).take());
  std::fill(points.begin(), points.end(), 0.0);
  loaded_points_ = 0;
  for (const std::string& bytes : all) {
    const auto theirs = ByteReader(bytes).take<std::vector<double>>();
    for (std::size_t area = 0; area < points.size(); ++area) points[area] += theirs[area];
  }
  for (const double count : points) loaded_points_ += static_cast<std::size_t>(count);
  area_shares_ = SharedItems(processes_, points);
  std::vector<ByteWriter> sent(static_cast<std::size_t>(processes_->size()));
  for (std::size_t area = 0; area < matchers_.size(); ++area) {
    if (isMine(area)) continue;
    ByteWriter& out = sent[static_cast<std::size_t>(area_shares_.owner(area))];
    for (const std::size_t strip : strip_shares_.ownItems()) {
      if (!matchers_[area].hasPoints(static_cast<int>(strip))) continue;
      out.put(area).put(strip);
      matchers_[area].put(static_cast<int>(strip), out);
    }
    matchers_[area].clear();
  }
  std::vector<std::string> bytes;
  for (ByteWriter& out : sent) bytes.push_back(out.take());
  for (const std::string& received : processes_->exchange(bytes)) {
    for (ByteReader in(received); !in.done();) {
      const auto area = in.take<std::size_t>();
      matchers_[area].get(static_cast<int>(in.take<std::size_t>()), in);
    }
  }
}

SystemCalibrationEngine::Candidates SystemCalibrationEngine::candidatesOfStrips() const {
  std::vector<std::vector<std::size_t>> counts(matchers_.size());
  for (const std::size_t area : area_shares_.ownItems())
    counts[area].push_back(matchers_[area].stripCount());
  shareVectors(processes_, area_shares_, counts);
  // Looks that are divided form pairs with both looks of the others.
  const std::size_t looks = conical_ || !trajectory_->scanPlanes().empty() ? 2 : 1;
  std::size_t strips = 1, pairs = 0;
  for (std::size_t area = 0; area < pair_areas_; ++area) {
    const std::size_t count = counts[area].front();
    strips += count;
    if (count > 0) pairs += count * (looks * count - 1);
  }
  const std::size_t per_strip = candidatesPerStrip(settings_.candidates, strips, pairs);
  return {per_strip, per_strip * pairs};
}

void SystemCalibrationEngine::forOwnAreas(const std::function<void(std::size_t area)>& work) const {
  doTogether(processes_, [&] {
    const std::vector<std::size_t>& own = area_shares_.ownItems();
    parallelFor(own.size(), settings_.threads, [&](std::size_t i) { work(own[i]); });
  });
}

}  // namespace pcl_als
