// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/las/las_file.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::Bytes;
using test::LasBytes;

std::filesystem::path put(const std::string& name, const std::string& bytes) {
  static const std::filesystem::path folder = test::scratch("las_file");
  test::writeBytes(folder / name, bytes);
  return folder / name;
}

PointChunk readAll(const LasFile& file) {
  const LasHeader& h = file.header();
  std::vector<std::byte> records(h.point_count * h.record_length);
  file.readRecords(0, h.point_count, records.data());
  PointChunk chunk;
  decodeLasRecords(records.data(), h.point_count, h.record_length, file.layout(), h.scale, h.offset,
                   chunk);
  return chunk;
}

TEST(LasHeader, SensorIsASystemIdentifierThatNamesNoProcess) {
  LasHeader header;
  for (const char* process : {"", "OTHER", "MERGE", "EXTRACTION", "PDAL", "LAStools (c) by X"}) {
    header.system_id = process;
    EXPECT_EQ(header.sensor(), "") << process;
  }
  header.system_id = "VQ-780 II S/N 2223355";
  EXPECT_EQ(header.sensor(), "VQ-780 II S/N 2223355");
}

/// Every version with every point format, also those that a version's specification does not list.
class LasFileMatrix : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  LasBytes las() const {
    LasBytes las;
    std::tie(las.minor, las.format) = GetParam();
    las.extra = 3;
    return las;
  }
};

TEST_P(LasFileMatrix, DecodesEveryField) {
  const LasBytes las = this->las();
  const LasFile file(put("matrix.las", las.str()));
  EXPECT_EQ(file.header().point_count, las.count);
  EXPECT_EQ(file.header().record_length, las.record(0).size());
  const PointChunk p = readAll(file);
  ASSERT_EQ(p.size(), las.count);
  for (unsigned i = 0; i < las.count; ++i) {
    // Exact: the same product and sum in double.
    EXPECT_EQ(p.x[i], LasBytes::X(i) * las.scale + las.offset_x);
    EXPECT_EQ(p.y[i], LasBytes::Y(i) * las.scale + las.offset_y);
    EXPECT_EQ(p.z[i], LasBytes::Z(i) * las.scale + las.offset_z);
    EXPECT_EQ(p.intensity[i], 300.0F + static_cast<float>(i));
    EXPECT_EQ(p.gps_time[i], las.hasTime() ? LasBytes::time(i) : 0.0);
    EXPECT_EQ(p.point_source_id[i], LasBytes::source(i));
    EXPECT_EQ(p.return_number[i], LasBytes::returnNumber(i));
    EXPECT_EQ(p.number_of_returns[i], 3);
    EXPECT_EQ(p.classification[i], las.classOf(i));
    const int flags = las.extended() ? kKeyPoint | kOverlap | kScanDirection | 2 << 6
                                     : kWithheld | kEdgeOfFlightLine;
    EXPECT_EQ(p.flags[i], flags);
    const float angle = las.extended() ? (-2500.0F - static_cast<float>(i)) * 0.006F
                                       : -15.0F - static_cast<float>(i);
    EXPECT_FLOAT_EQ(p.scan_angle[i], angle);
  }
}

