// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/file_correction.h>

#include "simulated_survey.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using simulation::SimulatedPoint;
using Bytes = std::vector<std::byte>;

/// Two overlapping lines with crab and pitch, of which only the path is used, and their
/// quasi-rigorous calibration.
struct Survey {
  simulation::SimulationOptions options;
  std::unique_ptr<simulation::Simulator> simulator;
  std::shared_ptr<const Trajectory> flight;
  CalibrationResult calibration;
  fs::path folder;

  Survey() {
    options = simulation::SimulationOptions::preset("small");
    options.noise = simulation::NoiseOptions::named("none");
    simulator = std::make_unique<simulation::Simulator>(options);
    flight = std::make_shared<const Trajectory>(simulator->trajectory());
    folder = test::scratch("file_correction");
    calibration = test::SimulatedSurvey(options).calibrate();
  }

  /// The points of a line between two shares of its duration, as a file; \return its path.
  /// Measured \a later than it was, in seconds.
  fs::path write(std::size_t line, const std::string& name, double from = 0.0, double to = 2.0,
                 double later = 0.0) const {
    const std::vector<SimulatedPoint> points = simulator->strip(line);
    const double start = points.front().time, duration = points.back().time - start;
    PointChunk chunk;
    for (const SimulatedPoint& p : points) {
      const double share = (p.time - start) / duration;
      if (share < from || share >= to) continue;
      chunk.x.push_back(p.position.x());
      chunk.y.push_back(p.position.y());
      chunk.z.push_back(p.position.z());
      chunk.gps_time.push_back(p.time + later);
    }
    chunk.resize(chunk.x.size());
    std::fill(chunk.return_number.begin(), chunk.return_number.end(), std::uint8_t{1});
    std::fill(chunk.number_of_returns.begin(), chunk.number_of_returns.end(), std::uint8_t{1});
    LasWriterOptions las;
    las.offset = options.origin.array().floor();
    las.time_kind = TimeKind::week_seconds;
    LasWriter writer(folder / name, las);
    writer.append(chunk);
    writer.finish();
    return folder / name;
  }

  fs::path corrected(const fs::path& input, const CalibrationResult& used,
                     const std::string& name) const {
    FileCorrectionOptions correction;
    correction.keep_uncovered = true;
    correctPointFile(input, folder / name, used, flight, correction);
    return folder / name;
  }
};

const Survey& survey() {
  static const Survey survey;
  return survey;
}

Bytes recordsOf(const fs::path& path) {
  const LasFile file(path);
  Bytes records(file.header().point_count * file.header().record_length);
  file.readRecords(0, file.header().point_count, records.data());
  return records;
}

