// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The parts of calibration.json, and files of version 1, which had none.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

namespace pcl_als {
namespace {

using Json = nlohmann::json;

/// A file of version 1 with every key that it could have.
std::filesystem::path earlierFile() {
  return std::filesystem::path(PCL_ALS_IO_DATA) / "calibration_version_1.json";
}

Json earlierJson() {
  return Json::parse(std::ifstream(earlierFile()));
}

/// Whether two values are equal but for the last digits of numbers, which pass through units.
bool alike(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number())
    return std::abs(a.get<double>() - b.get<double>()) <= 1e-12 * std::abs(a.get<double>());
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (a.is_object()) {
    for (const auto& [key, value] : a.items())
      if (!b.contains(key) || !alike(value, b[key])) return false;
    return true;
  }
  if (!a.is_array()) return a == b;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!alike(a[i], b[i])) return false;
  return true;
}

TEST(CalibrationParts, HoldAllThatVersion1Held) {
  const Json earlier = earlierJson();
  ASSERT_EQ(earlier["version"], 1);
  const Json now = Json::parse(calibrationJson(readCalibration(earlierFile())));
  EXPECT_EQ(now["version"], 2);
  EXPECT_EQ(now["format"], earlier["format"]);
  EXPECT_EQ(now["inputs"], earlier["inputs"]);
  std::size_t found = 0;
  for (const char* part : {"instrument", "flight", "report"}) {
    for (const auto& [key, value] : now[part].items()) {
      if (!earlier.contains(key)) continue;
      EXPECT_TRUE(alike(earlier[key], value)) << key << ' ' << earlier[key] << " / " << value;
      ++found;
    }
  }
  EXPECT_EQ(found + 4, earlier.size());  // format, version, tool_version, inputs
}

TEST(CalibrationParts, AreReadAsTheyAreWritten) {
  const std::string text = calibrationJson(readCalibration(earlierFile()));
  const Json once = Json::parse(text),
             twice = Json::parse(calibrationJson(parseCalibration(text, "t")));
  EXPECT_TRUE(alike(once, twice)) << once << twice;
  EXPECT_EQ(once["id"], calibrationId(readCalibration(earlierFile())));
  EXPECT_EQ(once["id"], twice["id"]);
}

TEST(CalibrationParts, TheInstrumentIsReadByItself) {
  const CalibrationResult all = readCalibration(earlierFile());
  Json json = Json::parse(calibrationJson(all));
  json.erase("flight");
  json.erase("report");
  const CalibrationResult instrument = parseCalibration(json.dump(), "instrument");
  // Attitude, error sources and systems are those of the instrument, which the identifier covers.
  EXPECT_EQ(calibrationId(instrument), calibrationId(instrumentOf(all)));
  EXPECT_EQ(instrument.correlation, all.correlation);
  EXPECT_EQ(instrument.scan_planes, all.scan_planes);
  EXPECT_EQ(instrument.line_fit_half_width, all.line_fit_half_width);
  EXPECT_TRUE(instrument.verdict.usable());
  EXPECT_TRUE(instrument.strip_errors.empty());
  EXPECT_TRUE(instrument.recovered_attitude.empty());
  EXPECT_TRUE(instrument.held.empty());
  EXPECT_TRUE(instrument.pairs.empty());

  json.erase("instrument");
  EXPECT_THROW(parseCalibration(json.dump(), "nothing"), InputError);
}

TEST(CalibrationParts, RefusesDeeplyNestedValues) {
  EXPECT_THROW(parseCalibration(std::string(200'000, '['), "deep"), InputError);
}

}  // namespace
}  // namespace pcl_als
