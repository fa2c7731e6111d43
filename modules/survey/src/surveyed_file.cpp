// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/io/time_scale.h>
#include <pcl_als/survey/survey_messages.h>
#include <pcl_als/survey/surveyed_file.h>

namespace pcl_als {
namespace {

/// The version of a file when it was opened first; later readings must find the same.
class FirstVersion {
 public:
  void check(const PointFileInfo& info) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!version_) version_ = info.version;
    if (*version_ != info.version) refuseChangedFile(info.path.string());
  }

 private:
  std::mutex mutex_;
  std::optional<FileVersion> version_;
};

}  // namespace

SurveyInput SurveyInput::ofFile(const std::filesystem::path& path, const PointWindow& window) {
  SurveyInput input;
  input.path = path;
  input.open = [path, window,
                first = std::make_shared<FirstVersion>()](const std::string& extra_field) {
    PointWindow read = window;
    read.extra_field = extra_field;
    auto reader = PointReader::open(path, read);
    first->check(reader->info());
    return reader;
  };
  return input;
}

std::vector<TimeAlignment> continuousTimes(const std::vector<SurveyedFile>& files) {
  std::vector<TimeRange> observed;
  for (const SurveyedFile& file : files)
    for (const auto& track : file.tracks)
      for (const auto& entry : track.second.bins())
        observed.push_back({entry.second.first, entry.second.last});
  TimeAlignment alignment;
  if (const auto rollover = weekRollover(std::move(observed))) alignment.wrap_below = *rollover;
  return std::vector<TimeAlignment>(files.size(), alignment);
}

SurveyedFile withoutTracks(const PointFileSources& sources) {
  SurveyedFile file{sources, {}, {}, {}};
  for (const PointSource& source : sources.sources) file.tracks[source.id];
  return file;
}

SurveyedFile surveyFile(const std::filesystem::path& path) {
  return surveyFile(SurveyInput::ofFile(path));
}

SurveyedFile surveyFile(const SurveyInput& input) {
  SurveyedFile file;
  file.strip = input.strip;
  file.sources = surveySources(*input.open({}), [&file](const PointChunk& chunk) {
    for (std::size_t from = 0, to = 0; from < chunk.size(); from = to) {
      const std::uint16_t id = chunk.point_source_id[from];
      for (to = from + 1; to < chunk.size() && chunk.point_source_id[to] == id; ++to) {
      }
      file.tracks[id].add(chunk, from, to);
      std::array<bool, 256> present{};
      for (std::size_t i = from; i < to; ++i) present[chunk.channel[i]] = true;
      for (std::size_t i = 0; i < present.size(); ++i)
        if (present[i]) file.channels[id].insert(static_cast<std::uint8_t>(i));
    }
  });
  return file;
}

std::vector<SurveyedFile> surveyFiles(const std::vector<SurveyInput>& inputs, int threads,
                                      Communicator* processes) {
  std::vector<double> costs;
  for (const SurveyInput& input : inputs) costs.push_back(detail::readingCost(input.path));
  const SharedItems shares(processes, costs);
  std::vector<SurveyedFile> files(inputs.size());
  doTogether(processes, [&] {
    parallelFor(shares.ownItems().size(), threads, [&](std::size_t i) {
      const std::size_t file = shares.ownItems()[i];
      files[file] = surveyFile(inputs[file]);
    });
  });
  shareValues(
      processes, shares, files,
      [](ByteWriter& out, const SurveyedFile& file) { detail::put(out, file); },
      [](ByteReader& in, SurveyedFile& file) { detail::get(in, file); });
  return files;
}

}  // namespace pcl_als
