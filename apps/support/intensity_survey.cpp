// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_survey.h"

#include <algorithm>

namespace pcl_als::app {

void SurveyTally::add(const PointRun& run) {
  TimeRange all = run.times;
  if (run.zero_time) all.add(0.0);
  if (run.zero_time) zero_times_.add(0.0);
  if (!run.times.empty()) {
    times_.add(run.times.first);
    times_.add(run.times.last);
  }
  const auto [at, fresh] = sources_.try_emplace(run.source);
  PointSource& source = at->second;
  if (fresh) {
    source.id = run.source;
    source.first_time = all.first;
    source.last_time = all.last;
    source.minimum = run.minimum;
    source.maximum = run.maximum;
  }
  source.points += run.points;
  source.first_time = std::min(source.first_time, all.first);
  source.last_time = std::max(source.last_time, all.last);
  source.minimum = source.minimum.cwiseMin(run.minimum);
  source.maximum = source.maximum.cwiseMax(run.maximum);
  zeros_ += run.zeros;
  largest_ = std::max(largest_, run.largest);
}

void SurveyTally::merge(const SurveyTally& other) {
  for (const auto& [id, theirs] : other.sources_) {
    const auto [at, fresh] = sources_.try_emplace(id, theirs);
    if (fresh) continue;
    PointSource& mine = at->second;
    mine.points += theirs.points;
    mine.first_time = std::min(mine.first_time, theirs.first_time);
    mine.last_time = std::max(mine.last_time, theirs.last_time);
    mine.minimum = mine.minimum.cwiseMin(theirs.minimum);
    mine.maximum = mine.maximum.cwiseMax(theirs.maximum);
  }
  for (const auto& [mine, theirs] :
       {std::pair(&times_, &other.times_), std::pair(&zero_times_, &other.zero_times_)}) {
    mine->first = std::min(mine->first, theirs->first);
    mine->last = std::max(mine->last, theirs->last);
  }
  zeros_ += other.zeros_;
  largest_ = std::max(largest_, other.largest_);
}

void SurveyTally::store(IntensitySurvey& survey) const {
  for (const auto& [id, source] : sources_) survey.sources.sources.push_back(source);
  const TimeRange& range = times_.empty() ? zero_times_ : times_;
  survey.first_time = range.first;
  survey.last_time = range.last;
  survey.zeros = zeros_;
  survey.largest = largest_;
}

}  // namespace pcl_als::app