double rmsError(const fs::path& path, const std::vector<SimulatedPoint>& truth) {
  const Strip<PointLidar> strip = loadStrips({path.string()}).front();
  EXPECT_EQ(strip.cloud->size(), truth.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector3d at =
        strip.frame.origin + (*strip.cloud)[i].getVector3fMap().cast<double>();
    sum += (at - truth[i].unbiased).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

CalibrationResult withTruth(CalibrationResult calibration) {
  for (int i = 0; i < kSystemParameterCount; ++i)
    calibration.parameters[i].bias = survey().options.bias[i];
  return calibration;
}

TEST(FileCorrection, TheCalibrationHoldsTheAttitudeOfItsStrips) {
  const CalibrationResult& calibration = survey().calibration;
  ASSERT_EQ(calibration.attitude, AttitudeSource::points);
  for (std::size_t line = 0; line < survey().simulator->stripCount(); ++line) {
    for (const SimulatedPoint& p : survey().simulator->strip(line))
      ASSERT_TRUE(calibration.recovered_attitude.covers(p.time));
  }
}

TEST(FileCorrection, WholeStripsAndTilesAreEqualToTheByte) {
  const fs::path whole = survey().write(0, "whole.las");
  const fs::path first = survey().write(0, "first.las", 0.0, 0.37);
  const fs::path second = survey().write(0, "second.las", 0.37, 2.0);
  const CalibrationResult& used = survey().calibration;
  const Bytes expected = recordsOf(survey().corrected(whole, used, "whole_corrected.las"));
  Bytes parts = recordsOf(survey().corrected(first, used, "first_corrected.las"));
  const Bytes rest = recordsOf(survey().corrected(second, used, "second_corrected.las"));
  parts.insert(parts.end(), rest.begin(), rest.end());
  EXPECT_TRUE(expected != recordsOf(whole));
  EXPECT_TRUE(parts == expected);
}

TEST(FileCorrection, ACalibrationFromItsFileGivesTheSameBytes) {
  const fs::path whole = survey().write(1, "line2.las");
  const fs::path json = survey().folder / "calibration.json";
  writeCalibration(json, survey().calibration);
  EXPECT_EQ(recordsOf(survey().corrected(whole, survey().calibration, "memory.las")),
            recordsOf(survey().corrected(whole, readCalibration(json), "file.las")));
}

TEST(FileCorrection, PcdFilesEqualTheFilter) {
  const fs::path las = survey().write(0, "cloud.las");
  Strip<PointLidar> strip = loadStrips({las.string()}).front();
  savePcd(survey().folder / "cloud.pcd", strip);
  const fs::path by_file =
      survey().corrected(survey().folder / "cloud.pcd", survey().calibration, "corrected.pcd");
  SystemBiasCorrection<PointLidar> filter;
  filter.setTrajectory(survey().flight);
  filter.setCalibration(survey().calibration);
  filter.setLocalFrame(strip.frame);
  filter.setInputCloud(strip.cloud);
  pcl::PointCloud<PointLidar> corrected;
  filter.filter(corrected);
  const Strip<PointLidar> read = loadPcd(by_file);
  ASSERT_EQ(read.cloud->size(), corrected.size());
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    ASSERT_EQ((*read.cloud)[i].getVector3fMap(), corrected[i].getVector3fMap()) << i;
  }
}

// The true biases with the attitude that was recovered, against the truth. A vertical sensor would
// be wrong by what pitch and crab turn the biases by.
TEST(FileCorrection, RecoveredAttitudeIsThatOfTheFlight) {
  const fs::path input = survey().write(0, "truth.las");
  const std::vector<SimulatedPoint> truth = survey().simulator->strip(0);
  const CalibrationResult recovered = withTruth(survey().calibration);
  CalibrationResult vertical = recovered;
  vertical.attitude = AttitudeSource::none;
  const double error = rmsError(survey().corrected(input, recovered, "truth_recovered.las"), truth);
  const double plain = rmsError(survey().corrected(input, vertical, "truth_vertical.las"), truth);
  RecordProperty("rms_recovered_mm", std::to_string(1e3 * error));
  RecordProperty("rms_vertical_mm", std::to_string(1e3 * plain));
  EXPECT_LT(error, 0.5 * plain);
}

TEST(FileCorrection, WhereTheCalibrationHoldsNoneItIsRecoveredFromTheFile) {
  const fs::path input = survey().write(0, "other.las");
  CalibrationResult earlier = survey().calibration;
  earlier.recovered_attitude = RecoveredAttitude();
  FileCorrectionOptions options;
  options.keep_uncovered = true;
  const FileCorrectionResult result =
      correctPointFile(input, survey().folder / "earlier.las", earlier, survey().flight, options);
  EXPECT_NE(result.attitude_remark.find("pitch"), std::string::npos);
  EXPECT_EQ(result.coverage.without_attitude, 0U);
  // A calibration that holds another line's attitude recovers it for this one.
  CalibrationResult partial = survey().calibration;
  partial.recovered_attitude = RecoveredAttitude();
  partial.recovered_attitude.addPass({{survey().flight->startTime() - 50.0, {}}});
  const FileCorrectionResult other =
      correctPointFile(input, survey().folder / "partial.las", partial, survey().flight, options);
  EXPECT_EQ(other.coverage.without_attitude, 0U);
  EXPECT_EQ(recordsOf(survey().folder / "partial.las"), recordsOf(survey().folder / "earlier.las"));
}

// Two hours later the same flight is another one, to which the part of the instrument applies.
TEST(FileCorrection, ACalibrationOfAnotherFlightIsAppliedByItsInstrumentPart) {
  constexpr double kLater = 7200.0;
  const CalibrationResult& calibration = survey().calibration;
  std::vector<TrajectorySample> samples = survey().simulator->trajectory();
  for (TrajectorySample& sample : samples) sample.time += kLater;
  const auto flight = std::make_shared<const Trajectory>(samples);
  const fs::path input = survey().write(0, "flight2.las", 0.0, 2.0, kLater);
  const auto corrected = [&](const CalibrationResult& used, const std::string& name,
                             FileCorrectionOptions options = {}) {
    options.keep_uncovered = true;
    return correctPointFile(input, survey().folder / name, used, flight, options);
  };
  const FileCorrectionResult result = corrected(calibration, "by_all.las");
  EXPECT_NE(result.flight_remark.find("another flight"), std::string::npos);
  EXPECT_EQ(std::count(result.remarks.begin(), result.remarks.end(), result.flight_remark), 1);
  EXPECT_NE(result.attitude_remark.find("pitch"), std::string::npos);
  EXPECT_EQ(corrected(instrumentOf(calibration), "by_instrument.las").flight_remark, "");
  const Bytes by_all = recordsOf(survey().folder / "by_all.las");
  EXPECT_EQ(by_all, recordsOf(survey().folder / "by_instrument.las"));
  EXPECT_NE(by_all, recordsOf(input));

  FileCorrectionOptions strips;
  strips.strip_corrections = true;
  EXPECT_THROW(corrected(calibration, "refused.las", strips), InputError);
  EXPECT_FALSE(fs::exists(survey().folder / "refused.las"));
  strips.force = true;
  EXPECT_FALSE(corrected(calibration, "forced.las", strips).warnings.empty());
  EXPECT_EQ(by_all, recordsOf(survey().folder / "forced.las"));
  // Of its own flight nothing is omitted.
  EXPECT_EQ(correctPointFile(survey().write(0, "flight1.las"), survey().folder / "own.las",
                             calibration, survey().flight)
                .flight_remark,
            "");
}

TEST(FileCorrection, TheFilterRefusesACalibrationThatLacksTheAttitude) {
  const fs::path las = survey().write(0, "lacking.las");
  const Strip<PointLidar> strip = loadStrips({las.string()}).front();
  SystemBiasCorrection<PointLidar> filter;
  filter.setTrajectory(survey().flight);
  filter.setLocalFrame(strip.frame);
  filter.setInputCloud(strip.cloud);
  CalibrationResult lacking = survey().calibration;
  lacking.recovered_attitude = RecoveredAttitude();
  pcl::PointCloud<PointLidar> corrected;
  filter.setCalibration(lacking);
  EXPECT_THROW(filter.filter(corrected), InputError);
  // Of another flight: named as points, not corrected without a word.
  lacking.recovered_attitude.addPass({{survey().flight->startTime() - 50.0, {}}});
  filter.setCalibration(lacking);
  EXPECT_THROW(filter.filter(corrected), InputError);
  EXPECT_EQ(filter.getCoverage().without_attitude, strip.cloud->size());
  // The attitude of the trajectory, where the calibration was estimated with it.
  lacking.attitude = AttitudeSource::trajectory;
  filter.setCalibration(lacking);
  EXPECT_THROW(filter.filter(corrected), InputError);
}

TEST(FileCorrection, CancellationLeavesNoFile) {
  const fs::path input = survey().write(0, "cancelled.las");
  const fs::path output = survey().folder / "never.las";
  EXPECT_THROW(correctPointFile(input, output, survey().calibration, survey().flight, {},
                                [](const JobProgress& p) { return p.fraction < 0.2; }),
               Cancelled);
  EXPECT_FALSE(fs::exists(output));
}

}  // namespace
}  // namespace pcl_als
