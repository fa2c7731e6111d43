// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/point_conversion.h>

#include "las_bytes.h"
#include "test_files.h"
#include "wrong_boxes.h"

namespace pcl_als {
namespace {

using test::LasBytes;
namespace fs = std::filesystem;

fs::path written(const fs::path& path, const LasBytes& las) {
  test::writeBytes(path, las.str());
  return path;
}

PointChunk pointsOf(const fs::path& path, const PointWindow& window = {}) {
  const auto reader = PointReader::open(path, window);
  PointChunk all, chunk;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  while (reader->read(chunk)) {
    append(all.x, chunk.x), append(all.y, chunk.y), append(all.z, chunk.z);
    append(all.gps_time, chunk.gps_time), append(all.intensity, chunk.intensity);
    append(all.point_source_id, chunk.point_source_id);
    append(all.classification, chunk.classification);
    append(all.user_data, chunk.user_data);
    append(all.return_number, chunk.return_number);
  }
  return all;
}

/// The points from..to of LasBytes, which run to the east and south.
Eigen::AlignedBox2d boxOf(const LasBytes& las, unsigned from, unsigned to) {
  const auto at = [&](unsigned i) {
    return Eigen::Vector2d(LasBytes::X(i) * las.scale + las.offset_x,
                           LasBytes::Y(i) * las.scale + las.offset_y);
  };
  Eigen::AlignedBox2d box;
  box.extend(at(from));
  box.extend(at(to));
  return box;
}

PointConversionOptions within(const Eigen::AlignedBox2d& box) {
  PointConversionOptions options;
  options.window.bounds = box;
  return options;
}

TEST(PointConversion, LasToLazToLasGivesTheSameBytes) {
  const auto folder = test::scratch("convert_there_and_back");
  const LasBytes las = test::fullFile(4, 7, 120000);
  const auto in = written(folder / "in.las", las);
  const auto packed = convertPointFiles({in}, folder / "packed.laz");
  ASSERT_EQ(packed.outputs.size(), 1U);
  EXPECT_EQ(packed.outputs[0].points, 120000U);
  convertPointFiles({folder / "packed.laz"}, folder / "out.las");
  EXPECT_TRUE(test::readBytes(folder / "out.las") == las.str());
}

TEST(PointConversion, BoundsKeepTheirEdgesAndTheOrder) {
  const auto folder = test::scratch("convert_bounds");
  const LasBytes las = test::fullFile(4, 6, 1000);
  const auto in = written(folder / "in.las", las);
  const auto result = convertPointFiles({in}, folder / "part.las", within(boxOf(las, 200, 599)));
  EXPECT_EQ(result.outputs[0].points, 400U);
  const LasFile part(folder / "part.las");
  EXPECT_EQ(part.header().minimum.x(), LasBytes::X(200) * las.scale + las.offset_x);
  EXPECT_EQ(part.header().points_by_return[0], 133U);  // 201, 204, …, 597
  std::string expected;
  for (unsigned i = 200; i < 600; ++i) expected += las.record(i);
  std::vector<std::byte> records(expected.size());
  part.readRecords(0, 400, records.data());
  EXPECT_TRUE(std::memcmp(records.data(), expected.data(), expected.size()) == 0);
  EXPECT_THROW(convertPointFiles({in}, folder / "none.las",
                                 within({Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)})),
               InputError);
  EXPECT_FALSE(fs::exists(folder / "none.las"));
}

// 2026-11: the origin of a PCD was the middle of the header's box, wherever the points were.
TEST(PointConversion, APcdIsAroundThePointsWhateverTheHeaderSays) {
  const auto folder = test::scratch("convert_wrong_boxes");
  LasBytes las = test::fullFile(4, 6, 200000);  // more than the reader gives at once
  const auto in = written(folder / "in.las", las);
  convertPointFiles({in}, folder / "right.pcd");
  PointConversionOptions part = within(boxOf(las, 200, 150000));
  convertPointFiles({in}, folder / "part.pcd", part);
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(in, wrong.bytes);
    const auto whole = convertPointFiles({in}, folder / "out.pcd");
    EXPECT_TRUE(test::readBytes(folder / "out.pcd") == test::readBytes(folder / "right.pcd"))
        << wrong.name;
    EXPECT_EQ(whole.outputs[0].points, las.count);
    EXPECT_EQ(std::count_if(whole.remarks.begin(), whole.remarks.end(),
                            [](const std::string& remark) {
                              return remark.find("bounding box is wrong") != std::string::npos;
                            }),
              1)
        << wrong.name;
    convertPointFiles({in}, folder / "out.pcd", part);
    EXPECT_EQ(pointsOf(folder / "out.pcd").x.size(), 149801U) << wrong.name;
  }
}

