// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Runs the built tool on files: PCL_ALS_APPLY is its path.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <pcl_als/common/statistics.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>

#include "real_data.h"
#include "swath.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::kOrigin;

constexpr double kWeekStart = 2139 * 604800.0 - 1e9;  // adjusted standard time
constexpr double kFlightStart = 230000.0;             // seconds of that week
constexpr const char* kBiases =
    "boresight_roll=90,boresight_pitch=30,boresight_heading=-40,range_bias=-0.12,"
    "scan_angle_scale=1e-4,lever_arm_x=0.05";

/// A folder with a trajectory of 20 s and a strip of 30,000 points under it; runs the tool there.
class Flight {
 public:
  explicit Flight(const std::string& name, double time_of_week_start = 0.0)
      : folder_(test::scratch("apply_" + name)) {
    writeTrajectory();
    writeStrip(time_of_week_start);
  }

  std::filesystem::path path(const std::string& file) const { return folder_ / file; }
  /// Exit status; standard error is in message().
  int run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() + "' && '" PCL_ALS_APPLY "' " +
                                arguments + " >out.txt 2>error.txt";
    const int status = std::system(command.c_str());  // NOLINT: the test's own command
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string bytes(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(path(file), std::ios::binary).rdbuf();
    return text.str();
  }
  std::string message() const { return bytes("error.txt"); }

 private:
  void writeTrajectory() const {
    std::ofstream csv(path("trajectory.csv"));
    csv << "time,x,y,z\n" << std::setprecision(17);
    for (int i = 0; i <= 2000; ++i) {
      const double t = 0.01 * i;
      csv << kFlightStart + t << ',' << kOrigin.x() + 20.0 * std::sin(0.1 * t) << ','
          << kOrigin.y() + 60.0 * t << ',' << kOrigin.z() + 1000.0 << '\n';
    }
  }
  void writeStrip(double time_of_week_start) const {
    const auto points = test::swath(kOrigin, 20.0, 30000);
    PointChunk chunk;
    chunk.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      chunk.x[i] = points[i].ground.x(), chunk.y[i] = points[i].ground.y();
      chunk.z[i] = points[i].ground.z();
      chunk.gps_time[i] = time_of_week_start + kFlightStart + points[i].time;
      chunk.return_number[i] = chunk.number_of_returns[i] = 1;
    }
    LasWriterOptions options;
    options.offset = kOrigin;
    options.time_kind =
        time_of_week_start == 0.0 ? TimeKind::week_seconds : TimeKind::adjusted_standard;
    LasWriter writer(path("strip.las"), options);
    writer.append(chunk);
    writer.finish();
  }

  std::filesystem::path folder_;
};

/// Largest difference of an integer coordinate of two files.
int largestStep(const std::filesystem::path& a, const std::filesystem::path& b) {
  const LasFile first(a), second(b);
  const auto count = static_cast<std::size_t>(first.header().point_count);
  const std::size_t length = first.header().record_length;
  EXPECT_EQ(second.header().point_count, count);
  std::vector<std::byte> p(count * length), q(count * length);
  first.readRecords(0, count, p.data());
  second.readRecords(0, count, q.data());
  int largest = 0;
  for (std::size_t i = 0; i < count * length; i += length) {
    for (std::size_t axis = 0; axis < 12; axis += 4) {
      const int step = loadLas<std::int32_t>(&p[i + axis]) - loadLas<std::int32_t>(&q[i + axis]);
      largest = std::max(largest, std::abs(step));
    }
  }
  return largest;
}

