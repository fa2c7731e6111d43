// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/processing/survey_reader.h>

#include "survey_messages.h"

namespace pcl_als {
namespace {

std::vector<SurveyInput> inputsOf(const std::vector<std::string>& paths,
                                  const PointWindow& window) {
  requirePointFiles(paths.size());
  std::vector<SurveyInput> inputs;
  for (const std::string& path : paths) inputs.push_back(SurveyInput::ofFile(path, window));
  return inputs;
}

}  // namespace

SurveyReader::RunSink SurveyReader::asRuns(const Sink& sink) {
  return [&sink](int strip, const Run& run) {
    thread_local std::vector<LidarReturn> points;
    points.clear();
    points.reserve(run.to - run.from);
    for (std::size_t row = run.from; row < run.to; ++row) points.push_back(run.point(row));
    sink(strip, points.data(), points.size());
  };
}

SurveyReader::SurveyReader(const std::vector<std::string>& paths, int threads,
                           const PointWindow& window, Communicator* processes)
    : SurveyReader(threads, inputsOf(paths, window), processes) {
  channel_field_ = window.channel_field;
  if (!window.everything() && pointCount() == 0)
    refuseEmptyWindow({paths.begin(), paths.end()}, window);
}

SurveyReader SurveyReader::ofInputs(std::vector<SurveyInput> inputs, int threads) {
  return {threads, std::move(inputs), nullptr};
}

SurveyReader::SurveyReader(int threads, std::vector<SurveyInput> inputs, Communicator* processes)
    : threads_(threads),
      processes_(processes),
      inputs_(std::move(inputs)),
      files_(inputs_.size()),
      times_(inputs_.size()) {
  std::vector<double> costs;
  for (const SurveyInput& input : inputs_) costs.push_back(detail::readingCost(input.path));
  const SharedItems shares(processes_, costs);
  doTogether(processes_, [&] {
    parallelFor(shares.ownItems().size(), threads_, [&](std::size_t i) {
      const std::size_t file = shares.ownItems()[i];
      files_[file] = surveyFile(inputs_[file]);
    });
  });
  shareValues(
      processes_, shares, files_,
      [](ByteWriter& out, const SurveyedFile& file) { detail::put(out, file); },
      [](ByteReader& in, SurveyedFile& file) { detail::get(in, file); });
  std::vector<PointFileInfo> infos;
  infos.reserve(files_.size());
  for (const SurveyedFile& file : files_) infos.push_back(file.sources.info);
  reference_ = commonReference(infos);
  for (const SurveyedFile& file : files_)
    for (const std::string& remark : {file.sources.damage, file.sources.box_remark})
      if (!remark.empty()) reference_.remarks.push_back(remark);
  arrangement_.emplace(files_, StripChoice(), FlownTimes());
  divide(false);
}

std::uint64_t SurveyReader::pointCount() const {
  std::uint64_t count = 0;
  for (const SurveyedFile& file : files_) count += file.sources.info.point_count;
  return count;
}

Eigen::AlignedBox2d SurveyReader::extent() const {
  Eigen::AlignedBox2d box;
  for (const SurveyedFile& file : files_) {
    for (const PointSource& source : file.sources.sources) {
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
  for (const SurveyedFile& file : files_) {
    for (const PointSource& source : file.sources.sources) {
      corner = corner.cwiseMax(source.maximum.head<2>());
    }
  }
  return corner.allFinite() ? corner : Eigen::Vector2d(Eigen::Vector2d::Zero());
}

std::vector<TimeRange> SurveyReader::observedTimes() const {
  std::vector<TimeRange> times;
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const PointSource& source : files_[file].sources.sources) {
      if (!source.hasTimes() || arrangement_->stripsOf(file, source.id).empty()) continue;
      TimeRange range;
      range.add(times_[file](source.first_time));
      range.add(times_[file](source.last_time));
      times.push_back(range);
    }
  }
  return times;
}

double SurveyReader::resolution() const {
  double finest = std::numeric_limits<double>::infinity();
  for (const SurveyedFile& file : files_) {
    finest = std::min(finest, file.sources.info.resolution.head<2>().minCoeff());
  }
  // A TIN counts in steps of this inside areas of some hundred metres: neither finer nor coarser
  // helps.
  return std::clamp(finest, 1e-4, 0.01);
}

void SurveyReader::alignTimes(const Flight& flight, std::vector<std::string>& remarks) {
  times_ = continuousTimes(files_);
  if (flight.trajectory == nullptr) return;
  times_.assign(files_.size(), {});
  const TimeRange flown{flight.trajectory->startTime(), flight.trajectory->endTime()};
  std::string objection;
  std::size_t met = 0;
  for (std::size_t file = 0; file < files_.size(); ++file) {
    if (inputs_[file].time) {
      times_[file] = *inputs_[file].time;
      ++met;
      continue;
    }
    TimeRange range;
    for (const PointSource& source : files_[file].sources.sources) {
      if (!source.hasTimes()) continue;
      range.add(source.first_time);
      range.add(source.last_time);
    }
    const PointFileInfo& info = files_[file].sources.info;
    if (range.empty() && info.point_count > 0) range = {0.0, 0.0};
    try {
      times_[file] = reconcileTimes(info, range, flown, flight.gps_week);
      ++met;
    } catch (const InputError& error) {
      // Its points are then left out, with the others of their strips in mind: see the tally.
      if (objection.empty()) objection = error.what();
    }
    const std::string& remark = times_[file].remark;
    if (!remark.empty() && std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) {
      remarks.push_back(remark);
    }
  }
  if (met == 0) throw InputError(objection);
  if (!objection.empty()) remarks.push_back(objection);
}

std::vector<std::string> SurveyReader::choose(const StripChoice& choice, const Flight& flight) {
  std::vector<std::string> remarks;
  alignTimes(flight, remarks);
  arrangement_.emplace(files_, choice, FlownTimes{flight.trajectory, times_, flight.needed});
  left_out_.clear();
  for (const std::string& text : arrangement_->divisions()) remarks.push_back(text);
  divide(choice.by_channel);
  checkAnyLeft(flight);
  return remarks;
}

std::vector<std::set<std::uint8_t>> SurveyReader::channelsByStrip() const {
  std::vector<std::set<std::uint8_t>> channels(arrangement_->names().size());
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const auto& [id, present] : files_[file].channels) {
      for (const int strip : arrangement_->stripsOf(file, id))
        channels[static_cast<std::size_t>(strip)].insert(present.begin(), present.end());
    }
  }
  return channels;
}

