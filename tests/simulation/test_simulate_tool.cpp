// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// pcl_als_simulate as a user runs it; what it writes is read back with module io.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>

#include "file_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::readBytes;
namespace fs = std::filesystem;

struct ToolRun {
  int status = -1;
  std::string output;
};

ToolRun simulate(const std::string& arguments) {
  const std::string command = std::string(PCL_ALS_SIMULATE) + " " + arguments + " 2>&1";
  ToolRun run;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return run;
  char buffer[512];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    run.output.append(buffer, n);
  run.status = WEXITSTATUS(pclose(pipe));
  return run;
}

/// A block that takes a tenth of a second.
ToolRun tiny(const fs::path& folder, const std::string& more = {}) {
  return simulate("-output " + folder.string() + " -preset small -scale 0.3 -density 0.1 " + more);
}

/// A file without the header of LAS, which holds the day it was made.
std::string pointsOf(const fs::path& path) {
  return readBytes(path).substr(375);
}

PointChunk allPoints(const fs::path& path) {
  PointChunk chunk;
  EXPECT_TRUE(PointReader::open(path)->read(chunk));
  return chunk;
}

std::vector<double> extraColumn(const LasFile& file, const std::string& name) {
  std::vector<double> values;
  const auto length = file.header().record_length;
  std::vector<std::byte> records(file.header().point_count * length);
  file.readRecords(0, file.header().point_count, records.data());
  for (const LasExtraField& field : file.extraFields())
    if (field.name == name)
      decodeLasExtraField(records.data(), file.header().point_count, length, field, values);
  return values;
}

