// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "survey_reader.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include <pcl_als/common/parallel.h>

namespace pcl_als::app {

SurveyReader::SurveyReader(const std::vector<std::string>& paths, int threads)
    : threads_(threads), files_(paths.size()), times_(paths.size()) {
  parallelFor(paths.size(), threads,
              [&](std::size_t file) { files_[file] = surveySources(paths[file]); });
  naming_.emplace(files_);
}

std::uint64_t SurveyReader::pointCount() const {
  std::uint64_t count = 0;
  for (const PointFileSources& file : files_) count += file.info.point_count;
  return count;
}

std::string SurveyReader::crs() const {
  for (const PointFileSources& file : files_) {
    if (!file.info.crs.empty()) return file.info.crs;
  }
  return {};
}

Eigen::AlignedBox2d SurveyReader::extent() const {
  Eigen::AlignedBox2d box;
  for (const PointFileSources& file : files_) {
    for (const PointSource& source : file.sources) {
      box.extend(Eigen::Vector2d(source.minimum.head<2>()));
      box.extend(Eigen::Vector2d(source.maximum.head<2>()));
    }
  }
  return box;
}

Eigen::Vector2d SurveyReader::corner() const {
  const Eigen::Vector2d corner = extent().min();
  return corner.allFinite() && !extent().isEmpty() ? corner
                                                   : Eigen::Vector2d(Eigen::Vector2d::Zero());
}

Eigen::Vector2d SurveyReader::farCorner() const {
  Eigen::Vector2d corner = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  for (const PointFileSources& file : files_) {
    for (const PointSource& source : file.sources) {
      corner = corner.cwiseMax(source.maximum.head<2>());
    }
  }
  return corner.allFinite() ? corner : Eigen::Vector2d(Eigen::Vector2d::Zero());
}

double SurveyReader::resolution() const {
  double finest = std::numeric_limits<double>::infinity();
  for (const PointFileSources& file : files_) {
    finest = std::min(finest, file.info.resolution.head<2>().minCoeff());
  }
  // A TIN counts in steps of this inside areas of some hundred metres: neither finer nor coarser
  // helps.
  return std::clamp(finest, 1e-4, 0.01);
}

std::vector<std::string> SurveyReader::alignTimes(const Trajectory& trajectory,
                                                  std::optional<int> gps_week) {
  std::vector<std::string> remarks;
  const TimeRange flight{trajectory.startTime(), trajectory.endTime()};
  for (std::size_t file = 0; file < files_.size(); ++file) {
    TimeRange range;
    for (const PointSource& source : files_[file].sources) {
      range.add(source.first_time);
      range.add(source.last_time);
    }
    const PointFileInfo& info = files_[file].info;
    times_[file] = reconcileTimes(info.path.string(), range, info.time_kind, flight, gps_week);
    const std::string& remark = times_[file].remark;
    if (!remark.empty() && std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) {
      remarks.push_back(remark);
    }
  }
  return remarks;
}

std::vector<std::vector<std::size_t>> SurveyReader::groupsOfFiles() const {
  std::vector<std::size_t> group(files_.size());
  std::iota(group.begin(), group.end(), 0);
  std::map<std::string, std::size_t> first_file;
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const PointSource& source : files_[file].sources) {
      const auto [known, added] = first_file.try_emplace(naming_->nameOf(file, source.id), file);
      if (added || group[known->second] == group[file]) continue;
      const std::size_t merged = group[file], into = group[known->second];
      for (std::size_t& g : group) {
        if (g == merged) g = into;
      }
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t file = 0; file < files_.size(); ++file) members[group[file]].push_back(file);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(members.size());
  for (auto& entry : members) groups.push_back(std::move(entry.second));
  return groups;
}

CalibrationPoint SurveyReader::Run::point(std::size_t row) const {
  CalibrationPoint point;
  point.position = Eigen::Vector3d(chunk.x[row], chunk.y[row], chunk.z[row]);
  point.time = time(chunk.gps_time[row]);
  point.return_number = chunk.return_number[row];
  point.number_of_returns = chunk.number_of_returns[row];
  point.classification = chunk.classification[row];
  point.flags = chunk.flags[row];
  return point;
}

void SurveyReader::read(const Sink& sink) const {
  readRuns([&](int strip, const Run& run) {
    thread_local std::vector<CalibrationPoint> points;
    points.clear();
    points.reserve(run.to - run.from);
    for (std::size_t row = run.from; row < run.to; ++row) points.push_back(run.point(row));
    sink(strip, points.data(), points.size());
  });
}

void SurveyReader::readRuns(const RunSink& sink) const {
  const auto groups = groupsOfFiles();
  parallelFor(groups.size(), threads_, [&](std::size_t group) {
    for (const std::size_t file : groups[group]) readFile(file, sink);
  });
}

void SurveyReader::readFile(std::size_t file, const RunSink& sink) const {
  std::map<std::uint16_t, int> strip_of;
  for (const PointSource& source : files_[file].sources) {
    const auto& names = naming_->names();
    const auto found = std::find(names.begin(), names.end(), naming_->nameOf(file, source.id));
    strip_of[source.id] = static_cast<int>(found - names.begin());
  }
  const auto reader = PointReader::open(files_[file].info.path);
  PointChunk chunk;
  while (reader->read(chunk)) {
    for (std::size_t from = 0, to = 0; from < chunk.size(); from = to) {
      for (to = from + 1;
           to < chunk.size() && chunk.point_source_id[to] == chunk.point_source_id[from]; ++to) {
      }
      sink(strip_of.at(chunk.point_source_id[from]), Run{chunk, from, to, times_[file]});
    }
  }
}

}  // namespace pcl_als::app