std::string SurveyReader::channelField() const {
  if (channels_.empty()) return {};
  return channel_field_.empty() ? "scanner_channel" : channel_field_;
}

void SurveyReader::divide(bool by_channel) {
  strips_ = arrangement_->names();
  points_ = arrangement_->expectedPoints();
  channels_.clear();
  if (!by_channel) return;
  const auto present = channelsByStrip();
  std::vector<std::string> names;
  std::vector<std::uint64_t> points;
  for (std::size_t strip = 0; strip < strips_.size(); ++strip) {
    std::map<std::uint8_t, int>& index = channels_.emplace_back();
    for (const std::uint8_t channel : present[strip]) {
      index[channel] = static_cast<int>(names.size());
      names.push_back(channelStrip(strips_[strip], channel));
      points.push_back(points_[strip] / present[strip].size());
    }
  }
  strips_ = std::move(names);
  points_ = std::move(points);
}

void SurveyReader::passOn(int strip, const Run& run, const RunSink& sink) const {
  if (channels_.empty()) {
    sink(strip, run);
    return;
  }
  std::map<std::uint8_t, std::vector<std::size_t>> rows;
  for (std::size_t row = run.from; row < run.to; ++row) rows[run.chunk.channel[row]].push_back(row);
  for (const auto& [channel, chosen] : rows) {
    const PointChunk part = run.chunk.select(chosen);
    sink(channels_[static_cast<std::size_t>(strip)].at(channel),
         Run{part, 0, part.size(), run.time});
  }
}

void SurveyReader::checkAnyLeft(const Flight& flight) const {
  if (!strips().empty()) return;
  TimeRange range;  // of the first file with times, as it counts them
  std::string remark;
  for (std::size_t file = 0; file < files_.size() && range.empty(); ++file) {
    for (const PointSource& source : files_[file].sources.sources) {
      if (!source.hasTimes()) continue;
      range.add(source.first_time);
      range.add(source.last_time);
    }
    if (!times_[file].remark.empty()) remark = " (" + times_[file].remark + ")";
  }
  if (flight.trajectory == nullptr || range.empty())
    throw InputError("no strip is left: all are excluded or have no times");
  char text[600];
  std::snprintf(
      text, sizeof text,
      "no strip is left: the points were measured at %.3f to %.3f s%s, the trajectory covers "
      "%.3f to %.3f s%s: give the trajectory of this flight",
      range.first, range.last, remark.c_str(), flight.trajectory->startTime(),
      flight.trajectory->endTime(), flight.trajectory->gaps().empty() ? "" : " with gaps");
  throw InputError(text);
}

SurveyReader::Groups SurveyReader::groupsOfFiles() const {
  std::vector<std::size_t> group(files_.size());
  std::iota(group.begin(), group.end(), 0);
  std::map<int, std::size_t> first_file;
  const auto join = [&](std::size_t file, int strip) {
    const auto [known, added] = first_file.try_emplace(strip, file);
    if (added || group[known->second] == group[file]) return;
    const std::size_t merged = group[file], into = group[known->second];
    for (std::size_t& g : group) {
      if (g == merged) g = into;
    }
  };
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const PointSource& source : files_[file].sources.sources) {
      for (const int strip : arrangement_->stripsOf(file, source.id)) join(file, strip);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t file = 0; file < files_.size(); ++file) members[group[file]].push_back(file);
  Groups groups;
  groups.reserve(members.size());
  for (auto& entry : members) groups.push_back(std::move(entry.second));
  return groups;
}

