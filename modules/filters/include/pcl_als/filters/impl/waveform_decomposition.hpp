// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/filters/waveform_decomposition.h>

namespace pcl_als {

/// What one thread makes of some pulses.
template <typename PointT>
struct WaveformDecomposition<PointT>::Part {
  Part(const std::map<unsigned, PulseResponse>& responses, const EchoSettings& settings,
       const WaveformProvider& waveforms)
      : found(responses, settings), access(waveforms.access()) {}

  PulseEchoes found;
  std::unique_ptr<WaveformProvider::Access> access;
  Waveform waveform;
  std::vector<double> locations;  ///< of the returns of the pulse
  std::vector<double> times;      ///< of the points of the pulse in the output
  pcl::PointCloud<PointT> cloud;
  std::vector<EchoAttributes> echoes;
  pcl::Indices sources;

  void clear() {
    cloud.clear();
    echoes.clear();
    sources.clear();
  }
  void add(const PointT& point, std::size_t source, double time) {
    cloud.push_back(point);
    echoes.emplace_back();
    sources.push_back(static_cast<pcl::index_t>(source));
    times.push_back(time);
  }
  /// Moves the last point along its pulse.
  void move(double time, const WaveformReference& own) {
    const Eigen::Vector3d shift = (time - static_cast<double>(own.location_ps)) * own.alongPulse();
    PointT& point = cloud.back();
    point.x = static_cast<float>(static_cast<double>(point.x) + shift.x());
    point.y = static_cast<float>(static_cast<double>(point.y) + shift.y());
    point.z = static_cast<float>(static_cast<double>(point.z) + shift.z());
    times.back() = time;
  }
};

template <typename PointT>
std::map<unsigned, PulseResponse> WaveformDecomposition<PointT>::findResponses() {
  const auto access = waveforms_->access();
  Waveform waveform;
  const WaveformRunReader read = [&](std::uint64_t first, std::size_t count, const auto& take) {
    for (std::uint64_t i = first; i < first + count; ++i)
      if (access->read(i, waveform)) take(waveform);
  };
  auto responses = pulseResponses(waveforms_->descriptors(), settings_, waveforms_->size(), read,
                                  waveforms_->name())
                       .by_descriptor;
  pulse_widths_.clear();
  for (const auto& [index, response] : responses)
    pulse_widths_[index] = response.width() * kFwhmOfGaussian *
                           waveforms_->descriptors().at(index).spacing_ps /
                           kPicosecondsPerNanosecond;
  return responses;
}

/// Divides the cloud into runs of points with one waveform.
template <typename PointT>
std::vector<typename WaveformDecomposition<PointT>::Pulse>
WaveformDecomposition<PointT>::findPulses() const {
  std::vector<Pulse> pulses;
  PacketMemory memory;
  const std::size_t all = this->input_->size();
  for (std::size_t from = 0, to = 0; from < all; from = to) {
    const WaveformReference& own = waveforms_->reference(from);
    for (to = from + 1; to < all && to - from < kMostPointsOfPulse &&
                        sameWaveform(own, waveforms_->reference(to));)
      ++to;
    pulses.push_back({from, to - from, own.descriptor != 0 && memory.meets(own.byte_offset)});
  }
  return pulses;
}

template <typename PointT>
void WaveformDecomposition<PointT>::addEchoes(const Pulse& pulse, Part& part) const {
  constexpr std::uint8_t kUnclassified = 1;
  for (int e = 0; e < part.found.count(); ++e) {
    if (part.found.returnOf(e) >= 0) continue;
    const std::size_t source = pulse.first + part.found.nearestReturn(e);
    const WaveformReference& own = waveforms_->reference(source);
    part.add((*this->input_)[source], source, 0.0);
    part.move(part.found.timeOf(e), own);
    part.echoes.back() = part.found.attributesOf(e, own.alongPulse().norm());
    PointT& point = part.cloud.back();
    if constexpr (HasIntensity<PointT>::value)
      point.intensity =
          static_cast<float>(static_cast<double>(point.intensity) * part.found.intensityRatio(e));
    if constexpr (HasClassification<PointT>::value) point.classification = kUnclassified;
    if constexpr (HasFlags<PointT>::value) point.flags |= kSynthetic;
  }
}

/// Numbers the returns of a pulse by their times, if all of them are here.
template <typename PointT>
void WaveformDecomposition<PointT>::numberReturns(const Pulse& pulse, std::size_t begin,
                                                  Part& part) const {
  if constexpr (HasReturns<PointT>::value) {
    const unsigned most = 15;  // in LAS 1.4
    if ((*this->input_)[pulse.first].number_of_returns != pulse.count) return;
    const std::vector<unsigned> numbers = numbersByTime(part.times);
    const auto count = static_cast<unsigned>(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      PointT& point = part.cloud[begin + i];
      point.return_number = static_cast<std::uint8_t>(std::min(numbers[i], most));
      point.number_of_returns = static_cast<std::uint8_t>(std::min(count, most));
    }
  }
}

template <typename PointT>
void WaveformDecomposition<PointT>::decompose(const Pulse& pulse, const std::vector<bool>& selected,
                                              Part& part) const {
  const std::size_t begin = part.cloud.size();
  part.times.clear();
  part.locations.clear();
  bool wanted = false;
  for (std::size_t i = pulse.first; i < pulse.first + pulse.count; ++i) {
    wanted = wanted || selected[i];
    part.locations.push_back(static_cast<double>(waveforms_->reference(i).location_ps));
  }
  const bool has_waveform = wanted && part.access->read(pulse.first, part.waveform);
  if (has_waveform) part.found.decompose(part.waveform, part.locations);
  for (std::size_t p = 0; p < pulse.count; ++p) {
    const std::size_t i = pulse.first + p;
    part.add((*this->input_)[i], i, part.locations[p]);
    if (!has_waveform || !selected[i] || part.found.echoOf(p) < 0) continue;
    const WaveformReference& own = waveforms_->reference(i);
    const int echo = part.found.echoOf(p);
    part.echoes.back() = part.found.attributesOf(echo, own.alongPulse().norm());
    if (move_returns_) part.move(part.found.timeOf(echo), own);
  }
  if (has_waveform && new_echoes_ && !pulse.repeated) addEchoes(pulse, part);
  if (part.times.size() > pulse.count) numberReturns(pulse, begin, part);
}

template <typename PointT>
void WaveformDecomposition<PointT>::applyFilter(PointCloud& output) {
  constexpr std::size_t kPulsesTogether = 512;  // divides the work
  if (!waveforms_) throw UsageError("WaveformDecomposition: no waveforms are set");
  const std::size_t points = this->input_->size();
  if (waveforms_->size() != points)
    throw UsageError("WaveformDecomposition: waveforms of " + std::to_string(waveforms_->size()) +
                     " points and a cloud of " + std::to_string(points));
  settings_.check();
  std::vector<bool> selected(points, false);
  for (const auto index : *this->indices_) selected[static_cast<std::size_t>(index)] = true;
  const std::map<unsigned, PulseResponse> responses = findResponses();
  const std::vector<Pulse> pulses = findPulses();
  pcl::PointCloud<PointT> all;
  all.reserve(points);
  echoes_.clear();
  sources_.clear();
  std::vector<Part> parts;
  for (unsigned i = 0; i < threadCount(threads_); ++i)
    parts.emplace_back(responses, settings_, *waveforms_);
  const std::size_t together = parts.size() * kPulsesTogether;
  for (std::size_t from = 0; from < pulses.size(); from += together) {
    const std::size_t to = std::min(pulses.size(), from + together);
    const std::size_t chunks = (to - from + kPulsesTogether - 1) / kPulsesTogether;
    parallelFor(chunks, threads_, [&](std::size_t chunk) {
      parts[chunk].clear();
      const std::size_t begin = from + chunk * kPulsesTogether;
      for (std::size_t i = begin; i < std::min(to, begin + kPulsesTogether); ++i)
        decompose(pulses[i], selected, parts[chunk]);
    });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      const Part& part = parts[chunk];
      all += part.cloud;
      echoes_.insert(echoes_.end(), part.echoes.begin(), part.echoes.end());
      sources_.insert(sources_.end(), part.sources.begin(), part.sources.end());
    }
  }
  all.header = this->input_->header;
  all.sensor_origin_ = this->input_->sensor_origin_;
  all.sensor_orientation_ = this->input_->sensor_orientation_;
  output = std::move(all);
}

}  // namespace pcl_als
