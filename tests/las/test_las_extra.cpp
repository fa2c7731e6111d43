// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>

#include "las_bytes.h"
#include "las_descriptor.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::Descriptor;
using test::extraBytesVlr;
using test::LasBytes;

constexpr std::size_t kRecord = 30;  ///< of point format 6
constexpr double kInfiniteValue = std::numeric_limits<double>::infinity();

std::string described(unsigned type, const std::string& name, unsigned options = 0) {
  Descriptor descriptor;
  descriptor.type = type, descriptor.name = name, descriptor.options = options;
  return descriptor.str();
}

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* at = reinterpret_cast<const std::byte*>(text.data());
  return {at, at + text.size()};
}

LasExtraBytes joined(const std::vector<std::string>& payloads, std::size_t record_length) {
  std::vector<std::vector<std::byte>> bytes;
  for (const std::string& payload : payloads) bytes.push_back(bytesOf(payload));
  return joinLasExtraBytes(bytes, kRecord, record_length);
}

/// The descriptors of a file, which must be in one VLR and describe its records completely.
std::string onlyDescription(const LasFile& file) {
  std::string found;
  int records = 0;
  for (const LasVlrEntry& vlr : file.vlrs()) {
    if (vlr.user_id != "LASF_Spec" || vlr.record_id != 4) continue;
    ++records;
    EXPECT_FALSE(vlr.extended);
    const std::vector<std::byte> payload = file.payload(vlr);
    found.assign(reinterpret_cast<const char*>(payload.data()), payload.size());
  }
  EXPECT_EQ(records, 1);
  EXPECT_EQ(found.size() % 192, 0U);
  std::size_t end = file.layout().length;
  for (const LasExtraField& field : file.extraFields()) {
    EXPECT_EQ(field.position, end);
    end += field.size;
  }
  EXPECT_EQ(end, file.header().record_length);
  EXPECT_TRUE(file.extraBytes().remarks.empty());
  return found;
}

/// Extends a file by a double and checks that every byte of its records is still there.
std::string extended(const LasBytes& las, const std::string& extension = ".las") {
  const auto folder = test::scratch("las_extra_extended");
  test::writeBytes(folder / "in.las", las.str());
  const LasFile in(folder / "in.las");
  LasExtraField field;
  field.name = "added", field.type = LasExtraType::f64;
  const std::size_t at = placeExtension(in, {field}).front().position;
  EXPECT_EQ(at, in.header().record_length);
  const std::filesystem::path path = folder / ("out" + extension);
  extendLas(in, path, {{field}, 0}, [at](const LasRecordBlock& block) {
    for (std::size_t i = 0; i < block.count; ++i)
      storeLas(block.records + i * block.record_length + at, 0.5 * static_cast<double>(i));
  });
  const LasFile out(path);
  EXPECT_EQ(out.header().record_length, in.header().record_length + 8U);
  std::vector<std::byte> records(las.count * out.header().record_length);
  out.readRecords(0, las.count, records.data());
  for (unsigned i = 0; i < las.count; ++i) {
    const auto* record = reinterpret_cast<const char*>(&records[i * out.header().record_length]);
    EXPECT_EQ(std::string(record, in.header().record_length), las.record(i)) << i;
  }
  EXPECT_EQ(out.extraFields().back().name, "added");
  EXPECT_EQ(out.extraFields().back().position, at);
  return onlyDescription(out);
}

TEST(LasExtra, AllRecordsAreOneDescription) {
  const LasExtraBytes extra =
      joined({described(3, "first"), described(9, "second") + described(2, "third")}, 37);
  ASSERT_EQ(extra.fields.size(), 3U);
  EXPECT_EQ(extra.fields[1].name, "second");
  EXPECT_EQ(extra.fields[1].position, 32U);
  EXPECT_EQ(extra.fields[2].position, 36U);
  EXPECT_EQ(extra.end, 37U);
  EXPECT_EQ(extra.descriptors,
            bytesOf(described(3, "first") + described(9, "second") + described(2, "third")));
  EXPECT_TRUE(extra.remarks.empty());
}

TEST(LasExtra, FieldsWithoutRoomAreIgnoredWithThoseBehind) {
  // The last one would have room, but where it lies is not known.
  const LasExtraBytes extra =
      joined({described(3, "first") + described(10, "double") + described(1, "byte")}, 35);
  ASSERT_EQ(extra.fields.size(), 1U);
  EXPECT_EQ(extra.end, 32U);
  ASSERT_EQ(extra.remarks.size(), 1U);
  EXPECT_EQ(extra.remarks[0],
            "extra field 'double' of 8 bytes at byte 32 has no room in records of 35 bytes; it and "
            "1 behind it are ignored");
}