LidarReturn SurveyReader::Run::point(std::size_t row) const {
  LidarReturn point;
  point.position = Eigen::Vector3d(chunk.x[row], chunk.y[row], chunk.z[row]);
  point.time = time(chunk.gps_time[row]);
  point.intensity = chunk.intensity[row];
  point.scan_angle = chunk.scan_angle[row];
  point.return_number = chunk.return_number[row];
  point.number_of_returns = chunk.number_of_returns[row];
  point.classification = chunk.classification[row];
  point.flags = chunk.flags[row];
  point.channel = chunk.channel[row];
  point.user_data = chunk.user_data[row];
  return point;
}

void SurveyReader::readGroups(const Groups& groups, const std::vector<std::size_t>& chosen,
                              const RunSink& sink,
                              std::vector<std::vector<std::uint64_t>>& counts) const {
  std::uint64_t all = 0, read = 0;
  for (const std::size_t group : chosen)
    for (const std::size_t file : groups[group]) all += files_[file].sources.info.point_count;
  std::mutex reporting;
  const auto done = [&](std::size_t points) {
    if (!progress_) return;
    const std::lock_guard<std::mutex> lock(reporting);
    read += points;
    progress_(std::min(1.0, static_cast<double>(read) / static_cast<double>(all)));
  };
  parallelFor(chosen.size(), threads_, [&](std::size_t i) {
    for (const std::size_t file : groups[chosen[i]]) readFile(file, sink, done, counts[chosen[i]]);
  });
}

void SurveyReader::readRuns(const RunSink& sink) const {
  const Groups groups = groupsOfFiles();
  const std::size_t labels = arrangement_->labels().size();
  std::vector<std::vector<std::uint64_t>> counts(groups.size(), std::vector<std::uint64_t>(labels));
  const SharedItems shares = sharesOf(groups);
  doTogether(processes_, [&] { readGroups(groups, shares.ownItems(), sink, counts); });
  shareValues(
      processes_, shares, counts,
      [](ByteWriter& out, const std::vector<std::uint64_t>& count) { out.put(count); },
      [](ByteReader& in, std::vector<std::uint64_t>& count) { in.get(count); });
  for (std::size_t group = 1; group < groups.size(); ++group) {
    for (std::size_t i = 0; i < labels; ++i) counts[0][i] += counts[group][i];
  }
  left_out_ = counts.empty() ? std::vector<LeftOutPoints>() : arrangement_->leftOut(counts[0]);
}

void SurveyReader::readRunsAtRoot(const RunSink& sink) const {
  doTogether(processes_, [&] {
    if (isRoot(processes_)) readAllGroups(sink);
  });
}

void SurveyReader::readAllGroups(const RunSink& sink) const {
  const Groups groups = groupsOfFiles();
  std::vector<std::vector<std::uint64_t>> counts(
      groups.size(), std::vector<std::uint64_t>(arrangement_->labels().size()));
  std::vector<std::size_t> all(groups.size());
  std::iota(all.begin(), all.end(), 0);
  readGroups(groups, all, sink, counts);
}

SharedItems SurveyReader::sharesOf(const Groups& groups) const {
  std::vector<double> costs;
  for (const std::vector<std::size_t>& group : groups) {
    costs.push_back(0.0);
    for (const std::size_t file : group)
      costs.back() += static_cast<double>(files_[file].sources.info.point_count);
  }
  return {processes_, costs};
}

SharedItems SurveyReader::stripShares() const {
  const Groups groups = groupsOfFiles();
  const SharedItems shares = sharesOf(groups);
  std::vector<int> owners(strips_.size(), 0);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const std::size_t file : groups[group]) {
      for (const PointSource& source : files_[file].sources.sources) {
        for (const int strip : arrangement_->stripsOf(file, source.id)) {
          const auto index = static_cast<std::size_t>(strip);
          if (channels_.empty()) owners[index] = shares.owner(group);
          if (channels_.empty()) continue;
          for (const auto& [channel, part] : channels_[index])
            owners[static_cast<std::size_t>(part)] = shares.owner(group);
        }
      }
    }
  }
  return {processes_, owners};
}

void SurveyReader::readFile(std::size_t file, const RunSink& sink,
                            const std::function<void(std::size_t points)>& done,
                            std::vector<std::uint64_t>& counts) const {
  StripArrangement::Sorter sorter(*arrangement_, file);
  const auto reader = inputs_[file].open();
  PointChunk chunk;
  while (reader->read(chunk)) {
    for (std::size_t from = 0; from < chunk.size();) {
      const auto [to, label] = sorter.run(chunk, from);
      counts[label] += to - from;
      const int strip = arrangement_->labels()[label].index;
      if (strip >= 0) passOn(strip, Run{chunk, from, to, times_[file]}, sink);
      from = to;
    }
    done(chunk.size());
  }
}

}  // namespace pcl_als
