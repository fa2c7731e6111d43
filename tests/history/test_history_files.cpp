// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/history/history_files.h>
#include <pcl_als/io/mission_table.h>
#include <pcl_als/io/survey_io.h>

#include "simulated_missions.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::MissionSimulator;

class HistoryFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("pcl_als_history_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    MissionSimulator simulator(3);
    for (int m = 0; m < 3; ++m) {
      CalibrationResult result = simulator.calibration(Eigen::VectorXd::Zero(7));
      result.inputs = {"strip" + std::to_string(m)};
      input_.calibrations.push_back(folder_ / ("c" + std::to_string(m) + ".json"));
      writeCalibration(input_.calibrations.back(), result);
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text) {
    const fs::path path = folder_ / "missions.csv";
    std::ofstream(path) << text;
    return path;
  }
  std::string refusal() const {
    try {
      readHistoryMissions(input_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
  HistoryInput input_;
};

TEST_F(HistoryFiles, TableGivesDatesAndCovariates) {
  input_.missions = write(
      "calibration,date,temperature\nc1.json,2026-05-04,12.5\nc0,04.06.2026,\nc2.json,20260501,"
      "8\n");
  const HistoryMissions read = readHistoryMissions(input_);
  ASSERT_EQ(read.missions.size(), 3U);
  EXPECT_EQ(read.missions[0].day, 16951);
  EXPECT_TRUE(read.missions[0].covariates.empty());
  EXPECT_EQ(read.missions[1].day, 16920);
  EXPECT_DOUBLE_EQ(read.missions[1].covariates.at("temperature"), 12.5);
  // The newest by date is the first file.
  EXPECT_EQ(read.newest.inputs, std::vector<std::string>{"strip0"});
}

TEST_F(HistoryFiles, WrongTablesAreRefusedByLine) {
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"calibration,date\nc0.json,2026-05-04\n", "no row for the calibration c1.json"},
           {"calibration,date\nc0.json,32.05.2026\n", "line 2, column 'date'"},
           {"calibration,date\nc0.json,2026-05-04\nc0.json,2026-05-05\n", "has a row already"},
           {"calibration,temperature\nc0.json,warm\n", "line 2, column 'temperature'"},
           {"file,date\nc0.json,2026-05-04\n", "no column 'calibration'"},
           {"calibration,date\n", "no rows"}}) {
    input_.missions = write(text);
    EXPECT_NE(refusal().find(expected), std::string::npos) << refusal();
  }
}

TEST_F(HistoryFiles, RepeatedAndUnusableCalibrationsAreExcluded) {
  CalibrationResult bad = readCalibration(input_.calibrations[2]);
  bad.verdict.downgrade(CalibrationStatus::not_converged, "the adjustment did not converge");
  writeCalibration(input_.calibrations[2], bad);
  fs::copy_file(input_.calibrations[0], folder_ / "copy.json");
  input_.calibrations.push_back(folder_ / "copy.json");
  HistoryMissions read = readHistoryMissions(input_);
  EXPECT_EQ(read.missions.size(), 2U);
  ASSERT_EQ(read.excluded.size(), 2U);
  EXPECT_NE(read.excluded[0].find("did not converge"), std::string::npos);
  EXPECT_NE(read.excluded[1].find("repeats"), std::string::npos);
  input_.with_unusable = true;
  EXPECT_EQ(readHistoryMissions(input_).missions.size(), 3U);
  input_.with_unusable = false;
  input_.calibrations = {input_.calibrations[2]};
  EXPECT_NE(refusal().find("no calibration can be used"), std::string::npos) << refusal();
}

TEST_F(HistoryFiles, InstrumentAndDateAreThoseOfTheCalibration) {
  for (int m = 0; m < 3; ++m) {
    CalibrationResult result = readCalibration(input_.calibrations[static_cast<std::size_t>(m)]);
    EXPECT_TRUE(result.system_name.empty());
    EXPECT_FALSE(result.day);
    result.system_name = m == 1 ? "scanner B" : "scanner A";
    result.day = 16920 - m;
    writeCalibration(input_.calibrations[static_cast<std::size_t>(m)], result);
  }
  EXPECT_NE(refusal().find("of the instrument scanner B, others are of scanner A"),
            std::string::npos)
      << refusal();
  input_.system_name = "scanner A";
  const HistoryMissions read = readHistoryMissions(input_);
  ASSERT_EQ(read.missions.size(), 2U);
  EXPECT_EQ(read.missions[1].day, 16918);
  EXPECT_EQ(read.newest.day, 16920);
  EXPECT_EQ(read.newest.system_name, "scanner A");
  ASSERT_EQ(read.excluded.size(), 1U);
  EXPECT_NE(read.excluded[0].find("scanner B"), std::string::npos);
}

TEST_F(HistoryFiles, OtherModelsAndSystemsAreRefused) {
  CalibrationResult other = readCalibration(input_.calibrations[1]);
  other.attitude = AttitudeSource::points;
  writeCalibration(input_.calibrations[1], other);
  EXPECT_NE(refusal().find("cannot be combined"), std::string::npos) << refusal();
  input_.calibrations = {input_.calibrations[0]};
  input_.system = "north";
  EXPECT_NE(refusal().find("has no system 'north'"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace pcl_als
