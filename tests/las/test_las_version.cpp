// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/damaged_file.h>
#include <pcl_als/las/las_version.h>
#include <pcl_als/las/las_writer.h>

#include "file_bytes.h"
#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

// LAS 1.5 R00, table "Public Header Block".
constexpr std::size_t kEncodingAt = 6, kLatestAt = 375, kEarliestAt = 383, kTimeOffsetAt = 391;

std::filesystem::path writeVersion(const std::string& name, const std::string& bytes) {
  const auto path = test::scratch("las_version") / name;
  test::writeBytes(path, bytes);
  return path;
}

PointChunk pointsOf(const LasFile& file) {
  const LasHeader& h = file.header();
  std::vector<std::byte> records(h.point_count * h.record_length);
  file.readRecords(0, h.point_count, records.data());
  PointChunk chunk;
  decodeLasRecords(records.data(), h.point_count, h.record_length, file.layout(), h.scale, h.offset,
                   chunk);
  return chunk;
}

LasBytes newest(unsigned encoding, unsigned time_offset) {
  LasBytes las;
  las.minor = 5;
  las.encoding = encoding;
  las.time_offset = time_offset;
  return las;
}

std::string converted(const LasFile& file, const std::string& name, const LasVersion& version) {
  const auto path = test::scratch("las_version_out") / name;
  convertLasVersion(file, path, version);
  return test::readBytes(path);
}

TEST(LasVersion, OffsetTimesBecomeAdjustedStandardTime) {
  struct Case {
    unsigned encoding, offset;
    double shift;
  };
  // Adjusted = GPS - 1000e6, stored = GPS - offset * 1e6.
  for (const Case& c : {Case{65 | 16, 1500, 500e6}, Case{65 | 16, 1250, 250e6},
                        Case{65 | 16, 1000, 0.0}, Case{65 | 16, 500, -500e6},
                        Case{1 | 16, 1500, 0.0}, Case{16, 1500, 0.0}, Case{64 | 16, 1500, 0.0}}) {
    const LasFile file(writeVersion("offset.las", newest(c.encoding, c.offset).str()));
    EXPECT_EQ(file.info().time_shift, c.shift) << c.encoding << ' ' << c.offset;
    EXPECT_EQ(file.info().time_kind,
              (c.encoding & 1U) != 0 ? TimeKind::adjusted_standard : TimeKind::week_seconds);
    EXPECT_EQ(pointsOf(file).gps_time[3], LasBytes::time(3) + c.shift);
    EXPECT_EQ(file.header().earliest_time, LasBytes::time(0));
    EXPECT_EQ(file.header().latest_time, LasBytes::time(4));
    EXPECT_EQ(file.remarks().size(), c.encoding == (64 | 16) ? 1U : 0U);
  }
  LasBytes older;
  older.encoding = 65;  // the bit is reserved in 1.4
  EXPECT_EQ(LasFile(writeVersion("older.las", older.str())).info().time_shift, 0.0);
}

TEST(LasVersion, ATimeOfZeroIsNone) {
  std::string bytes = newest(65 | 16, 1500).str();
  const double zero = 0.0;
  std::memcpy(&bytes[393 + 22], &zero, sizeof zero);
  EXPECT_EQ(pointsOf(LasFile(writeVersion("zero.las", bytes))).gps_time[0], 0.0);
}

TEST(LasVersion, TheWriterStoresOffsetTimes) {
  const auto path = test::scratch("las_version_writer") / "out.las";
  LasWriterOptions options;
  options.version_minor = 5;
  options.time_offset = 1500;
  PointChunk p;
  p.resize(3);
  p.gps_time = {450000000.25, 0.0, 450000100.5};
  LasWriter writer(path, options);
  writer.append(p);
  writer.finish();
  const std::string bytes = test::readBytes(path);
  EXPECT_EQ(bytes.size(), 393U + 3 * 30);
  EXPECT_EQ(test::valueAt<std::uint16_t>(bytes, kEncodingAt), 1 | 16 | 64);
  EXPECT_EQ(test::valueAt<std::uint16_t>(bytes, kTimeOffsetAt), 1500);
  EXPECT_EQ(test::valueAt<double>(bytes, kEarliestAt), -49999999.75);
  EXPECT_EQ(test::valueAt<double>(bytes, kLatestAt), -49999899.5);
  EXPECT_EQ(test::valueAt<double>(bytes, 393 + 22), -49999999.75);
  EXPECT_EQ(test::valueAt<double>(bytes, 393 + 30 + 22), 0.0);
  EXPECT_EQ(pointsOf(LasFile(path)).gps_time, p.gps_time);
  options.time_kind = TimeKind::week_seconds;
  EXPECT_THROW(LasWriter(path, options), UsageError);
  options.time_kind = TimeKind::adjusted_standard;
  options.version_minor = 4;
  EXPECT_THROW(LasWriter(path, options), UsageError);
  options = LasWriterOptions();
  options.version_minor = 5;
  options.point_format = 3;
  EXPECT_THROW(LasWriter(path, options), UsageError);
}

