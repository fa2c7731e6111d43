// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/survey/surveyed_file.h>

namespace pcl_als {

SurveyedFile surveyFile(const std::filesystem::path& path) {
  SurveyedFile file;
  file.sources = surveySources(path, [&file](const PointChunk& chunk) {
    for (std::size_t from = 0, to = 0; from < chunk.size(); from = to) {
      const std::uint16_t id = chunk.point_source_id[from];
      for (to = from + 1; to < chunk.size() && chunk.point_source_id[to] == id; ++to) {
      }
      file.tracks[id].add(chunk, from, to);
    }
  });
  return file;
}

}  // namespace pcl_als
