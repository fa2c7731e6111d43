// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/survey/strip_assignment.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {
namespace {

template <typename Path>
std::vector<SurveyInput> inputsOf(const std::vector<Path>& paths, const PointWindow& window) {
  requirePointFiles(paths.size());
  std::vector<SurveyInput> inputs;
  for (const Path& path : paths) inputs.push_back(SurveyInput::ofFile(path, window));
  return inputs;
}

}  // namespace

SurveyReader::SurveyReader(SurveyReader&& other) noexcept = default;
SurveyReader& SurveyReader::operator=(SurveyReader&& other) noexcept = default;
SurveyReader::~SurveyReader() = default;

SurveyReader::SurveyReader(const std::vector<std::string>& paths, int threads,
                           const PointWindow& window, Communicator* processes)
    : SurveyReader(threads, inputsOf(paths, window), processes) {
  setReference();
  channel_field_ = window.channel_field;
  requireAny(window);
}

SurveyReader SurveyReader::ofInputs(std::vector<SurveyInput> inputs, int threads) {
  SurveyReader survey(threads, std::move(inputs), nullptr);
  survey.setReference();
  return survey;
}

SurveyReader SurveyReader::ofFiles(const std::vector<std::filesystem::path>& paths, int threads,
                                   const PointWindow& window) {
  SurveyReader survey(threads, inputsOf(paths, window), nullptr);
  survey.requireAny(window);
  return survey;
}

SurveyReader::SurveyReader(std::vector<SurveyedFile> files, int threads, const PointWindow& window)
    : threads_(threads),
      files_(std::make_unique<std::vector<SurveyedFile>>(std::move(files))),
      times_(files_->size()) {
  for (const SurveyedFile& file : *files_)
    inputs_.push_back(SurveyInput::ofFile(file.sources.info.path, window));
}

SurveyReader SurveyReader::ofWholeFiles(const std::vector<PointFileInfo>& files, int threads,
                                        const PointWindow& window) {
  std::vector<SurveyedFile> known(files.size());
  for (std::size_t file = 0; file < files.size(); ++file) known[file].sources.info = files[file];
  SurveyReader survey(std::move(known), threads, window);
  for (const PointFileInfo& file : files) {
    survey.strips_.push_back(file.path.string());
    survey.points_.push_back(file.point_count);
  }
  return survey;
}

SurveyReader SurveyReader::ofSurveyed(std::vector<SurveyedFile> files, const StripChoice& choice,
                                      const FlownTimes& flown, int threads) {
  SurveyReader survey(std::move(files), threads, PointWindow());
  survey.times_ = flown.alignments;
  survey.times_.resize(survey.files().size());
  survey.arrangement_ = std::make_unique<StripAssignment>(survey.files(), choice, flown);
  survey.divide(false);
  return survey;
}

SurveyReader::SurveyReader(int threads, std::vector<SurveyInput> inputs, Communicator* processes)
    : threads_(threads),
      processes_(processes),
      inputs_(std::move(inputs)),
      files_(std::make_unique<std::vector<SurveyedFile>>(surveyFiles(inputs_, threads, processes))),
      times_(inputs_.size()) {
  arrangement_ = std::make_unique<StripAssignment>(files(), StripChoice(), FlownTimes());
  divide(false);
}

void SurveyReader::setReference() {
  std::vector<PointFileInfo> infos;
  for (const SurveyedFile& file : files()) infos.push_back(file.sources.info);
  reference_ = commonReference(infos);
  for (const SurveyedFile& file : files())
    for (const std::string& remark : {file.sources.damage, file.sources.box_remark})
      if (!remark.empty()) reference_.remarks.push_back(remark);
}

void SurveyReader::requireAny(const PointWindow& window) const {
  if (window.everything() || pointCount() > 0) return;
  std::vector<std::filesystem::path> paths;
  for (const SurveyedFile& file : files()) paths.push_back(file.sources.info.path);
  refuseEmptyWindow(paths, window);
}