TEST_P(LasFileMatrix, EncodingReturnsTheBytes) {
  LasBytes las = this->las();
  las.extra = 0;
  const LasFile file(put("encode.las", las.str()));
  const PointChunk p = readAll(file);
  std::vector<std::byte> records(las.count * file.header().record_length);
  encodeLasRecords(p, file.header().record_length, file.layout(), file.header().scale,
                   file.header().offset, 0, "encode.las", records.data());
  for (unsigned i = 0; i < las.count; ++i) {
    std::string expected = las.record(i);
    const std::size_t kept =  // PointChunk has no colours and no waveform
        las.hasTime() ? file.layout().gps_time + 8U : file.layout().point_source_id + 2U;
    expected.replace(kept, std::string::npos, expected.size() - kept, '\0');
    const char* at = reinterpret_cast<const char*>(&records[i * expected.size()]);
    EXPECT_EQ(std::string(at, expected.size()), expected) << "point " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(VersionsAndFormats, LasFileMatrix,
                         testing::Combine(testing::Values(2, 3, 4, 5), testing::Range(0, 11)));

TEST(LasFile, ListsVlrsAndEvlrs) {
  LasBytes las;
  las.vlrs = {LasBytes::vlr("LASF_Projection", 2112, "WKT[]"), LasBytes::vlr("someone", 9, "")};
  las.evlrs = {LasBytes::evlr("LASF_Spec", 65535, std::string(70000, 'w'))};
  las.between = "unknown bytes";
  const LasFile file(put("vlrs.las", las.str()));
  ASSERT_EQ(file.vlrs().size(), 3U);
  EXPECT_EQ(file.vlrs()[0].user_id, "LASF_Projection");
  EXPECT_EQ(file.vlrs()[0].description, "made by hand");
  EXPECT_EQ(file.vlrs()[1].record_id, 9);
  EXPECT_TRUE(file.vlrs()[2].extended);
  EXPECT_EQ(file.vlrs()[2].length, 70000U);
  EXPECT_EQ(file.payload(file.vlrs()[2]).back(), std::byte{'w'});
  EXPECT_THROW(file.payload(file.vlrs()[2], 60000), InputError);
}

TEST(LasFile, ReadsTheCrsThatTheEncodingPrefers) {
  LasBytes las;
  const std::string keys = Bytes()
                               .u16(1)
                               .u16(1)
                               .u16(0)
                               .u16(2)
                               .u16(1024)
                               .u16(0)
                               .u16(1)
                               .u16(1)
                               .u16(3072)
                               .u16(0)
                               .u16(1)
                               .u16(28992)
                               .str();
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, keys),
              LasBytes::vlr("LASF_Projection", 2112, std::string("PROJCS[x]\0\0", 11))};
  las.encoding = 1;
  EXPECT_EQ(LasFile(put("crs.las", las.str())).crs(), "EPSG:28992");
  las.encoding = 17;
  EXPECT_EQ(LasFile(put("crs.las", las.str())).crs(), "PROJCS[x]");
  las.vlrs.pop_back();
  EXPECT_EQ(LasFile(put("crs.las", las.str())).crs(), "EPSG:28992");
  las.vlrs.clear();
  EXPECT_EQ(LasFile(put("crs.las", las.str())).crs(), "");
}

/// A key directory of (key, value) for the payload of LASF_Projection 34735.
std::string keysOf(const std::vector<std::pair<unsigned, unsigned>>& keys) {
  Bytes bytes;
  bytes.u16(1).u16(1).u16(0).u16(static_cast<unsigned>(keys.size()));
  for (const auto& [key, value] : keys) bytes.u16(key).u16(0).u16(1).u16(value);
  return bytes.str();
}

PointFileInfo infoWith(const std::vector<std::pair<unsigned, unsigned>>& keys,
                       const std::string& wkt = {}, const Eigen::Vector3d& offset = {0, 0, 0}) {
  LasBytes las;
  las.encoding = 1;
  las.offset_x = offset.x(), las.offset_y = offset.y(), las.offset_z = offset.z();
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, keysOf(keys))};
  if (!wkt.empty()) las.vlrs.push_back(LasBytes::vlr("LASF_Projection", 2112, wkt));
  return LasFile(put("keys.las", las.str())).info();
}

TEST(LasFile, AUnitKeyDoesNotReplaceTheWkt) {
  const std::string wkt =
      "PROJCS[\"a\",GEOGCS[\"b\",DATUM[\"c\",SPHEROID[\"d\",6378137,298.257222101]],"
      "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
      "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
      "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",1],"
      "PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],UNIT[\"foot\",0.3048]]";
  const PointFileInfo same = infoWith({{1024, 1}, {3076, 9002}}, wkt);
  EXPECT_EQ(same.crs, wkt);
  EXPECT_EQ(same.units.source, "WKT");
  const PointFileInfo other = infoWith({{1024, 1}, {3076, 9001}}, wkt);
  EXPECT_EQ(other.crs, wkt);
  EXPECT_EQ(other.units.horizontal.metres, 0.3048);
  EXPECT_EQ(other.units.source, "WKT; GeoTIFF key 3076 states metre, not used");
}

