// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include <pcl_als/io/strip_naming.h>
#include <pcl_als/survey/swath_track.h>

namespace pcl_als {

/// What a first reading of a point file tells: its point source ids, and when and where each flew.
struct SurveyedFile {
  PointFileSources sources;
  std::map<std::uint16_t, SwathTrack> tracks;  ///< by point source id, on the file's clock
};

/// Reads a file once; memory as SwathTrack says. InputError for a file that cannot be read.
SurveyedFile surveyFile(const std::filesystem::path& path);

}  // namespace pcl_als