TEST(PointConversion, ExternalWaveformsComeAlong) {
  const auto folder = test::scratch("convert_waveforms");
  LasBytes las;
  las.minor = 3, las.format = 4, las.encoding = 1 | 4, las.count = 1000;
  const auto in = written(folder / "in.las", las);
  test::writeBytes(folder / "in.wdp", "packets");
  fs::create_directory(folder / "out");
  const auto packed = convertPointFiles({in}, folder / "out" / "packed.laz");
  EXPECT_EQ(test::readBytes(folder / "out" / "packed.wdp"), "packets");
  ASSERT_EQ(packed.remarks.size(), 1U);
  EXPECT_EQ(packed.remarks[0], in.string() + ": waveforms in in.wdp, 7 bytes, are copied to " +
                                   (folder / "out" / "packed.wdp").string());
  const auto part = convertPointFiles({in}, folder / "part.las", within(boxOf(las, 200, 599)));
  EXPECT_EQ(test::readBytes(folder / "part.wdp"), "packets");
  EXPECT_EQ(part.remarks.size(), 1U);
  const auto cloud = convertPointFiles({in}, folder / "cloud.pcd");
  ASSERT_EQ(cloud.remarks.size(), 1U);
  EXPECT_NE(cloud.remarks[0].find("waveforms"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "cloud.wdp"));
}

TEST(PointConversion, BytesBehindThePointsAreNamed) {
  const auto folder = test::scratch("convert_unclaimed");
  LasBytes las;
  las.after = las.record(7);
  const auto in = written(folder / "in.las", las);
  const std::string text =
      in.string() +
      ": 30 bytes behind the points belong to no record; they have the size of 1 further point of "
      "30 bytes, which the header does not count";
  const auto copied = convertPointFiles({in}, folder / "out.laz");
  EXPECT_EQ(copied.remarks, std::vector<std::string>{text + "; they are copied as they are"});
  const auto part = convertPointFiles({in}, folder / "part.las", within(boxOf(las, 0, 4)));
  EXPECT_EQ(part.remarks, copied.remarks);
  const auto cloud = convertPointFiles({in}, folder / "out.pcd");
  ASSERT_EQ(cloud.remarks.size(), 1U);
  EXPECT_NE(cloud.remarks[0].find("30 bytes behind the points"), std::string::npos);
}

TEST(PointConversion, AReaderOfAPartGivesTheSamePoints) {
  const auto folder = test::scratch("convert_reader");
  const LasBytes las = test::fullFile(4, 6, 1000);
  const auto in = written(folder / "in.las", las);
  const auto options = within(boxOf(las, 200, 599));
  convertPointFiles({in}, folder / "part.laz", options);
  convertPointFiles({in}, folder / "part.pcd", options);
  const PointChunk part = pointsOf(folder / "part.laz"), read = pointsOf(in, options.window);
  EXPECT_EQ(part.x, read.x);
  EXPECT_EQ(part.gps_time, read.gps_time);
  EXPECT_EQ(pointsOf(folder / "part.pcd").gps_time, read.gps_time);
}

