// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>

#include "copc_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::CopcBytes;
namespace fs = std::filesystem;

/// Made once: several tests read it.
const CopcBytes& block() {
  static const CopcBytes bytes(test::copcPoints(60000), {});
  return bytes;
}

fs::path blockFile(const std::string& name) {
  const fs::path path = test::scratch(name) / "block.copc.laz";
  test::writeBytes(path, block().str());
  return path;
}

struct Read {
  std::vector<double> x, y, time;
  std::vector<float> intensity;
};

Read readAll(PointReader& reader) {
  Read all;
  PointChunk chunk;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  while (reader.read(chunk)) {
    EXPECT_LE(chunk.size(), PointReader::kChunk);
    append(all.x, chunk.x), append(all.y, chunk.y);
    append(all.time, chunk.gps_time), append(all.intensity, chunk.intensity);
  }
  return all;
}

Read readPart(const fs::path& path, const PointWindow& window) {
  return readAll(*PointReader::open(path, window));
}

PointWindow boxed(double west, double south, double east, double north) {
  PointWindow window;
  window.bounds.emplace(Eigen::Vector2d(west, south), Eigen::Vector2d(east, north));
  return window;
}

TEST(Copc, IsReadAsTheLazFileThatItIs) {
  const auto path = blockFile("copc_whole");
  const LasFile file(path);
  EXPECT_TRUE(file.isCopc());
  EXPECT_EQ(file.info().format, "LAZ 1.4, point format 6, COPC");
  std::string expected;
  for (const CopcBytes::Point& point : block().inOrder()) expected += point.record;
  std::vector<std::byte> records(expected.size());
  file.readRecords(0, file.header().point_count, records.data());
  EXPECT_TRUE(std::memcmp(records.data(), expected.data(), expected.size()) == 0);
}

/// COPC 1.0 defines files of LAS 1.4; those of LAS 1.5 differ in the length of the header.
TEST(Copc, OfLas15IsReadAsThatOfLas14) {
  CopcBytes::Frame frame;
  frame.version_minor = 5;
  const auto points = test::copcPoints(20000);
  const auto folder = test::scratch("copc_15");
  test::writeBytes(folder / "new.copc.laz", CopcBytes(points, frame).str());
  test::writeBytes(folder / "old.copc.laz", CopcBytes(points, {}).str());
  EXPECT_EQ(LasFile(folder / "new.copc.laz").info().format, "LAZ 1.5, point format 6, COPC");
  PointWindow window = boxed(100.0, 200.0, 180.0, 230.0);
  const Read part = readPart(folder / "new.copc.laz", window),
             expected = readPart(folder / "old.copc.laz", window);
  EXPECT_GT(part.x.size(), 0U);
  EXPECT_EQ(part.x, expected.x);
  EXPECT_EQ(part.intensity, expected.intensity);
  // Stored times are 100e6 s less than standard GPS time, which is 1e9 s more than adjusted time.
  ASSERT_EQ(part.time.size(), expected.time.size());
  for (std::size_t i = 0; i < part.time.size(); ++i)
    EXPECT_NEAR(part.time[i], expected.time[i] + 100e6 - 1e9, 1e-6);
  window.bounds.reset();
  window.resolution = frame.spacing();
  EXPECT_EQ(readPart(folder / "new.copc.laz", window).x,
            readPart(folder / "old.copc.laz", window).x);
}

class CopcWindows : public testing::TestWithParam<std::array<double, 4>> {};

/// Points and their order are those of the same window of a copy that is no COPC file.
TEST_P(CopcWindows, EqualTheSameWindowOfTheWholeFile) {
  const auto path = blockFile("copc_windows");
  const auto plain = path.parent_path() / "plain.las";
  rewriteLas(path, plain, [](const LasRecordBlock&) {});
  ASSERT_FALSE(LasFile(plain).isCopc());
  const auto [west, south, east, north] = GetParam();
  const PointWindow window = boxed(west, south, east, north);
  const Read part = readPart(path, window), expected = readPart(plain, window);
  EXPECT_GT(part.x.size(), 0U);
  EXPECT_EQ(part.x, expected.x);
  EXPECT_EQ(part.y, expected.y);
  EXPECT_EQ(part.time, expected.time);
  EXPECT_EQ(part.intensity, expected.intensity);
}

