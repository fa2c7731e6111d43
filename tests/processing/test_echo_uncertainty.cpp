// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/file_correction.h>

#include "decomposed_file.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A level flight to the north, 1000 m above a line of points at its nadir.
class UncertaintyOfEchoes : public testing::Test {
 protected:
  UncertaintyOfEchoes() : folder(test::scratch("echo_uncertainty")) {
    std::vector<TrajectorySample> samples(301);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i].time = 1000.0 + 0.1 * static_cast<double>(i);
      samples[i].position = {5000.0, 60.0 * (samples[i].time - 1000.0), 1000.0};
      samples[i].roll = samples[i].pitch = samples[i].heading = 0.0;
    }
    flight = std::make_shared<const Trajectory>(samples);
    calibration.error_levels = ErrorLevels{0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    options.uncertainty = options.force = true;
  }

  /// sigma_vertical of points whose records have a range_std, if \a field.
  std::vector<double> sigmaOf(const std::vector<double>& range_std, bool field) {
    PointChunk points;
    points.resize(range_std.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      points.gps_time[i] = 1010.0 + 0.1 * static_cast<double>(i);
      points.x[i] = 5000.0;
      points.y[i] = 60.0 * (points.gps_time[i] - 1000.0);
      points.point_source_id[i] = 7;
      points.return_number[i] = points.number_of_returns[i] = 1;
    }
    LasWriterOptions writing;
    writing.point_format = 6;
    writing.scale.setConstant(0.001);
    writing.time_kind = TimeKind::week_seconds;
    if (field) {
      LasExtraField extra;
      extra.name = "range_std";
      extra.type = LasExtraType::f32;
      writing.extra_fields = {extra};
    }
    LasWriter writer(folder / "in.las", writing);
    if (field)
      writer.append(points, {range_std});
    else
      writer.append(points);
    writer.finish();
    correctPointFile(folder / "in.las", folder / "out.las", calibration, flight, options);
    return test::DecomposedFile(folder / "out.las").column("sigma_vertical");
  }

  fs::path folder;
  std::shared_ptr<const Trajectory> flight;
  CalibrationResult calibration;
  FileCorrectionOptions options;
};

TEST_F(UncertaintyOfEchoes, IsThatOfTheirRangesWhereItExceedsTheLevel) {
  const std::vector<double> range_std{0.05, 0.005, kNone, 0.1};
  const std::vector<double> with = sigmaOf(range_std, true);
  ASSERT_EQ(with.size(), 4U);
  EXPECT_NEAR(with[0], 0.05, 1e-6);
  EXPECT_NEAR(with[1], 0.02, 1e-6);
  EXPECT_NEAR(with[2], 0.02, 1e-6);
  EXPECT_NEAR(with[3], 0.1, 1e-6);
  for (const double sigma : sigmaOf(range_std, false)) EXPECT_NEAR(sigma, 0.02, 1e-6);
}

}  // namespace
}  // namespace pcl_als
