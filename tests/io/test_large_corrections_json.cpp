// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/result_json.h>

namespace pcl_als {
namespace {

CalibrationResult withLargeCorrection() {
  CalibrationResult result;
  LargeCorrection& correction = result.large_corrections.emplace_back();
  correction.strip = "7";
  correction.from = 401003.25;
  correction.to = 401009.5;
  correction.time = 401006.0;
  correction.axis = 4;
  correction.value = -100.0 * kRadiansPerArcsec;
  correction.std = 10.0 * kRadiansPerArcsec;
  correction.ordinary = 8.0 * kRadiansPerArcsec;
  correction.on_ground = 0.5;
  correction.begin = {700000.25, 5660000.5};
  correction.end = {700300.0, 5660001.0};
  correction.causes = {{"turn", "the aircraft turns"}, {"strip_end", "it is at the end"}};
  return result;
}

TEST(LargeCorrectionsJson, KeepsTheLargeCorrections) {
  const std::string text = calibrationJson(withLargeCorrection());
  for (const char* part : {"\"axis\": \"roll\"", "\"value\": -100", "\"unit\": \"arcsec\""})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  const CalibrationResult read = parseCalibration(text, "c.json");
  ASSERT_EQ(read.large_corrections.size(), 1U);
  const LargeCorrection& correction = read.large_corrections.front();
  const LargeCorrection expected = withLargeCorrection().large_corrections.front();
  EXPECT_EQ(describe(correction), describe(expected));
  EXPECT_EQ(correction.time, expected.time);
  EXPECT_NEAR(correction.value, expected.value, 1e-15);
  EXPECT_NEAR(correction.ratio(), -12.5, 1e-12);
  EXPECT_EQ(correction.begin, expected.begin);
  EXPECT_EQ(correction.end, expected.end);
  ASSERT_EQ(correction.causes.size(), 2U);
  EXPECT_EQ(correction.causes[1].name, "strip_end");
  EXPECT_TRUE(instrumentOf(read).large_corrections.empty());
}

TEST(LargeCorrectionsJson, RefusesLargeCorrectionsThatAreNone) {
  std::string text = calibrationJson(withLargeCorrection());
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    try {
      parseCalibration(changed, "c.json");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused("\"roll\"", "\"yaw\"").find("axis' must be east, north"), std::string::npos);
  EXPECT_NE(refused("\"axis\": \"roll\"", "\"axis\": \"up\"").find("unit' must be 'm'"),
            std::string::npos);
  EXPECT_NE(refused("\"to\": 401009.5", "\"to\": 401000").find("must not be earlier"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