TEST(PointConversion, ThroughPcdKeepsEveryColumn) {
  const auto folder = test::scratch("convert_pcd");
  LasBytes las;
  las.count = 500;
  const auto in = written(folder / "in.las", las);
  const auto result = convertPointFiles({in}, folder / "points.pcd");
  for (const std::string& remark : result.remarks)
    EXPECT_EQ(remark.find("user data"), std::string::npos) << remark;
  convertPointFiles({folder / "points.pcd"}, folder / "out.laz");
  const PointChunk a = pointsOf(in), b = pointsOf(folder / "out.laz");
  ASSERT_EQ(b.size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Steps of 1 mm survive floats near their origin; doubles differ in the last digits.
    EXPECT_NEAR(b.x[i], a.x[i], 1e-7);
    EXPECT_NEAR(b.y[i], a.y[i], 1e-7);
    EXPECT_NEAR(b.z[i], a.z[i], 1e-7);
  }
  EXPECT_EQ(b.gps_time, a.gps_time);
  EXPECT_EQ(b.intensity, a.intensity);
  EXPECT_EQ(b.point_source_id, a.point_source_id);
  EXPECT_EQ(b.classification, a.classification);
  EXPECT_EQ(b.user_data, a.user_data);
  EXPECT_EQ(b.return_number, a.return_number);
}

TEST(PointConversion, WritesTheSamePcdAsTheCloud) {
  const auto folder = test::scratch("convert_save_pcd");
  const auto in = written(folder / "in.las", LasBytes());
  convertPointFiles({in}, folder / "streamed.pcd");
  const Strip<PointLidar> strip = loadPcd(folder / "streamed.pcd");
  EXPECT_EQ(strip.cloud->size(), 5U);
  savePcd(folder / "saved.pcd", strip);
  std::string streamed = test::readBytes(folder / "streamed.pcd");
  // Counts that were not known at first are followed by blanks.
  for (std::size_t at = 0; (at = streamed.find(" \n")) != std::string::npos;) streamed.erase(at, 1);
  const std::string saved = test::readBytes(folder / "saved.pcd");
  const auto body = [](const std::string& text) { return text.substr(text.find("VERSION")); };
  EXPECT_EQ(body(streamed), body(saved));
}

TEST(PointConversion, ChoosesStrips) {
  const auto folder = test::scratch("convert_strips");
  LasBytes las;
  las.count = 1000;
  const auto in = written(folder / "in.las", las);
  PointConversionOptions options;
  options.strips.only = {"57138"};
  const auto result = convertPointFiles({in}, folder / "one.laz", options);
  EXPECT_EQ(result.outputs[0].points, 500U);
  ASSERT_EQ(result.excluded.size(), 1U);
  EXPECT_EQ(result.excluded[0].points, 500U);
  for (const std::uint16_t id : pointsOf(folder / "one.laz").point_source_id) EXPECT_EQ(id, 57138);
  options.strips.only = {"3"};
  EXPECT_THROW(convertPointFiles({in}, folder / "none.laz", options), UsageError);
}

TEST(PointConversion, SplitJoinsStripsOfSeveralFiles) {
  const auto folder = test::scratch("convert_split");
  LasBytes las;
  las.count = 1000;
  const auto a = written(folder / "a.las", las);
  las.offset_x += 100.0;  // the second tile counts from another origin
  const auto b = written(folder / "b.las", las);
  PointConversionOptions options;
  options.strips.split = true;
  options.format = "laz";
  const auto result = convertPointFiles({a, b}, folder / "strips", options);
  ASSERT_EQ(result.outputs.size(), 2U);
  EXPECT_EQ(result.outputs[0].path, folder / "strips" / "57138.laz");
  EXPECT_EQ(result.outputs[0].points, 1000U);
  const PointChunk joined = pointsOf(result.outputs[0].path), first = pointsOf(a);
  EXPECT_EQ(joined.x[1], first.x[2]);
  EXPECT_NEAR(joined.x[500], first.x[0] + 100.0, 1e-9);
}

