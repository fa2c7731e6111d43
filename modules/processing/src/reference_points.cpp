// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <vector>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/processing/reference_source.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

ReferenceSource referencePoints(const std::filesystem::path& path) {
  ReferenceSource source;
  source.info = PointReader::open(path)->info();
  source.surface.name = path.filename().string();
  source.read = [info = source.info](const Eigen::AlignedBox2d& box,
                                     const ReferenceSource::Sink& sink) {
    PointWindow window;
    window.bounds = box;
    const auto pass = [&sink](const SurveyReader::Run& run) {
      std::vector<LidarReturn> points;
      run.points(points);
      for (LidarReturn& point : points) point.time = 0.0;  // of another survey
      sink(points.data(), points.size());
    };
    SurveyReader::ofWholeFiles({info}, 1, window).read(pass);
  };
  return source;
}

}  // namespace pcl_als