INSTANTIATE_TEST_SUITE_P(Windows, CopcWindows,
                         testing::Values(std::array{100.0, 200.0, 180.0, 230.0},
                                         std::array{0.0, 0.0, 20.0, 20.0},
                                         // On the borders of nodes: 655.36 m / 2, / 4.
                                         std::array{163.84, 163.84, 327.68, 327.68},
                                         std::array{327.67, 0.0, 327.68, 655.36},
                                         std::array{-1e6, -1e6, 1e6, 1e6}));

TEST(Copc, ReadsOnlyTheNodesOfTheWindow) {
  const LasFile file(blockFile("copc_nodes"));
  LasWindow window;
  window.bounds.emplace(Eigen::Vector2d(10.0, 10.0), Eigen::Vector2d(40.0, 40.0));
  std::uint64_t expected = 0, read = 0;
  for (const auto& [key, points] : block().nodes()) {
    const double size = block().frame().sideLength() / (1 << key[0]);
    const bool meets = key[1] * size <= 40.01 && (key[1] + 1) * size >= 9.99 &&
                       key[2] * size <= 40.01 && (key[2] + 1) * size >= 9.99;
    if (meets) expected += points.size();
  }
  for (const LasRecordRange& range : file.recordsWithin(window)) read += range.count;
  EXPECT_EQ(read, expected);
  // The window is 1/480 of the area. The root is always read: 16^2 cells with one point at least.
  EXPECT_LT(read, file.header().point_count / 20);
}

TEST(Copc, AResolutionReadsTheLevelsUpToIt) {
  const auto path = blockFile("copc_levels");
  for (const int level : {0, 1, 2}) {
    std::size_t expected = 0;
    for (const auto& [key, points] : block().nodes())
      if (key[0] <= level) expected += points.size();
    PointWindow window;
    window.resolution = 1.001 * block().frame().spacing() / (1 << level);
    EXPECT_EQ(readPart(path, window).x.size(), expected) << level;
  }
  PointWindow fine;
  fine.resolution = 1e-3;
  EXPECT_EQ(readPart(path, fine).x.size(), block().inOrder().size());
}

TEST(Copc, AResolutionOfAnotherFileIsRefused) {
  const auto path = blockFile("copc_refused");
  rewriteLas(path, path.parent_path() / "plain.laz", [](const LasRecordBlock&) {});
  PointWindow window;
  window.resolution = 10.0;
  try {
    readPart(path.parent_path() / "plain.laz", window);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no COPC file"), std::string::npos);
  }
}

TEST(Copc, ARewrittenFileHasNoOctreeButAllOtherRecords) {
  const auto path = blockFile("copc_rewritten");
  const auto plain = path.parent_path() / "plain.laz";
  rewriteLas(path, plain, [](const LasRecordBlock&) {});
  const LasFile file(plain);
  EXPECT_EQ(file.header().evlr_count, 0U);
  EXPECT_EQ(file.header().evlr_start, 0U);
  ASSERT_EQ(file.vlrs().size(), 1U);
  EXPECT_EQ(file.vlrs()[0].user_id, kLazUser);
  EXPECT_EQ(readPart(plain, {}).time, readPart(path, {}).time);
}

/// The message about a window of a file with changed bytes.
std::string refusalOfWindow(const std::string& bytes) {
  const fs::path path = test::scratch("copc_damage") / "block.copc.laz";
  test::writeBytes(path, bytes);
  return test::messageOf<InputError>([&] { readPart(path, boxed(0.0, 0.0, 600.0, 600.0)); });
}

template <typename T>
std::string changed(std::size_t at, T value) {
  std::string bytes = block().str();
  std::memcpy(&bytes[at], &value, sizeof value);
  return bytes;
}

