// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_survey.h"

#include <algorithm>

namespace pcl_als {

void SurveyStatistics::add(const PointSource& source) {
  const auto [at, fresh] = sources_.try_emplace(source.id, source);
  if (!fresh) at->second.merge(source);
}

void SurveyStatistics::add(const PointRun& run) {
  TimeRange all = run.times;
  if (run.zero_time) all.add(0.0);
  if (run.zero_time) zero_times_.add(0.0);
  if (!run.times.empty()) {
    times_.add(run.times.first);
    times_.add(run.times.last);
  }
  add({run.source, run.points, all.first, all.last, run.minimum, run.maximum});
  zeros_ += run.zeros;
  largest_ = std::max(largest_, run.largest);
}

void SurveyStatistics::merge(const SurveyStatistics& other) {
  for (const auto& [id, theirs] : other.sources_) add(theirs);
  for (const auto& [id, theirs] : other.tracks_) tracks_[id].merge(theirs);
  for (const auto& [mine, theirs] :
       {std::pair(&times_, &other.times_), std::pair(&zero_times_, &other.zero_times_)}) {
    mine->first = std::min(mine->first, theirs->first);
    mine->last = std::max(mine->last, theirs->last);
  }
  zeros_ += other.zeros_;
  largest_ = std::max(largest_, other.largest_);
}

void SurveyStatistics::store(IntensitySurvey& survey) const {
  for (const auto& [id, source] : sources_) survey.sources.sources.push_back(source);
  survey.tracks = tracks_;
  const TimeRange& range = times_.empty() ? zero_times_ : times_;
  survey.first_time = range.first;
  survey.last_time = range.last;
  survey.zeros = zeros_;
  survey.largest = largest_;
}

}  // namespace pcl_als
