// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <pcl_als/common/communicator.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/survey/survey_input.h>
#include <pcl_als/survey/swath_track.h>

namespace pcl_als {

/// Result of a first reading of a point file or cloud: its point source ids, with times and
/// positions.
struct SurveyedFile {
  PointFileSources sources;
  /// by point source id, in the time system of the file
  std::map<std::uint16_t, SwathTrack> tracks;
  /// channels of the scanner, by point source id
  std::map<std::uint16_t, std::set<std::uint8_t>> channels;
  std::string strip;  ///< strip of all its points; empty: strips are named by StripNaming
};

/// What StripAssignment needs of a file where strips are not divided.
SurveyedFile withoutTracks(const PointFileSources& sources);

/// Reads a file once; memory: see SwathTrack. InputError for a file that cannot be read.
SurveyedFile surveyFile(const std::filesystem::path& path);
SurveyedFile surveyFile(const SurveyInput& input);
/// Collective: \a processes (null: one) share the files, and each receives all results.
std::vector<SurveyedFile> surveyFiles(const std::vector<SurveyInput>& inputs, int threads,
                                      Communicator* processes);

/// Times that go on where a flight passed the end of a GPS week: of each file, seconds of the week
/// after it as seconds beyond 604800. For jobs without a trajectory.
std::vector<TimeAlignment> continuousTimes(const std::vector<SurveyedFile>& files);

}  // namespace pcl_als