TEST(LasVersion, ToTheNewerVersionAndBackGivesTheSameBytes) {
  for (const int format : {6, 7, 8, 9, 10}) {
    LasBytes las;
    las.format = format;
    las.extra = 5;
    las.encoding = 1 | 16;
    las.vlrs = {LasBytes::vlr("unknown", 77, "payload")};
    las.evlrs = {LasBytes::evlr("someone", 5, std::string(300, 'w'))};
    las.after = "bytes behind the end";
    const LasFile file(writeVersion("in.las", las.str()));
    const auto path = test::scratch("las_version_back") / "newer.las";
    convertLasVersion(file, path, {5, 1250});
    const LasFile newer(path);
    EXPECT_EQ(newer.header().version_minor, 5);
    EXPECT_EQ(newer.info().time_shift, 250e6);
    EXPECT_EQ(newer.header().earliest_time, LasBytes::time(0) - 250e6);
    EXPECT_NEAR(pointsOf(newer).gps_time[4], LasBytes::time(4), 3e-8);
    std::string back = converted(newer, "back.las", {4, {}});
    ASSERT_EQ(back.size(), las.str().size());
    // Times near the offset have steps of 3e-8 s.
    for (unsigned i = 0; i < las.count; ++i) {
      const std::size_t time = las.offsetToPoints() + i * las.record(0).size() + 22;
      EXPECT_NEAR(test::valueAt<double>(back, time), LasBytes::time(i), 3e-8);
      const double exact = LasBytes::time(i);
      std::memcpy(&back[time], &exact, sizeof exact);
    }
    EXPECT_EQ(back, las.str()) << format;
    convertLasVersion(file, path, {5, {}});  // no offset: no time changes
    EXPECT_EQ(converted(LasFile(path), "same.las", {4, {}}), las.str()) << format;
  }
}

TEST(LasVersion, OlderFormatsGetTheirFields) {
  const int expected[] = {6, 6, 7, 7, 9, 10};
  for (int format = 0; format <= 5; ++format) {
    LasBytes las;
    las.minor = format < 4 ? 2 : 3;
    las.format = format;
    las.count = 40;
    las.extra = 3;
    const LasFile file(writeVersion("older.las", las.str()));
    const auto path = test::scratch("las_version_older") / "out.laz";
    const LasRewriteResult result = convertLasVersion(file, path, {5, {}});
    EXPECT_EQ(result.points, 40U);
    const LasFile out(path);
    ASSERT_EQ(out.header().point_format, expected[format]);
    EXPECT_EQ(out.header().global_encoding, 1 | 16);
    const PointChunk p = pointsOf(file), q = pointsOf(out);
    EXPECT_EQ(q.x, p.x);
    EXPECT_EQ(q.z, p.z);
    EXPECT_EQ(q.gps_time, p.gps_time);
    EXPECT_EQ(q.return_number, p.return_number);
    EXPECT_EQ(q.user_data, p.user_data);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const bool overlap = p.classification[i] == 12;
      EXPECT_EQ(q.classification[i], overlap ? 1 : p.classification[i]);
      EXPECT_EQ(q.flags[i], p.flags[i] | (overlap ? kOverlap : 0));
      EXPECT_NEAR(q.scan_angle[i], p.scan_angle[i], 0.0031);
    }
    std::vector<std::byte> record(out.header().record_length);
    out.readRecords(7, 1, record.data());
    const LasRecordLayout layout = out.layout();
    EXPECT_EQ(record.size(), layout.length + 3);
    EXPECT_EQ(record[layout.length + 2], std::byte{0xA2});
    if (las.hasColour()) {
      EXPECT_EQ(loadLas<std::uint16_t>(&record[layout.rgb + 2]), 2007);
    }
    if (las.hasWaveform()) {
      EXPECT_EQ(loadLas<std::uint64_t>(&record[layout.waveform + 1]), 60U + 256 * 7);
    }
  }
}

TEST(LasVersion, RefusesWhatAVersionCannotHold) {
  LasBytes las;
  las.encoding = 16;
  const LasFile week(writeVersion("week.las", las.str()));
  EXPECT_THROW(converted(week, "a.las", {5, 1500}), InputError);
  EXPECT_THROW(converted(week, "a.las", {4, 1500}), UsageError);
  EXPECT_THROW(converted(week, "a.las", {3, {}}), UsageError);
  EXPECT_THROW(convertLasVersion(week, week.path(), {5, {}}), UsageError);
  EXPECT_EQ(test::valueAt<std::uint16_t>(converted(week, "a.las", {5, {}}), kEncodingAt), 16);
}

