// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/survey/survey_reader.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using Heights = std::map<int, std::vector<double>>;  ///< by strip

/// Points of some strips, a run of 100 of each in turn; heights count the points of the file.
PointChunk points(const std::vector<std::uint16_t>& ids, double first_height,
                  std::size_t runs = 10) {
  PointChunk chunk;
  chunk.resize(100 * runs * ids.size());
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    chunk.x[i] = 0.5 * static_cast<double>(i % 100);
    chunk.y[i] = 0.5 * static_cast<double>(i / 100);
    chunk.z[i] = first_height + 0.001 * static_cast<double>(i);
    chunk.gps_time[i] = 1000.0 + 0.01 * static_cast<double>(i);
    chunk.intensity[i] = static_cast<float>(i % 1000);
    chunk.point_source_id[i] = ids[i / 100 % ids.size()];
    chunk.return_number[i] = chunk.number_of_returns[i] = 1;
  }
  return chunk;
}

std::string write(const fs::path& path, const PointChunk& chunk, bool with_extra = false,
                  const std::string& crs = "LOCAL_CS[\"metres\"]") {
  LasWriterOptions options;
  options.time_kind = TimeKind::week_seconds;
  options.crs = crs;
  LasExtraField field;
  field.name = "quality";
  if (with_extra) options.extra_fields = {field};
  LasWriter writer(path, options);
  std::vector<double> values;
  for (std::size_t i = 0; i < chunk.size(); ++i) values.push_back(0.5 * static_cast<double>(i));
  writer.append(chunk, with_extra ? std::vector<std::vector<double>>{values}
                                  : std::vector<std::vector<double>>{});
  writer.finish();
  return path.string();
}

/// The heights of each strip in the order in which a reading gives them.
Heights heightsOf(const SurveyReader& survey, const SurveyReader::Reading& reading = {}) {
  Heights heights;
  std::mutex mutex;
  survey.read(
      [&](const SurveyReader::Run& run) {
        const std::lock_guard<std::mutex> lock(mutex);
        for (std::size_t row = run.from; row < run.to; ++row)
          heights[run.strip].push_back(run.chunk.z[row]);
      },
      reading);
  return heights;
}

/// Strips 1 and 2 in a.las, 3 in b.las, 2 and 4 in c.las.
std::vector<std::string> threeFiles(const fs::path& folder) {
  return {write(folder / "a.las", points({1, 2}, 0.0)), write(folder / "b.las", points({3}, 100.0)),
          write(folder / "c.las", points({2, 4}, 200.0))};
}

TEST(SurveyReader, GivesThePointsOfAStripInTheirOrderForAnyNumberOfThreads) {
  const auto files = threeFiles(test::scratch("reader_order"));
  const SurveyReader survey(files, 1);
  EXPECT_EQ(survey.strips(), (Names{"1", "2", "3", "4"}));
  const Heights heights = heightsOf(survey);
  ASSERT_EQ(heights.size(), 4U);
  EXPECT_EQ(heights.at(0).size(), 1000U);
  EXPECT_EQ(heights.at(1).size(), 2000U);  // of two files
  for (const auto& strip : heights)
    EXPECT_TRUE(std::is_sorted(strip.second.begin(), strip.second.end()));
  for (const int threads : {2, 3, 8})
    EXPECT_EQ(heightsOf(SurveyReader(files, threads)), heights) << threads;
  EXPECT_EQ(heightsOf(survey), heights);  // again
}

TEST(SurveyReader, WithOneThreadTheFilesComeInTheirOrder) {
  const SurveyReader survey(threeFiles(test::scratch("reader_file_order")), 4);
  SurveyReader::Reading reading;
  reading.threads = 1;
  std::vector<std::size_t> files;
  survey.read([&](const SurveyReader::Run& run) { files.push_back(run.file); }, reading);
  EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
  EXPECT_EQ(files.back(), 2U);
}

TEST(SurveyReader, ReadsOneStripOrSomeFilesAlone) {
  const SurveyReader survey(threeFiles(test::scratch("reader_parts")), 2);
  SurveyReader::Reading reading;
  reading.strip = 1;
  const Heights all = heightsOf(survey), strip = heightsOf(survey, reading);
  ASSERT_EQ(strip.size(), 1U);
  EXPECT_EQ(strip.at(1), all.at(1));
  reading.files = {2};
  EXPECT_EQ(heightsOf(survey, reading).at(1).size(), 1000U);
  reading.strip = -1;
  EXPECT_EQ(heightsOf(survey, reading).size(), 2U);
  reading.files = {1};
  reading.strip = 0;
  EXPECT_TRUE(heightsOf(survey, reading).empty());
}

