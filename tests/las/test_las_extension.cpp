// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/las/recorded_pose.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

LasExtraField fieldNamed(const std::string& name, LasExtraType type) {
  LasExtraField field;
  field.name = name;
  field.type = type;
  return field;
}

const std::vector<LasExtraField> kTwo = {fieldNamed("first", LasExtraType::u16),
                                         fieldNamed("second", LasExtraType::f32)};

/// first = number of the record, second = half of it.
void fill(const LasRecordBlock& block, const std::vector<LasExtraField>& fields) {
  for (std::size_t i = 0; i < block.count; ++i) {
    std::byte* record = block.records + i * block.record_length;
    const auto number = static_cast<std::uint16_t>(block.first + i);
    storeLas(record + fields[0].position, number);
    storeLas(record + fields[1].position, 0.5F * static_cast<float>(number));
  }
}

// Names as they are in use: of a drone's processing software, of PDAL, and others that are no pose.
TEST(RecordedPose, IsFoundByNames) {
  const auto named = [](const std::vector<std::string>& names) {
    std::vector<LasExtraField> fields;
    for (const std::string& name : names) fields.push_back(fieldNamed(name, LasExtraType::f64));
    return recordedPose(fields);
  };
  EXPECT_EQ(named({"frameNo", "SensorX", "SensorY", "SensorZ", "SensorRollRads", "SensorYawRads"}),
            "SensorX, SensorY, SensorZ, SensorRollRads, SensorYawRads");
  EXPECT_EQ(named({"BeamOrigin Z", "beam_origin_x", "BeamOriginY"}),
            "beam_origin_x, BeamOriginY, BeamOrigin Z");
  EXPECT_EQ(named({"NormalX", "NormalY", "NormalZ", "SensorX", "SensorY"}), "");
  EXPECT_EQ(named({}), "");
}

class LasExtensionMatrix : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(LasExtensionMatrix, KeepsEverythingAndAddsTheFields) {
  const auto folder = test::scratch("las_extension_matrix");
  test::writeBytes(folder / "in.las",
                   test::fullFile(std::get<0>(GetParam()), std::get<1>(GetParam()), 300).str());
  const LasFile in(folder / "in.las");
  const auto fields = placeExtension(in, kTwo);
  extendLas(
      in, folder / "out.las", {kTwo, 64}, [&](const LasRecordBlock& block) { fill(block, fields); },
      2);
  const LasFile out(folder / "out.las");
  EXPECT_EQ(out.header().point_count, 300U);
  EXPECT_EQ(out.header().record_length, in.header().record_length + 6);
  EXPECT_EQ(out.header().point_format, in.header().point_format);
  EXPECT_EQ(out.header().minimum, in.header().minimum);
  EXPECT_EQ(out.crs(), in.crs());
  // All VLRs are there with their payloads, and one more.
  ASSERT_EQ(out.vlrs().size(), in.vlrs().size() + 1);
  for (const LasVlrEntry& vlr : in.vlrs()) {
    const auto same = std::find_if(out.vlrs().begin(), out.vlrs().end(), [&](const LasVlrEntry& v) {
      return v.user_id == vlr.user_id && v.record_id == vlr.record_id;
    });
    ASSERT_NE(same, out.vlrs().end());
    EXPECT_EQ(out.payload(*same), in.payload(vlr));
  }
  // The undescribed 5 bytes, then ours, where they were placed.
  ASSERT_EQ(out.extraFields().size(), 3U);
  EXPECT_EQ(out.extraFields()[0].size, 5U);
  EXPECT_EQ(out.extraFields()[1].position, fields[0].position);
  std::vector<std::byte> before(300U * in.header().record_length);
  std::vector<std::byte> after(300U * out.header().record_length);
  in.readRecords(0, 300, before.data());
  out.readRecords(0, 300, after.data());
  for (std::size_t i = 0; i < 300; ++i) {
    const std::byte* record = &after[i * out.header().record_length];
    ASSERT_EQ(
        std::memcmp(record, &before[i * in.header().record_length], in.header().record_length), 0);
  }
  std::vector<double> values;
  decodeLasExtraField(after.data(), 300, out.header().record_length, out.extraFields()[2], values);
  EXPECT_EQ(values[299], 149.5);
  // What is behind the points is there still.
  const std::string bytes = test::readBytes(folder / "out.las");
  EXPECT_EQ(bytes.substr(bytes.size() - 20), "bytes behind the end");
}

INSTANTIATE_TEST_SUITE_P(VersionsAndFormats, LasExtensionMatrix,
                         testing::Combine(testing::Values(2, 3, 4, 5),
                                          testing::Values(0, 1, 3, 6)));

TEST(LasExtension, ExtendsTheRecordThatIsThere) {
  const auto folder = test::scratch("las_extension_again");
  test::writeBytes(folder / "in.las", LasBytes().str());
  const LasEdit nothing = [](const LasRecordBlock&) {};
  extendLas(LasFile(folder / "in.las"), folder / "a.las", {kTwo, 0}, nothing);
  const LasFile a(folder / "a.las");
  extendLas(a, folder / "b.las", {{fieldNamed("third", LasExtraType::f64)}, 0}, nothing);
  const LasFile b(folder / "b.las");
  ASSERT_EQ(b.extraFields().size(), 3U);
  EXPECT_EQ(b.extraFields()[1].name, "second");
  EXPECT_EQ(b.extraFields()[2].name, "third");
  EXPECT_EQ(b.vlrs().size(), a.vlrs().size());
  EXPECT_THROW(placeExtension(b, {fieldNamed("first", LasExtraType::u8)}), UsageError);
}

TEST(LasExtension, WithoutFieldsIsACopy) {
  const auto folder = test::scratch("las_extension_none");
  const std::string bytes = test::fullFile(4, 6, 300).str();
  test::writeBytes(folder / "in.las", bytes);
  extendLas(LasFile(folder / "in.las"), folder / "out.las", LasExtension(),
            [](const LasRecordBlock&) {});
  EXPECT_EQ(test::readBytes(folder / "out.las"), bytes);
}

}  // namespace
}  // namespace pcl_als