TEST(PointConversion, SeveralFilesIntoAFolder) {
  const auto folder = test::scratch("convert_folder");
  const auto a = written(folder / "a.las", LasBytes()), b = written(folder / "b.las", LasBytes());
  PointConversionOptions options;
  options.format = "laz";
  const auto result = convertPointFiles({a, b}, folder / "out", options);
  ASSERT_EQ(result.outputs.size(), 2U);
  EXPECT_EQ(result.outputs[1].path, folder / "out" / "b.laz");
  EXPECT_THROW(convertPointFiles({a, b}, folder / "one.las"), UsageError);
  EXPECT_THROW(convertPointFiles({a}, folder / "a.las"), UsageError);
  EXPECT_THROW(convertPointFiles({a}, folder), UsageError);  // a.las itself
  EXPECT_THROW(convertPointFiles({a}, folder / "a.copc.laz"), UsageError);
  EXPECT_THROW(convertPointFiles({a}, folder / "a.txt"), UsageError);
  fs::create_directory(folder / "other");
  const auto same = written(folder / "other" / "a.las", LasBytes());
  EXPECT_THROW(convertPointFiles({a, same}, folder / "out"), UsageError);
}

TEST(PointConversion, KeepsWhatIsIntactOfATruncatedFile) {
  const auto folder = test::scratch("convert_truncated");
  LasBytes las = test::fullFile(4, 6, 230000);
  written(folder / "in.las", las);
  convertPointFiles({folder / "in.las"}, folder / "in.laz");
  const std::string bytes = test::readBytes(folder / "in.laz");
  test::writeBytes(folder / "cut.laz", bytes.substr(0, bytes.size() * 7 / 10));
  EXPECT_THROW(convertPointFiles({folder / "cut.laz"}, folder / "out.las"), InputError);
  PointConversionOptions options;
  options.window.keep_readable = true;
  const auto result = convertPointFiles({folder / "cut.laz"}, folder / "out.las", options);
  EXPECT_EQ(result.outputs[0].points, 150000U);  // three chunks of 50,000
  ASSERT_EQ(result.remarks.size(), 1U);
  EXPECT_NE(result.remarks[0].find("3 chunks can be decoded, with 150 000 of 230 000 points"),
            std::string::npos)
      << result.remarks[0];
  const PointChunk kept = pointsOf(folder / "out.las"), whole = pointsOf(folder / "in.las");
  EXPECT_TRUE(std::equal(kept.x.begin(), kept.x.end(), whole.x.begin()));
  options.window.bounds = boxOf(las, 149000, 151000);
  EXPECT_EQ(convertPointFiles({folder / "cut.laz"}, folder / "part.las", options).outputs[0].points,
            1000U);
}

TEST(PointConversion, OneThreadEqualsEight) {
  const auto folder = test::scratch("convert_threads");
  LasBytes las = test::fullFile(4, 6, 130000);
  const auto in = written(folder / "in.las", las);
  PointConversionOptions options = within(boxOf(las, 10, 120000));
  options.threads = 1;
  convertPointFiles({in}, folder / "one.laz", options);
  options.threads = 8;
  convertPointFiles({in}, folder / "eight.laz", options);
  EXPECT_TRUE(test::readBytes(folder / "one.laz") == test::readBytes(folder / "eight.laz"));
}

TEST(PointConversion, CanBeCancelled) {
  const auto folder = test::scratch("convert_cancelled");
  const auto in = written(folder / "in.las", LasBytes());
  EXPECT_THROW(convertPointFiles({in}, folder / "out.laz", {},
                                 [](const JobProgress& progress) {
                                   return progress.event != JobProgress::Event::advance;
                                 }),
               Cancelled);
  const auto files = fs::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);  // only in.las
}

}  // namespace
}  // namespace pcl_als
