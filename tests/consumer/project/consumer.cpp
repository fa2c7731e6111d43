// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Uses classes of several installed modules; ends with 0 if their answers are right.
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/filters/intensity_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/radiometry/atmosphere.h>
#include <pcl_als/tin/tin.h>
#include <pcl_als/trajectory/trajectory.h>

int main(int argc, char** argv) {
  if (argc != 3) return 1;
  const auto reader = pcl_als::PointReader::open(argv[1]);
  const pcl_als::Trajectory trajectory(pcl_als::readTrajectory(argv[2]));
  pcl_als::PointChunk chunk;
  std::size_t points = 0, covered = 0;
  while (reader->read(chunk)) {
    points += chunk.size();
    for (const double time : chunk.gps_time)
      covered += trajectory.coverage(time) == pcl_als::Trajectory::Coverage::covered;
  }
  // Kim et al. 2001 at 10 km: 0.166 per km of aerosol, 8e-4 of the air itself.
  pcl_als::Atmosphere air;
  air.visibility_km = 10.0;
  const double extinction = pcl_als::extinctionOf(air).total();
  const pcl_als::Tin tin({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  pcl_als::ConfusionMatrix matrix({"tree", "grass"});
  matrix.counts << 3, 1, 0, 4;
  if (pcl_als::assessAccuracy(matrix).kappa != 0.75) return 1;
  std::cout << points << " points, " << covered << " covered, " << tin.triangles().size()
            << " triangles, extinction " << extinction << " per km\n";
  return points == reader->info().point_count && covered == points && tin.triangles().size() == 2 &&
                 std::abs(extinction - 0.167) < 0.001 && pcl_als::swathQualityLevel(0.05) == 1
             ? 0
             : 1;
}