TEST(CopcDamage, IsRefusedInOneLine) {
  const std::size_t info = CopcBytes::infoAt(), page = block().pageEntries().at(0),
                    node = block().entryOf({1, 0, 0, 0});
  const auto expect = [](const std::string& bytes, const std::string& text) {
    const std::string message = refusalOfWindow(bytes);
    EXPECT_NE(message.find(text), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  expect(changed<double>(info + 24, 0.0), "no positive numbers");       // half of the side
  expect(changed<double>(info + 32, NAN), "no positive numbers");       // spacing
  expect(changed<double>(info, HUGE_VAL), "no positive numbers");       // centre
  expect(changed<std::uint64_t>(info + 40, 1ULL << 60U), "root page");  // offset
  expect(changed<std::uint64_t>(info + 48, 1ULL << 62U), "root page");  // bytes
  expect(changed<std::uint64_t>(info + 48, 33), "root page");           // no multiple of 32
  expect(changed<std::uint64_t>(info + 48, 0), "root page");
  expect(changed<std::uint64_t>(page + 16, ~0ULL), "not within the file");
  expect(changed<std::uint64_t>(page + 16, block().rootPage()), "more than once");
  expect(changed<std::int32_t>(page + 24, -32), "-1 points in -32 bytes");
  expect(changed<std::int32_t>(node, 31), "no node of an octree");      // level
  expect(changed<std::int32_t>(node + 4, -1), "no node of an octree");  // x
  expect(changed<std::int32_t>(node + 4, 2), "no node of an octree");   // x of level 1
  expect(changed<std::int32_t>(node + 24, 2000000000), "not within the file");
  expect(changed<std::int32_t>(node + 24, 0), "points in 0 bytes");
  expect(changed<std::int32_t>(node + 28, -7), "-7 points");
  expect(changed<std::int32_t>(node + 28, 2000000000), "of the 60000 points of the file");
  expect(changed<std::uint64_t>(node + 16, 1000), "lies outside its cube");
  // Nodes that are missing for a window they do not meet, too.
  expect(changed<std::int32_t>(node + 28, 0), "of the 60000 points of the file");
  expect(changed<std::int32_t>(page + 28, 0), "of the 60000 points of the file");  // a whole page
  expect(changed<std::uint64_t>(info + 48, 32), "of the 60000 points of the file");
  expect(changed<std::int32_t>(block().entryOf({0, 0, 0, 0}), 5), "is missing");  // level
  expect(changed<std::int32_t>(node + 4, 1), "stands there twice");               // x
  // The cube is elsewhere or of another size.
  expect(changed<double>(info, 1e6), "lies outside its cube");
  expect(changed<double>(info + 24, 20.0), "lies outside its cube");
  std::string twice = block().str();
  twice.replace(node + 16, 16, twice.substr(block().entryOf({0, 0, 0, 0}) + 16, 16));
  expect(twice, "of the 60000 points of the file");
}

/// Any changed bit of the hierarchy is refused, or the points in a window are the same.
TEST(CopcDamage, LosesNoPointsSilently) {
  const fs::path path = test::scratch("copc_bits") / "block.copc.laz";
  const CopcBytes small(test::copcPoints(3000), {});
  test::writeBytes(path, small.str());
  const PointWindow window = boxed(100.0, 100.0, 400.0, 300.0);
  const Read right = readPart(path, window);
  int refused = 0, different = 0, rounds = 0;
  for (std::size_t at = small.rootPage(); at < small.str().size(); at += 7)
    for (const int bit : {0, 5}) {
      std::string bytes = small.str();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      test::writeBytes(path, bytes);
      ++rounds;
      try {
        const Read part = readPart(path, window);
        if (part.time != right.time) ++different;
      } catch (const InputError&) {
        ++refused;
      }
    }
  EXPECT_EQ(different, 0) << "of " << rounds;
  EXPECT_GT(refused, rounds * 9 / 10);
}

TEST(CopcDamage, DoesNotConcernTheWholeFile) {
  const fs::path path = test::scratch("copc_damage_whole") / "block.copc.laz";
  test::writeBytes(path, changed<std::uint64_t>(CopcBytes::infoAt() + 40, 1ULL << 60U));
  EXPECT_EQ(readPart(path, {}).x.size(), block().inOrder().size());
}

}  // namespace
}  // namespace pcl_als