/// Mean over control points of the mean height of ground points within 2 m of them minus theirs.
RunningStatistics aboveControl(const std::filesystem::path& las,
                               const std::vector<ControlPoint>& control) {
  std::vector<RunningStatistics> near(control.size());
  const auto reader = PointReader::open(las);
  for (PointChunk chunk; reader->read(chunk);) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      if (chunk.classification[i] != 2) continue;
      for (std::size_t k = 0; k < control.size(); ++k) {
        const double east = chunk.x[i] - control[k].position.x();
        if (std::abs(east) > 2.0) continue;
        if (std::hypot(east, chunk.y[i] - control[k].position.y()) > 2.0) continue;
        near[k].add(chunk.z[i] - control[k].position.z());
      }
    }
  }
  RunningStatistics all;
  for (const RunningStatistics& point : near) {
    if (point.count() > 0) all.add(point.mean());
  }
  return all;
}

TEST(ApplyTool, AnIndependentSimulatorsErrorsAreTakenOut) {
  // The HELIOS strip: ray casting with its own chain of rotations, truth in truth.json.
  const auto strip = test::unpacked("helios/strip1.las.xz");
  const auto trajectory = test::testData("helios/trajectory.csv");
  const auto control_file = test::testData("helios/control.csv");
  PCL_ALS_REQUIRE_DATA(strip && trajectory && control_file);
  Flight flight("helios");
  const auto control = readControl(*control_file);
  ASSERT_EQ(
      flight.run("'" + strip->string() + "' corrected.las -trajectory '" + trajectory->string() +
                 "' -bias boresight_pitch=30,boresight_roll=90,boresight_heading=-40,"
                 "range_bias=-0.12"),
      0)
      << flight.message();
  const RunningStatistics before = aboveControl(*strip, control);
  const RunningStatistics after = aboveControl(flight.path("corrected.las"), control);
  ASSERT_GT(after.count(), 30U);
  EXPECT_GT(before.mean(), 0.1);
  EXPECT_GT(before.standardDeviation(), 0.1);
  // Range errors of waveform peaks, -2 to 8 mm on level ground, and 2 cm noise over some ten
  // points.
  EXPECT_LT(std::abs(after.mean()), 0.01);
  EXPECT_LT(after.standardDeviation(), 0.03);
}

TEST(ApplyTool, TilesOfRealStripsKeepTheirBytesAndReturnWithinOneUnit) {
  const auto tile = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  const auto trajectory = test::testData("delft_ahn3/trajectory.csv");
  PCL_ALS_REQUIRE_DATA(tile && trajectory);
  Flight flight("delft");
  const std::string with = " -trajectory '" + trajectory->string() + "' -bias ";
  const std::string in = "'" + tile->string() + "' ";
  ASSERT_EQ(flight.run(in + "same.las" + with + "boresight_roll=0"), 0) << flight.message();
  std::filesystem::copy_file(*tile, flight.path("tile.las"));
  EXPECT_EQ(flight.bytes("tile.las"), flight.bytes("same.las"));
  const std::string biases = "boresight_roll=60,boresight_pitch=-40,boresight_heading=90";
  ASSERT_EQ(flight.run(in + "biased.las -invert" + with + biases), 0) << flight.message();
  ASSERT_EQ(flight.run("biased.las back.las" + with + biases), 0) << flight.message();
  EXPECT_GT(largestStep(*tile, flight.path("biased.las")), 100);
  EXPECT_LE(largestStep(*tile, flight.path("back.las")), 1);
}

TEST(ApplyTool, AnSbetIsProjectedToTheCrsOfThePoints) {
  const auto points = test::testData("leeward_sbet/points.las");
  const auto sbet = test::testData("leeward_sbet/sbet.out");
  PCL_ALS_REQUIRE_DATA(points && sbet);
  Flight flight("sbet");
  const int status = flight.run("'" + points->string() + "' out.las -trajectory '" +
                                sbet->string() + "' -bias range_bias=0 -crs EPSG:32611");
  if (flight.message().find("needs PROJ") != std::string::npos) {
    GTEST_SKIP() << "built without PROJ";
  }
  EXPECT_EQ(status, 0) << flight.message();
  EXPECT_NE(flight.bytes("out.txt").find("1 325 points"), std::string::npos);
}