/// What PROJ does not know stays, and keys under the encoding of a WKT become one.
TEST(LasVersion, KeepsTheCrs) {
  LasBytes las;
  las.encoding = 1 | 16;
  las.vlrs = {LasBytes::vlr("LASF_Projection", 2112, "PROJCS[x]")};
  const auto path = test::scratch("las_version_crs") / "newer.las";
  convertLasVersion(LasFile(writeVersion("text.las", las.str())), path, {5, {}});
  EXPECT_EQ(LasFile(path).crs(), "PROJCS[x]");
  EXPECT_EQ(converted(LasFile(path), "back.las", {4, {}}), las.str());
  test::Bytes keys;  // a transverse Mercator projection of its own
  keys.u16(1).u16(1).u16(0).u16(7);
  for (const auto& [key, value] : std::initializer_list<std::pair<unsigned, unsigned>>{
           {1024, 1}, {2048, 4258}, {3072, 32767}, {3074, 32767}, {3075, 1}})
    keys.u16(key).u16(0).u16(1).u16(value);
  keys.u16(3080).u16(34736).u16(1).u16(0).u16(3082).u16(34736).u16(1).u16(1);
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, keys.str()),
              LasBytes::vlr("LASF_Projection", 34736, test::Bytes().f64(9.5).f64(5e5).str())};
  const LasFile old(writeVersion("keys.las", las.str()));
  convertLasVersion(old, path, {5, {}});
  const LasFile newer(path);
  ASSERT_EQ(newer.vlrs().size(), 1U);
  EXPECT_EQ(newer.vlrs()[0].record_id, 2112);
  EXPECT_NE(newer.crs().find("\"central_meridian\",9.5"), std::string::npos) << newer.crs();
}

TEST(LasVersion, ReadsPointsWithAWrongNumberOfVlrs) {
  for (const std::uint32_t announced : {2U, 4294967295U}) {
    LasBytes las;
    las.vlrs = {LasBytes::vlr("someone", 1, "0123456789")};
    const std::string right = las.str();
    std::string bytes = right;
    std::memcpy(&bytes[100], &announced, sizeof announced);
    const LasFile file(writeVersion("vlrs.las", bytes));
    EXPECT_EQ(file.vlrs().size(), 1U);
    EXPECT_EQ(pointsOf(file).size(), 5U);
    ASSERT_EQ(file.remarks().size(), 1U);
    EXPECT_NE(file.remarks()[0].find("room for 1 before the points"), std::string::npos);
    const auto copy = test::scratch("las_version_vlrs") / "copy.las";
    rewriteLas(file, copy, [](const LasRecordBlock&) {});
    EXPECT_EQ(test::readBytes(copy), right) << "the copy has the right number";
  }
}

TEST(LasVersion, AVlrThatReachesIntoThePointsIsDamage) {
  LasBytes las;
  las.vlrs = {LasBytes::vlr("someone", 1, "0123456789"), LasBytes::vlr("someone", 2, "0123456789")};
  std::string bytes = las.str();
  const std::uint16_t length = 60000;
  std::memcpy(&bytes[375 + 64 + 20], &length, sizeof length);
  const auto path = writeVersion("long.las", bytes);
  EXPECT_THROW(LasFile{path}, DamagedFile);
  const LasFile kept(path, kLazAllFields, LasDamage::keep_intact);
  EXPECT_EQ(kept.vlrs().size(), 1U);
  EXPECT_EQ(pointsOf(kept).size(), 5U);
  ASSERT_EQ(kept.remarks().size(), 1U);
  EXPECT_NE(kept.remarks()[0].find("reaches past the beginning"), std::string::npos);
}

TEST(LasVersion, ANegativeScaleReversesAnAxis) {
  std::string bytes = LasBytes().str();
  const double scale = -0.001;
  std::memcpy(&bytes[139], &scale, sizeof scale);
  const LasFile file(writeVersion("negative.las", bytes));
  EXPECT_EQ(pointsOf(file).y[2], LasBytes::Y(2) * -0.001 + LasBytes().offset_y);
  EXPECT_EQ(file.info().resolution.y(), 0.001);
  const auto moved = test::scratch("las_version_negative") / "moved.las";
  rewriteLas(file, moved, [](const LasRecordBlock& block) {
    storeLas(block.records + 4, loadLas<std::int32_t>(block.records + 4) - 100);
  });
  const LasFile out(moved);
  EXPECT_EQ(pointsOf(out).y[0], (LasBytes::Y(0) - 100) * -0.001 + LasBytes().offset_y);
  EXPECT_EQ(out.header().minimum.y(), LasBytes::Y(1) * -0.001 + LasBytes().offset_y);
  EXPECT_EQ(out.header().maximum.y(), (LasBytes::Y(0) - 100) * -0.001 + LasBytes().offset_y)
      << "steps: the first point 100 further than -2000000, the last at -2000044";
}

}  // namespace
}  // namespace pcl_als
