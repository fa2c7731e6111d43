// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "sample_repair.h"

#include <algorithm>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als::detail {
namespace {

/// Samples of one time further apart than this are two trajectories, not one measured twice.
constexpr double kMergeDistance = 1.0;

std::string withTime(const char* format, double time) {
  char text[200];
  std::snprintf(text, sizeof text, format, time);
  return text;
}

/// Far beyond any survey (seconds, metres), near enough to keep every sum finite.
constexpr double kLimit = 1e12;

}  // namespace

void refuseUnusable(const std::vector<TrajectorySample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TrajectorySample& sample = samples[i];
    // Written so that NaN fails, too.
    if (std::abs(sample.time) < kLimit && sample.position.cwiseAbs().maxCoeff() < kLimit &&
        sample.position.allFinite()) {
      continue;
    }
    throw InputError("trajectory: sample " + std::to_string(i + 1) + " of " +
                     std::to_string(samples.size()) +
                     " has a time or position that is not finite or beyond 1e12; remove it");
  }
}

namespace {

void sortByTime(std::vector<TrajectorySample>& samples, std::vector<std::string>& repairs) {
  const auto earlier = [](const TrajectorySample& a, const TrajectorySample& b) {
    return a.time < b.time;
  };
  std::size_t backwards = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (earlier(samples[i], samples[i - 1])) ++backwards;
  }
  if (backwards == 0) return;
  std::stable_sort(samples.begin(), samples.end(), earlier);
  repairs.push_back("trajectory: time ran backwards " + std::to_string(backwards) +
                    " time(s): sorted by time");
}

/// The mean of samples[first, last), all of one time. Angles are taken from the first.
TrajectorySample merged(const std::vector<TrajectorySample>& samples, std::size_t first,
                        std::size_t last) {
  TrajectorySample mean = samples[first];
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (std::size_t i = first + 1; i < last; ++i) {
    const Eigen::Vector3d difference = samples[i].position - mean.position;
    if (difference.norm() > kMergeDistance) {
      throw InputError(withTime(
          "trajectory: positions more than 1 m apart at time %.6f s; keep one of them", mean.time));
    }
    offset += difference;
  }
  mean.position += offset / static_cast<double>(last - first);
  return mean;
}

}  // namespace

void sortAndMerge(std::vector<TrajectorySample>& samples, std::vector<std::string>& repairs) {
  sortByTime(samples, repairs);
  std::size_t kept = 0, moved = 0;
  const std::size_t count = samples.size();
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && samples[last].time == samples[first].time) ++last;
    const TrajectorySample mean = merged(samples, first, last);
    if (mean.position != samples[first].position) ++moved;
    samples[kept++] = mean;
  }
  samples.resize(kept);
  if (kept < count) {
    repairs.push_back("trajectory: " + std::to_string(count - kept) +
                      " sample(s) repeated the time of another: merged, " + std::to_string(moved) +
                      " of them to a mean position");
  }
  if (kept < 2) {
    throw InputError("trajectory: " + std::to_string(kept) +
                     " distinct time(s); a flight line needs at least two samples");
  }
}

double gapThreshold(const std::vector<TrajectorySample>& samples, double requested) {
  if (requested > 0.0) return requested;
  std::vector<double> steps;
  steps.reserve(samples.size());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    steps.push_back(samples[i].time - samples[i - 1].time);
  }
  return gapThreshold(std::move(steps));
}

double gapThreshold(std::vector<double> steps) {
  return std::max(1.0, 5.0 * medianInPlace(steps));
}

void dropIsolated(std::vector<TrajectorySample>& samples, double gap_threshold,
                  std::vector<std::string>& repairs) {
  const auto joined = [&](std::size_t later) {
    return later > 0 && later < samples.size() &&
           samples[later].time - samples[later - 1].time <= gap_threshold;
  };
  std::vector<TrajectorySample> kept;
  const TrajectorySample* dropped = nullptr;
  kept.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (joined(i) || joined(i + 1)) {
      kept.push_back(samples[i]);
    } else if (dropped == nullptr) {
      dropped = &samples[i];
    }
  }
  if (dropped == nullptr) return;
  if (kept.empty()) {
    throw InputError(
        withTime("trajectory: no two samples are within the gap threshold of %.3f s of each other",
                 gap_threshold));
  }
  repairs.push_back(
      "trajectory: " + std::to_string(samples.size() - kept.size()) +
      withTime(" sample(s) alone between gaps excluded, first at %.6f s", dropped->time));
  samples = std::move(kept);
}

}  // namespace pcl_als::detail