TEST(ApplyTool, ZeroBiasesGiveTheSameFileByteForByte) {
  Flight flight("zero");
  ASSERT_EQ(flight.run("strip.las out.las -trajectory trajectory.csv -bias range_bias=0"), 0)
      << flight.message();
  EXPECT_EQ(flight.bytes("strip.las"), flight.bytes("out.las"));
}

TEST(ApplyTool, InvertAfterApplyReturnsWithinOneUnit) {
  Flight flight("invert");
  const std::string biases = std::string(" -trajectory trajectory.csv -bias ") + kBiases;
  ASSERT_EQ(flight.run("strip.las out.las" + biases), 0) << flight.message();
  ASSERT_EQ(flight.run("out.las back.las -invert" + biases), 0) << flight.message();
  EXPECT_GT(largestStep(flight.path("strip.las"), flight.path("out.las")), 100);
  EXPECT_LE(largestStep(flight.path("strip.las"), flight.path("back.las")), 1);
}

TEST(ApplyTool, ThreadsChangeNoByte) {
  Flight flight("threads");
  const std::string rest = std::string(" -trajectory trajectory.csv -bias ") + kBiases;
  ASSERT_EQ(flight.run("strip.las one.las -threads 1" + rest), 0) << flight.message();
  ASSERT_EQ(flight.run("strip.las four.las -threads 4" + rest), 0) << flight.message();
  EXPECT_EQ(flight.bytes("one.las"), flight.bytes("four.las"));
}

TEST(ApplyTool, AdjustedTimesMatchAWeekSecondsTrajectory) {
  Flight week("week"), adjusted("adjusted", kWeekStart);
  const std::string run =
      std::string("strip.las out.las -trajectory trajectory.csv -bias ") + kBiases;
  ASSERT_EQ(week.run(run), 0) << week.message();
  ASSERT_EQ(adjusted.run(run), 0) << adjusted.message();
  EXPECT_NE(adjusted.bytes("out.txt").find("GPS week 2139"), std::string::npos);
  // Times of 3e8 s are rounded to 6e-8 s, 4e-6 m of flight: a unit now and then.
  EXPECT_LE(largestStep(week.path("out.las"), adjusted.path("out.las")), 1);
  EXPECT_EQ(adjusted.run(run + " -gps_week 2138"), 2);
  EXPECT_NE(adjusted.message().find("do not overlap"), std::string::npos) << adjusted.message();
}

TEST(ApplyTool, ACalibrationFileAndAPcdGiveTheSameCorrection) {
  Flight flight("pcd");
  CalibrationResult calibration;
  calibration[SystemParameter::boresight_roll].bias = 90.0 * kRadiansPerArcsec;
  calibration.converged = true;
  writeCalibration(flight.path("calibration.json"), calibration);
  Strip<PointLidar> strip;
  strip.id = "7";
  strip.frame = LocalFrame::around(kOrigin);
  for (const test::SwathPoint& point : test::swath(kOrigin, 20.0, 30000)) {
    PointLidar lidar;
    lidar.getVector3fMap() = strip.frame.toLocal(point.ground);
    lidar.gps_time = kFlightStart + point.time;
    strip.cloud->push_back(lidar);
  }
  savePcd(flight.path("strip.pcd"), strip);
  const std::string rest = " -trajectory trajectory.csv -calibration calibration.json";
  ASSERT_EQ(flight.run("strip.pcd out.pcd" + rest), 0) << flight.message();
  ASSERT_EQ(flight.run("strip.las out.las" + rest), 0) << flight.message();
  const Strip<PointLidar> corrected = loadPcd(flight.path("out.pcd"));
  const LasFile las(flight.path("out.las"));
  std::vector<std::byte> record(las.header().record_length);
  las.readRecords(12345, 1, record.data());
  const Eigen::Vector3d found =
      corrected.frame.toGround((*corrected.cloud)[12345].getVector3fMap());
  for (int axis = 0; axis < 3; ++axis) {
    const double expected =
        loadLas<std::int32_t>(&record[4 * static_cast<std::size_t>(axis)]) * 0.001 + kOrigin[axis];
    EXPECT_NEAR(found[axis], expected, 0.0012);  // a unit of 1 mm twice halved, a float's 6e-5 m
  }
}