TEST(SurveyReader, CountsWhatItLeavesOut) {
  SurveyReader survey(threeFiles(test::scratch("reader_left_out")), 2);
  survey.choose({{}, {"2"}}, {});
  EXPECT_EQ(survey.strips(), (Names{"1", "3", "4"}));
  const SurveyReader::Contents contents = survey.measure();
  EXPECT_EQ(contents.points, (std::vector<std::uint64_t>{1000, 1000, 1000}));
  EXPECT_EQ(contents.pointCount(), 3000U);
  ASSERT_EQ(contents.excluded.size(), 1U);
  EXPECT_EQ(contents.excluded[0].strip, "2");
  EXPECT_EQ(contents.excluded[0].points, 2000U);
  EXPECT_NEAR(contents.boxes[1].min().z(), 100.0, 1e-9);
  EXPECT_NEAR(contents.boxes[1].max().z(), 100.999, 1e-9);
  EXPECT_NEAR(contents.box().max().z(), 201.999, 1e-9);
  // A run of points that are excluded.
  const PointChunk chunk = points({2, 4}, 0.0);
  EXPECT_EQ(survey.runAt(2, chunk, 30).strip, -1);
  EXPECT_EQ(survey.runAt(2, chunk, 30).to, 100U);
  EXPECT_EQ(survey.runAt(2, chunk, 100).strip, 2);
}

TEST(SurveyReader, WholeFilesAreStripsOfTheirOwn) {
  const auto files = threeFiles(test::scratch("reader_whole"));
  std::vector<PointFileInfo> infos;
  for (const std::string& file : files) infos.push_back(PointReader::open(file)->info());
  const SurveyReader survey = SurveyReader::ofWholeFiles(infos, 3);
  EXPECT_EQ(survey.strips(), files);
  EXPECT_EQ(survey.pointCount(), 5000U);
  const Heights heights = heightsOf(survey);
  EXPECT_EQ(heights.at(0).size(), 2000U);
  EXPECT_EQ(heights.at(1).size(), 1000U);
  EXPECT_EQ(heights.at(2).size(), 2000U);
}

TEST(SurveyReader, ReadsAnExtraField) {
  const auto folder = test::scratch("reader_extra");
  const SurveyReader survey(
      {write(folder / "a.las", points({1}, 0.0), true), write(folder / "b.las", points({2}, 0.0))},
      1);
  SurveyReader::Reading reading;
  reading.extra_field = "quality";
  survey.read(
      [](const SurveyReader::Run& run) {
        ASSERT_EQ(run.chunk.extra.size(), run.chunk.size());
        for (std::size_t row = run.from; row < run.to; ++row) {
          if (run.file == 0) {
            EXPECT_EQ(run.chunk.extra[row], 0.5 * static_cast<double>(row));
          } else {
            EXPECT_TRUE(std::isnan(run.chunk.extra[row]));
          }
        }
      },
      reading);
  survey.read([](const SurveyReader::Run& run) { EXPECT_TRUE(run.chunk.extra.empty()); });
}

TEST(SurveyReader, CanBeMoved) {
  auto first = std::make_unique<SurveyReader>(threeFiles(test::scratch("reader_moved")), 1);
  const Heights heights = heightsOf(*first);
  SurveyReader moved(std::move(*first));
  first.reset();
  EXPECT_EQ(heightsOf(moved), heights);
  moved.choose({{"3"}, {}}, {});
  EXPECT_EQ(heightsOf(moved).at(0), heights.at(2));
}

TEST(SurveyReader, RefusesFilesThatDoNotFitTogetherUnlessTheyNeedNot) {
  const auto folder = test::scratch("reader_unrelated");
  const std::vector<std::string> files = {
      write(folder / "a.las", points({1}, 0.0), false, "EPSG:25832"),
      write(folder / "b.las", points({2}, 0.0), false, "EPSG:25833")};
  EXPECT_THROW(SurveyReader(files, 1), InputError);
  EXPECT_EQ(heightsOf(SurveyReader::ofFiles({files[0], files[1]}, 1)).size(), 2U);
}

TEST(SurveyReader, PointsAsReturnsHaveTheTimesOfTheTrajectory) {
  const auto folder = test::scratch("reader_returns");
  SurveyInput input = SurveyInput::ofFile(write(folder / "a.las", points({1}, 0.0)));
  input.time = TimeAlignment();
  input.time->offset = 50.0;
  SurveyReader survey = SurveyReader::ofInputs({input}, 1);
  std::vector<TrajectorySample> samples(2);
  samples[0].time = 1000.0, samples[1].time = 1100.0;
  samples[1].position.x() = 6000.0;
  const Trajectory flight(samples);
  survey.choose({}, {&flight, std::nullopt, false});
  std::size_t count = 0;
  survey.read(SurveyReader::asReturns([&](int, const LidarReturn* some, std::size_t size) {
    if (count == 0) {
      EXPECT_NEAR(some[0].time, 1050.0, 1e-9);
      EXPECT_EQ(some[7].intensity, 7.0F);
    }
    count += size;
  }));
  EXPECT_EQ(count, 1000U);
}

}  // namespace
}  // namespace pcl_als