TEST(LasFile, CodesThatProjDoesNotKnowAreNoCrs) {
  for (const unsigned code : {65535U, 1234U}) {
    const PointFileInfo info = infoWith({{1024, 1}, {3072, code}});
    EXPECT_EQ(info.crs, "");
    EXPECT_EQ(info.crs_ignored, "EPSG:" + std::to_string(code) + " is not known to PROJ");
  }
  EXPECT_EQ(infoWith({{1024, 1}, {3072, 65535}}, "PROJCS[x]").crs, "PROJCS[x]");
  EXPECT_EQ(infoWith({{1024, 1}}, "''").crs, "");
  EXPECT_EQ(infoWith({{1024, 1}}, "''").crs_ignored, "");
  EXPECT_EQ(infoWith({{1024, 1}}, "EPSG:65535").crs_ignored, "EPSG:65535 is not known to PROJ");
  EXPECT_EQ(infoWith({{1024, 1}, {3072, 32767}, {3075, 99}}).crs_ignored,
            "the definition in its GeoTIFF keys is not known");
}

TEST(LasFile, AnEmptyWktHidesNoOther) {
  LasBytes las;
  las.vlrs = {LasBytes::vlr("LASF_Projection", 2112, std::string(1, '\0')),
              LasBytes::vlr("LASF_Projection", 2112, "PROJCS[x]")};
  EXPECT_EQ(LasFile(put("wkts.las", las.str())).crs(), "PROJCS[x]");
}

TEST(LasFile, ACrsThatTheCoordinatesContradictIsIgnored) {
  const Eigen::Vector3d utm(500000, 5400000, 100), delft(3924687, 301132, 5001910);
  const PointFileInfo degrees = infoWith({{1024, 2}, {2048, 4326}}, {}, utm);
  EXPECT_EQ(degrees.crs_kind, CrsKind::unknown);
  EXPECT_NE(degrees.crs_ignored.find("EPSG:4326 is in degrees"), std::string::npos);
  const PointFileInfo geocentric = infoWith({{1024, 3}}, {}, utm);
  EXPECT_EQ(geocentric.crs_kind, CrsKind::unknown);
  EXPECT_NE(geocentric.crs_ignored.find("is geocentric"), std::string::npos);
  EXPECT_EQ(infoWith({{1024, 3}}, {}, delft).crs_kind, CrsKind::geocentric);
  EXPECT_EQ(infoWith({{1024, 3}, {2048, 4978}}, {}, delft).crs, "EPSG:4978");
  // Whichever of two records the encoding prefers.
  const PointFileInfo right = infoWith({{1024, 2}, {2048, 4326}}, crsAsWkt("EPSG:32632"), utm);
  EXPECT_EQ(right.crs, crsAsWkt("EPSG:32632"));
  EXPECT_EQ(right.crs_kind, CrsKind::projected);
  EXPECT_NE(right.crs_ignored.find("EPSG:4326 is in degrees"), std::string::npos);
}

