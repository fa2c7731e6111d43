// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <vector>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/processing/reference_source.h>
#include <pcl_als/processing/survey_reader.h>

namespace pcl_als {

ReferenceSource referencePoints(const std::filesystem::path& path) {
  ReferenceSource source;
  source.info = PointReader::open(path)->info();
  source.surface.name = path.filename().string();
  source.read = [path](const Eigen::AlignedBox2d& box, const ReferenceSource::Sink& sink) {
    PointWindow window;
    window.bounds = box;
    const auto reader = PointReader::open(path, window);
    const TimeAlignment none;
    PointChunk chunk;
    std::vector<LidarReturn> points;
    while (reader->read(chunk)) {
      const SurveyReader::Run run{chunk, 0, chunk.size(), none};
      points.clear();
      for (std::size_t row = 0; row < chunk.size(); ++row) {
        points.push_back(run.point(row));
        points.back().time = 0.0;  // of another survey
      }
      sink(points.data(), points.size());
    }
  };
  return source;
}

}  // namespace pcl_als