TEST(ApplyTool, ACalibrationWithAnAdverseVerdictNeedsForce) {
  Flight flight("verdict");
  CalibrationResult calibration;
  calibration[SystemParameter::boresight_roll].bias = 90.0 * kRadiansPerArcsec;
  calibration.verdict.downgrade(CalibrationStatus::not_converged, "it did not converge");
  writeCalibration(flight.path("calibration.json"), calibration);
  const std::string arguments =
      "strip.las out.las -trajectory trajectory.csv -calibration calibration.json";
  EXPECT_EQ(flight.run(arguments), 2);
  EXPECT_EQ(flight.message(),
            "pcl_als_apply: calibration.json: this calibration should not be applied, not "
            "converged: it did not converge; -force applies it all the same\n");
  EXPECT_FALSE(std::filesystem::exists(flight.path("out.las")));
  EXPECT_EQ(flight.run(arguments + " -force"), 0);
  EXPECT_NE(flight.message().find("warning: calibration.json: not converged"), std::string::npos)
      << flight.message();
  EXPECT_GT(largestStep(flight.path("strip.las"), flight.path("out.las")), 100);
}

TEST(ApplyTool, PointsOutsideTheTrajectoryAreRefusedOrKept) {
  Flight flight("uncovered");
  // Half of the flight.
  const std::string all = flight.bytes("trajectory.csv");
  std::ofstream(flight.path("half.csv")) << all.substr(0, all.find("230010,"));
  const std::string run = std::string("strip.las out.las -trajectory half.csv -bias ") + kBiases;
  EXPECT_EQ(flight.run(run), 2);
  EXPECT_NE(flight.message().find("of 30000 points have no trajectory"), std::string::npos)
      << flight.message();
  EXPECT_FALSE(std::filesystem::exists(flight.path("out.las")));
  EXPECT_EQ(flight.run(run + " -keep_uncovered"), 0) << flight.message();
  EXPECT_NE(flight.bytes("out.txt").find("left as they are"), std::string::npos);
}

TEST(ApplyTool, WrongUsageAndUnusableInputHaveTheirStatus) {
  Flight flight("errors");
  const std::string with = std::string(" -trajectory trajectory.csv -bias ") + kBiases;
  const struct {
    std::string arguments;
    int status;
    const char* message;
  } cases[] = {
      {"strip.las" + with, 1, "IN OUT"},
      {"strip.las strip.las" + with, 1, "also an input"},
      {"strip.las out.pcd" + with, 1, "one kind"},
      {"strip.las out.las -trajectory trajectory.csv", 1, "-calibration"},
      {"strip.las out.las -trajectory trajectory.csv -bias roll=3", 1, "'roll'"},
      {"strip.las out.las -trajectory trajectory.csv -bias range_bias=x", 1, "'x'"},
      {"strip.las out.las -trajectory trajectory.csv -bias range_bias=1e9", 1, "range_bias"},
      {"strip.las out.las -bias range_bias=1", 1, "-trajectory"},
      {"strip.las out.las -nonsense" + with, 1, "nonsense"},
      {"strip.las out.las -gps_week 1.5" + with, 1, "-gps_week"},
      {"none.las out.las" + with, 2, "none.las"},
      {"strip.las none/out.las" + with, 2, "none"},
      {"strip.las out.las -trajectory none.csv -bias range_bias=1", 2, "none.csv"},
      {"strip.las out.las -trajectory trajectory.csv -calibration none.json", 2, "none.json"},
  };
  for (const auto& row : cases) {
    EXPECT_EQ(flight.run(row.arguments), row.status) << row.arguments << '\n' << flight.message();
    EXPECT_NE(flight.message().find(row.message), std::string::npos) << row.arguments << '\n'
                                                                     << flight.message();
  }
}

}  // namespace
}  // namespace pcl_als