TEST(LasFile, RecognisesAUtmZoneThatIsSpelledOut) {
  const auto crsOf = [](unsigned model, unsigned zone, double flattening) {
    LasBytes las;
    las.minor = 2;
    las.format = 1;
    Bytes keys;
    keys.u16(1).u16(1).u16(0).u16(6).u16(1024).u16(0).u16(1).u16(model);
    keys.u16(2048).u16(0).u16(1).u16(32767).u16(2057).u16(34736).u16(1).u16(0);
    keys.u16(2059).u16(34736).u16(1).u16(1).u16(3072).u16(0).u16(1).u16(32767);
    keys.u16(3074).u16(0).u16(1).u16(zone);
    const std::string doubles = Bytes().f64(6378137.0).f64(flattening).str();
    las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, keys.str()),
                LasBytes::vlr("LASF_Projection", 34736, doubles)};
    return LasFile(put("utm.las", las.str())).crs();
  };
  EXPECT_EQ(crsOf(1, 16011, 298.257223563), "EPSG:32611");
  EXPECT_EQ(crsOf(1, 16156, 298.257223563), "EPSG:32756");
  // GRS 80: some other datum, so that it is the projection only.
  const std::string other = crsOf(1, 16011, 298.257222101);
  EXPECT_NE(other.find("PARAMETER[\"central_meridian\",-117]"), std::string::npos) << other;
  EXPECT_NE(other.find("298.257222101"), std::string::npos) << other;
  EXPECT_EQ(crsOf(1, 12345, 298.257223563), "");
  EXPECT_EQ(crsOf(3, 16011, 298.257223563), "");  // geocentric
}

TEST(LasFile, TellsTheKindOfTime) {
  LasBytes las;
  EXPECT_EQ(LasFile(put("time.las", las.str())).info().time_kind, TimeKind::adjusted_standard);
  las.encoding = 0;
  EXPECT_EQ(LasFile(put("time.las", las.str())).info().time_kind, TimeKind::week_seconds);
  las.minor = 2;
  las.format = 2;
  EXPECT_EQ(LasFile(put("time.las", las.str())).info().time_kind, TimeKind::none);
}

TEST(LasFile, TakesTheLegacyCountWhereTheNewOneIsMissing) {
  LasBytes las;
  las.format = 1;
  std::string bytes = las.str();
  bytes.replace(247, 8, 8, '\0');
  EXPECT_EQ(LasFile(put("legacy.las", bytes)).header().point_count, las.count);
}

TEST(LasFile, KeepsMillimetresAtLargeCoordinates) {
  LasBytes las;
  las.offset_x = 583394.0;
  las.offset_y = 5283100.0;
  const LasFile file(put("large.las", las.str()));
  const PointChunk p = readAll(file);
  // 1e-9 m: a few units in the last place of a double at 5e6.
  EXPECT_NEAR(p.y[1] - p.y[0], -0.011, 1e-9);
}

TEST(LasFile, AnEmptyPointTableIsNoError) {
  LasBytes las;
  las.count = 0;
  EXPECT_EQ(LasFile(put("none.las", las.str())).header().point_count, 0U);
}

TEST(LasFile, RefusesRecordsPastTheEnd) {
  const LasFile file(put("past.las", LasBytes().str()));
  std::vector<std::byte> out(1000);
  EXPECT_THROW(file.readRecords(3, 3, out.data()), UsageError);
}

TEST(LasFile, AFileCutWhileOpenIsAnError) {
  LasBytes las;
  las.count = 10000;
  const auto path = put("cut.las", las.str());
  const LasFile file(path);
  std::filesystem::resize_file(path, 1000);
  std::vector<std::byte> out(las.count * file.header().record_length);
  EXPECT_THROW(file.readRecords(0, las.count, out.data()), InputError);
}

/// One way in which a file can be wrong, and a part of the message that names it.
struct Corruption {
  const char* name;
  const char* message;
  std::function<void(std::string&)> apply;
};

template <typename T>
std::function<void(std::string&)> set(std::size_t at, T value) {
  return [=](std::string& bytes) { std::memcpy(&bytes[at], &value, sizeof value); };
}
std::function<void(std::string&)> cut(std::size_t size) {
  return [=](std::string& bytes) { bytes.resize(size); };
}

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