TEST(LasExtra, TypesOfUnknownSizeEndTheDescription) {
  const LasExtraBytes extra = joined({described(31, "new") + described(1, "byte")}, 60);
  EXPECT_TRUE(extra.fields.empty());
  ASSERT_EQ(extra.remarks.size(), 1U);
  EXPECT_EQ(extra.remarks[0],
            "extra field 'new' has the unknown type 31; it and 1 behind it are ignored");
}

TEST(LasExtra, AnIncompleteDescriptorIsIgnored) {
  const LasExtraBytes extra =
      joined({described(3, "first") + std::string(100, 'x'), described(5, "second")}, 36);
  ASSERT_EQ(extra.fields.size(), 2U);
  EXPECT_EQ(extra.fields[1].position, 32U);
  ASSERT_EQ(extra.remarks.size(), 1U);
  EXPECT_NE(extra.remarks[0].find("the last 100 bytes"), std::string::npos);
}

TEST(LasExtra, UndocumentedBytesHaveTheirSizeInTheOptions) {
  const LasExtraBytes extra =
      joined({described(0, "blob", 12) + described(0, "nothing") + described(4, "i16")}, 44);
  ASSERT_EQ(extra.fields.size(), 2U);
  EXPECT_EQ(extra.fields[0].size, 12U);
  EXPECT_EQ(lasExtraTypeName(extra.fields[0]), "undocumented, 12 bytes");
  EXPECT_EQ(extra.fields[1].position, 42U);
  EXPECT_EQ(extra.remarks.size(), 1U);
}

TEST(LasExtra, DeprecatedArraysHaveTwoOrThreeComponents) {
  const LasExtraBytes extra = joined({described(13, "pair") + described(29, "triple")}, 46);
  ASSERT_EQ(extra.fields.size(), 2U);
  EXPECT_EQ(extra.fields[0].size, 4U);
  EXPECT_EQ(lasExtraTypeName(extra.fields[0]), "2 x uint16");
  EXPECT_EQ(extra.fields[1].size, 12U);
  EXPECT_EQ(lasExtraTypeName(extra.fields[1]), "3 x float");
  EXPECT_EQ(extra.end, 46U);
}

TEST(LasExtra, RepeatedNamesAreNotChosenFrom) {
  const LasExtraBytes extra = joined({described(3, "same"), described(3, "same")}, 34);
  EXPECT_EQ(extra.fields.size(), 2U);
  ASSERT_EQ(extra.remarks.size(), 1U);
  EXPECT_EQ(extra.remarks[0], "2 extra fields have the same name 'same'");
  EXPECT_EQ(findLasExtraField(extra.fields, "other", "a.las"), nullptr);
  EXPECT_EQ(test::messageOf<InputError>([&] { findLasExtraField(extra.fields, "same", "a.las"); }),
            "a.las: has several extra fields 'same'; rename all but one");
}

TEST(LasExtra, ValuesAreScaledAndMayBeMissing) {
  Descriptor descriptor;
  descriptor.name = "value", descriptor.type = 9, descriptor.options = 1 | 8 | 16;
  descriptor.no_data = -1.0, descriptor.scale = 0.5, descriptor.offset = 100.0;
  const LasExtraBytes extra = joined({descriptor.str()}, 34);
  std::vector<std::byte> records(3 * 34);
  storeLas(&records[30], 8.0F);
  storeLas(&records[34 + 30], -1.0F);
  storeLas(&records[68 + 30], 1.0F);
  std::vector<double> values;
  decodeLasExtraField(records.data(), 3, 34, extra.fields[0], values);
  EXPECT_EQ(values[0], 104.0);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 100.5);
  EXPECT_EQ(joinLasExtraBytes({serialiseLasExtraFields(extra.fields)}, 30, 34).fields[0].no_data,
            -1.0);
}

// A double of the bits of an integer would be next to zero.
TEST(LasExtra, MissingIntegersAreIntegersOfTheDescriptor) {
  LasExtraField field;
  field.type = LasExtraType::i16, field.no_data = -32768.0;
  const std::vector<std::byte> descriptor = serialiseLasExtraFields({field});
  EXPECT_EQ(loadLas<std::int64_t>(&descriptor[40]), -32768);
  EXPECT_EQ(joinLasExtraBytes({descriptor}, 30, 32).fields[0].no_data, -32768.0);
}