std::uint64_t SurveyReader::pointCount() const {
  std::uint64_t count = 0;
  for (const SurveyedFile& file : files()) count += file.sources.info.point_count;
  return count;
}

Eigen::AlignedBox2d SurveyReader::extent() const {
  Eigen::AlignedBox2d box;
  for (const SurveyedFile& file : files()) {
    for (const PointSource& source : file.sources.sources) {
      box.extend(Eigen::Vector2d(source.minimum.head<2>()));
      box.extend(Eigen::Vector2d(source.maximum.head<2>()));
    }
  }
  return box;
}

namespace {

Eigen::Vector2d finiteOrOrigin(const Eigen::AlignedBox2d& box, const Eigen::Vector2d& corner) {
  if (box.isEmpty() || !corner.allFinite()) return Eigen::Vector2d::Zero();
  return corner;
}

}  // namespace

Eigen::Vector2d SurveyReader::corner() const {
  const Eigen::AlignedBox2d box = extent();
  return finiteOrOrigin(box, box.min());
}

Eigen::Vector2d SurveyReader::farCorner() const {
  const Eigen::AlignedBox2d box = extent();
  return finiteOrOrigin(box, box.max());
}

std::vector<TimeRange> SurveyReader::observedTimes() const {
  std::vector<TimeRange> times;
  for (std::size_t file = 0; file < files().size(); ++file) {
    for (const PointSource& source : files()[file].sources.sources) {
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
  for (const SurveyedFile& file : files()) {
    finest = std::min(finest, file.sources.info.resolution.head<2>().minCoeff());
  }
  // A TIN counts in steps of this inside areas of some hundred metres: neither finer nor coarser
  // helps.
  return std::clamp(finest, 1e-4, 0.01);
}

void SurveyReader::alignTimes(const Flight& flight, std::vector<std::string>& remarks) {
  times_ = continuousTimes(files());
  if (flight.trajectory == nullptr) return;
  times_.assign(files().size(), {});
  const TimeRange flown{flight.trajectory->startTime(), flight.trajectory->endTime()};
  std::string objection;
  std::size_t met = 0;
  for (std::size_t file = 0; file < files().size(); ++file) {
    if (inputs_[file].time) {
      times_[file] = *inputs_[file].time;
      ++met;
      continue;
    }
    TimeRange range;
    for (const PointSource& source : files()[file].sources.sources) {
      if (!source.hasTimes()) continue;
      range.add(source.first_time);
      range.add(source.last_time);
    }
    const PointFileInfo& info = files()[file].sources.info;
    if (range.empty() && info.point_count > 0) range = {0.0, 0.0};
    try {
      times_[file] = reconcileTimes(info, range, flown, flight.gps_week);
      ++met;
    } catch (const InputError& error) {
      // StripAssignment then excludes the points of this file, as outside of the trajectory.
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
  arrangement_ = std::make_unique<StripAssignment>(
      files(), choice, FlownTimes{flight.trajectory, times_, flight.needed});
  for (const std::string& text : arrangement_->divisions()) remarks.push_back(text);
  divide(choice.by_channel);
  checkAnyLeft(flight);
  return remarks;
}

std::vector<std::set<std::uint8_t>> SurveyReader::channelsByStrip() const {
  std::vector<std::set<std::uint8_t>> channels(arrangement_->names().size());
  for (std::size_t file = 0; file < files().size(); ++file) {
    for (const auto& [id, present] : files()[file].channels) {
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

void SurveyReader::checkAnyLeft(const Flight& flight) const {
  if (!strips().empty()) return;
  TimeRange range;  // of the first file with times, as it counts them
  std::string remark;
  for (std::size_t file = 0; file < files().size() && range.empty(); ++file) {
    for (const PointSource& source : files()[file].sources.sources) {
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

bool SurveyReader::areOfOnePass(int a, int b) const {
  return channels_.empty() &&
         arrangement_->areOfOnePass(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
}

}  // namespace pcl_als