TEST(SimulateTool, WritesWhatItPromises) {
  const fs::path folder = test::scratch("tool") / "made" / "by_the_tool";
  const ToolRun run = tiny(folder, "-noise realistic");
  ASSERT_EQ(run.status, 0) << run.output;
  for (const char* name : {"strip1.las", "strip5.las", "trajectory.csv", "control.csv",
                           "training.csv", "checkpoints.csv", "truth.json"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_NE(run.output.find("strip3.las"), std::string::npos);
  const LasFile file(folder / "strip2.las");
  EXPECT_EQ(file.header().describe(), "LAS 1.4, point format 6");
  EXPECT_EQ(file.info().time_kind, TimeKind::week_seconds);
  EXPECT_EQ(file.header().file_source_id, 2);
  EXPECT_NE(file.crs().find("32611"), std::string::npos);
}

TEST(SimulateTool, PointsLieWithinTheTrajectoryAndKeepTheirFields) {
  const fs::path folder = test::scratch("tool_fields");
  ASSERT_EQ(tiny(folder).status, 0);
  const auto trajectory = readTrajectory(folder / "trajectory.csv");
  ASSERT_GT(trajectory.size(), 1000U);
  EXPECT_TRUE(trajectory.front().hasAttitude());
  const PointChunk points = allPoints(folder / "strip3.las");
  ASSERT_GT(points.size(), 2000U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_GT(points.gps_time[i], trajectory.front().time);
    ASSERT_LT(points.gps_time[i], trajectory.back().time);
    ASSERT_EQ(points.point_source_id[i], 3);
    ASSERT_GT(points.intensity[i], 0.0F);
    ASSERT_LE(std::abs(points.scan_angle[i]), 21.0F);
  }
  EXPECT_EQ(readControl(folder / "control.csv").size(), 37U);
  for (const double reflectance : extraColumn(LasFile(folder / "strip3.las"), "reflectance")) {
    ASSERT_GT(reflectance, 0.02);
    ASSERT_LT(reflectance, 0.9);
  }
}

TEST(SimulateTool, SameSeedSameBytesForAnyThreads) {
  const fs::path one = test::scratch("tool_one"), two = test::scratch("tool_two");
  ASSERT_EQ(tiny(one, "-noise realistic -seed 7 -threads 1").status, 0);
  ASSERT_EQ(tiny(two, "-noise realistic -seed 7 -threads 2 --quiet").status, 0);
  EXPECT_EQ(pointsOf(one / "strip4.las"), pointsOf(two / "strip4.las"));
  EXPECT_EQ(readBytes(one / "truth.json"), readBytes(two / "truth.json"));
  EXPECT_EQ(readBytes(one / "trajectory.csv"), readBytes(two / "trajectory.csv"));
  ASSERT_EQ(tiny(two, "-noise realistic -seed 8").status, 0);
  EXPECT_NE(pointsOf(one / "strip4.las"), pointsOf(two / "strip4.las"));
}

TEST(SimulateTool, BiasColumnsTakeTheBiasesOut) {
  // Millimetre coordinates less the columns equal the run without biases.
  const fs::path with = test::scratch("tool_with"), without = test::scratch("tool_without");
  ASSERT_EQ(tiny(with, "-noise range -truth_points").status, 0);
  ASSERT_EQ(tiny(without, "-noise range -bias none").status, 0);
  const PointChunk biased = allPoints(with / "strip1.las");
  const PointChunk exact = allPoints(without / "strip1.las");
  const auto bias = extraColumn(LasFile(with / "strip1.las"), "bias_x");
  ASSERT_EQ(biased.size(), exact.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    // Half a millimetre of each file and half of 0.1 mm of the column.
    ASSERT_NEAR(biased.x[i] - bias[i], exact.x[i], 0.00106);
    largest = std::max(largest, std::abs(bias[i]));
  }
  EXPECT_GT(largest, 0.3);  // 90 arcsec at 1150 m are 0.5 m
}

TEST(SimulateTool, ErrorColumnsLeadToTheSurface) {
  // Millimetre coordinates less the columns equal the run without biases and without noise.
  const fs::path with = test::scratch("tool_erring"), without = test::scratch("tool_exact");
  ASSERT_EQ(tiny(with, "-noise range -ins mems -truth_points -true_surface").status, 0);
  ASSERT_EQ(tiny(without, "-noise none -bias none").status, 0);
  const PointChunk wrong = allPoints(with / "strip1.las"),
                   exact = allPoints(without / "strip1.las");
  const auto error = extraColumn(LasFile(with / "strip1.las"), "error_y");
  const auto bias = extraColumn(LasFile(with / "strip1.las"), "bias_y");
  ASSERT_EQ(wrong.size(), exact.size());
  double rest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_NEAR(wrong.y[i] - error[i], exact.y[i], 0.00106);
    rest = std::max(rest, std::abs(error[i] - bias[i]));
  }
  EXPECT_GT(rest, 0.05) << "errors of the trajectory: 4 cm, 90 arcsec at 1150 m";
}

TEST(SimulateTool, AdjustedTimeIsFlaggedAndShifted) {
  const fs::path week = test::scratch("tool_week"), adjusted = test::scratch("tool_adjusted");
  ASSERT_EQ(tiny(week).status, 0);
  ASSERT_EQ(tiny(adjusted, "-time adjusted").status, 0);
  EXPECT_EQ(LasFile(adjusted / "strip1.las").info().time_kind, TimeKind::adjusted_standard);
  const double shift = 1540.0 * 604800.0 - 1e9;
  const PointChunk a = allPoints(week / "strip1.las"), b = allPoints(adjusted / "strip1.las");
  EXPECT_NEAR(b.gps_time[10] - a.gps_time[10], shift, 1e-7);  // a step of double at 7e7 s
  EXPECT_EQ(readBytes(week / "trajectory.csv"), readBytes(adjusted / "trajectory.csv"));
}

TEST(SimulateTool, TruthStatesBiasesAndPairs) {
  const fs::path folder = test::scratch("tool_truth");
  ASSERT_EQ(tiny(folder, "-bias boresight_roll=60,range_bias=0.25").status, 0);
  const std::string truth = readBytes(folder / "truth.json");
  EXPECT_NE(truth.find("\"boresight_roll_arcsec\": 60.0"), std::string::npos);
  EXPECT_NE(truth.find("\"boresight_pitch_arcsec\": -30.0"), std::string::npos);
  EXPECT_NE(truth.find("\"range_bias_m\": 0.25"), std::string::npos);
  EXPECT_NE(truth.find("\"pairs\""), std::string::npos);
}

TEST(SimulateTool, TruthStatesErrorsScannerAndSessions) {
  const fs::path folder = test::scratch("tool_errors");
  const ToolRun run = tiny(folder,
                           "-scanner dual -sessions 2 -error time_offset=1.5 "
                           "session2:offset_z=0.08,channel1:boresight_roll=60 -ins tactical");
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string truth = readBytes(folder / "truth.json");
  for (const char* text : {"\"name\": \"time_offset\"", "\"value\": 1.5", "\"unit\": \"ms\"",
                           "\"of\": \"session 2\"", "\"of\": \"channel 1\"", "\"type\": \"dual\"",
                           "\"session\": 2", "\"heading_arcsec\": 126.0"})
    EXPECT_NE(truth.find(text), std::string::npos) << text;
}

TEST(SimulateTool, ChannelsAreInTheFiles) {
  const fs::path folder = test::scratch("tool_channels");
  ASSERT_EQ(tiny(folder, "-scanner cross").status, 0);
  const PointChunk points = allPoints(folder / "strip3.las");
  std::size_t second = 0;
  for (const std::uint8_t channel : points.channel) {
    ASSERT_LE(channel, 1);
    second += channel;
  }
  EXPECT_NEAR(static_cast<double>(second), 0.5 * static_cast<double>(points.size()),
              0.05 * static_cast<double>(points.size()));
}

TEST(SimulateTool, WrongUseIsNamed) {
  const std::string out = "-output " + (test::scratch("tool_wrong") / "x").string();
  const auto expectRefusal = [&](const std::string& arguments, const std::string& word) {
    const ToolRun run = simulate(arguments);
    EXPECT_EQ(run.status, 1) << arguments;
    EXPECT_NE(run.output.find(word), std::string::npos) << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  };
  expectRefusal("-preset small", "-output");
  expectRefusal(out + " -preset huge", "'huge'");
  expectRefusal(out + " -noise loud", "'loud'");
  expectRefusal(out + " -error_process loud", "'loud'");
  expectRefusal(out + " -bias roll=3", "'roll'");
  expectRefusal(out + " -bias boresight_roll=1,boresight_roll=2", "twice");
  expectRefusal(out + " -bias boresight_roll=1e9", "boresight_roll");
  expectRefusal(out + " -scale 0", "-scale");
  expectRefusal(out + " -error clock=3", "clock");
  expectRefusal(out + " -scanner flash", "flash");
  expectRefusal(out + " -ins toy", "toy");
  expectRefusal(out + " -strip_gains 9=1", "9=1");
  expectRefusal(out + " -density nan", "-density");
  expectRefusal(out + " -fov 120", "-fov");
  expectRefusal(out + " -origin 1,2", "-origin");
  expectRefusal(out + " -time utc", "-time");
  expectRefusal(out + " -seed x", "seed");
  expectRefusal(out + " -wind 3", "wind");
  expectRefusal(out + " strip.las", "usage");
}

TEST(SimulateTool, UnusableOutputIsNamed) {
  const fs::path folder = test::scratch("tool_unusable");
  std::ofstream(folder / "file") << "in the way";
  const ToolRun run = tiny(folder / "file" / "block");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.output.find("file/block"), std::string::npos) << run.output;
}

TEST(SimulateTool, StripsOfAnotherBlockAreNotMixedIn) {
  const fs::path folder = test::scratch("tool_mixed");
  std::ofstream(folder / "strip6.las") << "of a larger block";
  const ToolRun run = tiny(folder);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.output.find("strip6.las"), std::string::npos) << run.output;
  fs::remove(folder / "strip6.las");
  EXPECT_EQ(tiny(folder).status, 0);
  EXPECT_EQ(tiny(folder).status, 0) << "a second run replaces the first";
}

TEST(SimulateTool, HelpNamesEveryOption) {
  const ToolRun run = simulate("-h");
  EXPECT_EQ(run.status, 0);
  for (const char* option : {"output", "preset", "scale", "density", "seed", "noise", "bias",
                             "vertical", "fov", "origin", "truth_points", "true_surface", "time",
                             "error_process", "error", "scanner", "ins", "sessions", "height"})
    EXPECT_NE(run.output.find("--" + std::string(option)), std::string::npos) << option;
}

}  // namespace
}  // namespace pcl_als