TEST(LasExtra, ImpossibleScalesAreReplaced) {
  Descriptor zero, infinite;
  zero.name = "zero", zero.options = 8 | 16, zero.offset = 3.0;
  infinite.name = "infinite", infinite.options = 8 | 16;
  infinite.scale = kInfiniteValue, infinite.offset = std::nan("");
  const LasExtraBytes extra = joined({zero.str() + infinite.str()}, 34);
  EXPECT_EQ(extra.fields[0].scale, 1.0);
  EXPECT_EQ(extra.fields[0].offset, 3.0);
  EXPECT_EQ(extra.fields[1].scale, 1.0);
  EXPECT_EQ(extra.fields[1].offset, 0.0);
  EXPECT_EQ(extra.remarks.size(), 3U);
}

TEST(LasExtra, FilesWithSeveralRecordsAreReadAndExtended) {
  LasBytes las;
  las.extra = 6;
  las.vlrs = {extraBytesVlr(described(3, "first", 6)), LasBytes::vlr("unknown", 77, "payload"),
              extraBytesVlr(described(9, "second"))};
  const auto folder = test::scratch("las_extra_several");
  test::writeBytes(folder / "in.las", las.str());
  const LasFile in(folder / "in.las");
  ASSERT_EQ(in.extraFields().size(), 2U);
  EXPECT_EQ(in.extraFields()[1].position, kRecord + 2);
  EXPECT_EQ(in.extraBytes().remarks.size(), 1U);
  // Minimum, maximum and reserved bytes of the descriptors are kept.
  const std::string expected = described(3, "first", 6) + described(9, "second");
  EXPECT_EQ(extended(las).substr(0, 384), expected);
  EXPECT_EQ(extended(las, ".laz").substr(0, 384), expected);
}

TEST(LasExtra, ExtensionDropsFieldsWithoutRoom) {
  LasBytes las;
  las.extra = 4;
  las.vlrs = {extraBytesVlr(described(3, "first") + described(10, "double"))};
  const std::string description = extended(las);
  ASSERT_EQ(description.size(), 3U * 192);  // first, undocumented, added
  EXPECT_EQ(description.substr(0, 192), described(3, "first"));
  EXPECT_EQ(description[192 + 2], 0);
  EXPECT_EQ(description[192 + 3], 2);  // bytes that no field describes
}

TEST(LasExtra, ExtensionRepairsIncompleteDescriptors) {
  LasBytes las;
  las.extra = 3;
  las.vlrs = {extraBytesVlr(described(3, "first") + std::string(57, 'x')),
              extraBytesVlr(described(1, "second"))};
  EXPECT_EQ(extended(las).substr(0, 384), described(3, "first") + described(1, "second"));
}

TEST(LasExtra, ExtensionMovesADescriptionFromAnExtendedRecord) {
  LasBytes las;
  las.extra = 6;
  las.vlrs = {extraBytesVlr(described(3, "first"))};
  las.evlrs = {LasBytes::evlr("unknown", 7, "before"),
               LasBytes::evlr("LASF_Spec", 4, described(9, "second")),
               LasBytes::evlr("unknown", 8, "behind")};
  las.after = "bytes behind the end";
  EXPECT_EQ(extended(las).substr(0, 384), described(3, "first") + described(9, "second"));
  const auto folder = std::filesystem::path(PCL_ALS_TEST_SCRATCH) / "las_extra_extended";
  const LasFile out(folder / "out.las");
  EXPECT_EQ(out.header().evlr_count, 2U);
  EXPECT_EQ(out.vlrs().back().record_id, 8);
  EXPECT_EQ(out.payload(out.vlrs().back()), bytesOf("behind"));
  const std::string bytes = test::readBytes(folder / "out.las");
  EXPECT_EQ(bytes.substr(bytes.size() - las.after.size()), las.after);
}

TEST(LasExtra, MoreFieldsThanAVlrHoldsAreRefused) {
  LasBytes las;
  las.extra = 341;
  std::string descriptors;
  for (int i = 0; i < 341; ++i) descriptors += described(1, "f" + std::to_string(i));
  las.vlrs = {extraBytesVlr(descriptors)};
  const auto folder = test::scratch("las_extra_full");
  test::writeBytes(folder / "in.las", las.str());
  const LasFile in(folder / "in.las");
  EXPECT_EQ(in.extraFields().size(), 341U);
  LasExtraField field;
  field.name = "added";
  EXPECT_THROW(extendLas(in, folder / "out.las", {{field}, 0}, [](const LasRecordBlock&) {}),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.las"));
}

}  // namespace
}  // namespace pcl_als