// Positions of the fields: LAS 1.4 R15, table 3. The file has header 375, a VLR of 54 + 20 bytes,
// 5 records of 30 bytes from 449 on, an EVLR of 60 + 8 bytes.
const Corruption kCorruptions[] = {
    {"Empty", "the file is empty", cut(0)},
    {"ThreeBytes", "is not a LAS file", cut(3)},
    {"NotLas", "is not a LAS file", set(0, 'X')},
    {"HeaderCut", "header is truncated", cut(200)},
    {"HeaderCutIn14", "header is truncated", cut(300)},
    {"Major2", "version 2.4 is not supported", set<std::uint8_t>(24, 2)},
    {"Minor5", "says it has 375 bytes; version 1.5 has 393", set<std::uint8_t>(25, 5)},
    {"Minor6", "version 1.6 is not supported", set<std::uint8_t>(25, 6)},
    {"HeaderSizeSmall", "says it has 227 bytes", set<std::uint16_t>(94, 227)},
    {"HeaderSizeLarge", "header is truncated", set<std::uint16_t>(94, 65535)},
    {"OffsetInHeader", "inside the header", set<std::uint32_t>(96, 100)},
    {"OffsetPastEnd", "truncated copy", set<std::uint32_t>(96, 4000000000U)},
    {"VlrLength", "reaches past the beginning of the points", set<std::uint16_t>(375 + 20, 21)},
    {"Format11", "point format 11 is not supported", set<std::uint8_t>(104, 11)},
    {"RecordShort", "too short for point format 6", set<std::uint16_t>(105, 29)},
    {"RecordZero", "too short for point format 6", set<std::uint16_t>(105, 0)},
    {"RecordLong", "declares 5 points but the file holds", set<std::uint16_t>(105, 65535)},
    {"CountLies", "declares 1000 points but the file holds 7", set<std::uint64_t>(247, 1000)},
    {"CountOverflows", "declares 18446744073709551615", set(247, ~std::uint64_t{0})},
    {"ScaleZero", "x scale is 0, so that all points", set(131, 0.0)},
    {"ScaleMinusZero", "y scale is 0, so that all points", set(139, -0.0)},
    {"ScaleNan", "z scale is", set(147, kNan)},
    {"ScaleInfinite", "x scale is inf", set(131, kInfinity)},
    {"ScaleHuge", "x scale is", set(131, 1e300)},
    {"OffsetNan", "y offset is not a number", set(163, kNan)},
    {"OffsetInfinite", "z offset is not a number", set(171, -kInfinity)},
    {"PointsCut", "the file holds 3 (truncated copy?)", cut(449 + 3 * 30 + 10)},
    {"EvlrStartInPoints", "before the end of the points", set<std::uint64_t>(235, 460)},
    {"EvlrStartPastEnd", "extended VLR 1 of 1 lies past", set(235, ~std::uint64_t{0} - 5)},
    {"EvlrCount", "extended VLR 2 of 9 lies past", set<std::uint32_t>(243, 9)},
    {"EvlrLength", "reaches past the end of the file", set(599 + 20, ~std::uint64_t{0})},
    {"EvlrCut", "reaches past the end of the file", cut(599 + 60 + 7)},
    {"Compressed", "\"laszip encoded\" that says how is missing", set<std::uint8_t>(104, 6 | 0x80)},
};

class LasFileCorrupt : public testing::TestWithParam<Corruption> {};

TEST_P(LasFileCorrupt, IsAnInputErrorThatNamesFileAndFault) {
  LasBytes las;
  las.vlrs = {LasBytes::vlr("someone", 1, std::string(20, 'v'))};
  las.evlrs = {LasBytes::evlr("someone", 2, "01234567")};
  std::string bytes = las.str();
  ASSERT_EQ(bytes.size(), 667U);
  EXPECT_NO_THROW(LasFile(put("good.las", bytes)));
  GetParam().apply(bytes);
  try {
    const LasFile file(put("corrupt.las", bytes));
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("corrupt.las: "), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, LasFileCorrupt, testing::ValuesIn(kCorruptions),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(LasFile, MissingFileAndFolderAreInputErrors) {
  const auto folder = test::scratch("las_file_missing");
  EXPECT_THROW(LasFile(folder / "none.las"), InputError);
  EXPECT_THROW(LasFile{folder}, InputError);
}

}  // namespace
}  // namespace pcl_als
