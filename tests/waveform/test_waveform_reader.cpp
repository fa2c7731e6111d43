// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "waveform_bytes.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::LasBytes;

/// The waveform of a point of a file.
Waveform waveformAt(const fs::path& path, std::uint64_t point) {
  const LasFile las(path);
  const WaveformSource source(las);
  WaveformReader reader(source);
  std::vector<std::byte> record(las.header().record_length);
  las.readRecords(point, 1, record.data());
  Waveform waveform;
  EXPECT_TRUE(reader.read(record.data(), point, waveform));
  return waveform;
}

std::string faultOf(const fs::path& path, std::uint64_t point = 0) {
  return test::messageOf<InputError>([&] { waveformAt(path, point); });
}

void expectPacket(const Waveform& waveform, unsigned packet) {
  ASSERT_EQ(waveform.counts.size(), 256U);
  for (unsigned k = 0; k < 256; ++k)
    ASSERT_EQ(waveform.counts[k], (3 * k + 7 * packet) % 256) << packet << ' ' << k;
}

class PointFormats : public testing::TestWithParam<int> {};

TEST_P(PointFormats, HavePacketsInAnotherFile) {
  const fs::path folder = test::scratch("reader_external_" + std::to_string(GetParam()));
  test::writeBytes(folder / "in.las", test::externalFile(GetParam()).str());
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  rewriteLas(folder / "in.las", folder / "packed.laz", [](const LasRecordBlock&) {});
  for (const char* name : {"in.las", "packed.laz"})
    for (const unsigned point : {4U, 0U, 2U}) {
      const Waveform waveform = waveformAt(folder / name, point);
      expectPacket(waveform, point);
      EXPECT_EQ(waveform.reference.descriptor, 1U);
      EXPECT_EQ(waveform.reference.location_ps, 12.5F);
      EXPECT_EQ(waveform.reference.direction, Eigen::Vector3f(1e-4F, 2e-4F, 3e-4F));
      EXPECT_EQ(waveform.volts(10), -2.0 + 0.5 * waveform.counts[10]);
    }
}

TEST_P(PointFormats, HavePacketsWithinTheFile) {
  const fs::path folder = test::scratch("reader_internal_" + std::to_string(GetParam()));
  LasBytes las = test::externalFile(GetParam());
  las.encoding = 1 | 2;
  if (las.minor >= 4) las.evlrs = {test::packetRecord(5)};
  std::string bytes = las.str();
  if (las.minor < 4) {
    test::put(bytes, 227, test::Bytes().u64(bytes.size()).str());
    bytes += test::packetRecord(5);
  }
  test::writeBytes(folder / "in.las", bytes);
  rewriteLas(folder / "in.las", folder / "packed.laz", [](const LasRecordBlock&) {});
  for (const char* name : {"in.las", "packed.laz"})
    for (const unsigned point : {3U, 1U}) expectPacket(waveformAt(folder / name, point), point);
}

INSTANTIATE_TEST_SUITE_P(All, PointFormats, testing::Values(4, 5, 9, 10));

TEST(WaveformReader, FindsPacketsInLas15) {
  const fs::path folder = test::scratch("reader_las15");
  LasBytes las = test::externalFile(9);
  las.minor = 5;
  test::writeBytes(folder / "in.las", las.str());
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  expectPacket(waveformAt(folder / "in.las", 2), 2);
}

TEST(WaveformReader, FindsPacketsBehindFourGigabytes) {
  const fs::path folder = test::scratch("reader_large");
  const std::uint64_t far = 5'000'000'000;
  const auto place = [&](const fs::path& file, std::uint64_t at, const std::string& bytes) {
    fs::resize_file(file, at);  // a hole, which takes no space
    std::ofstream(file, std::ios::binary | std::ios::app) << bytes;
  };
  LasBytes las = test::externalFile(4);
  std::string bytes = las.str();
  test::put(bytes, las.offsetToPoints() + 28, test::referenceBytes(1, far, 256));
  test::writeBytes(folder / "out.las", bytes);
  test::writeBytes(folder / "out.wdp", test::packetRecord(1));
  place(folder / "out.wdp", far, test::packetPayload(3).substr(512));
  expectPacket(waveformAt(folder / "out.las", 0), 2);

  las.encoding = 1 | 2;
  bytes = las.str();
  test::put(bytes, 227, test::Bytes().u64(far).str());
  test::writeBytes(folder / "in.las", bytes);
  place(folder / "in.las", far, test::packetRecord(5));
  expectPacket(waveformAt(folder / "in.las", 4), 4);
}

TEST(WaveformReader, UsesTheDescriptorOfEachPoint) {
  const fs::path folder = test::scratch("reader_descriptors");
  LasBytes las = test::externalFile(4);
  las.vlrs = {test::descriptorVlr(255, test::descriptorBytes(16, 3, 500)),
              test::descriptorVlr(1, test::descriptorBytes(8, 2))};
  std::string bytes = las.str();
  const std::size_t at = las.offsetToPoints() + 28, length = las.record(0).size();
  test::put(bytes, at, test::referenceBytes(255, 62, 6));
  test::put(bytes, at + length, test::referenceBytes(1, 60, 2));
  test::put(bytes, at + 2 * length, test::referenceBytes(0, 0, 0));
  test::writeBytes(folder / "in.las", bytes);
  test::writeBytes(folder / "in.wdp",
                   LasBytes::evlr("LASF_Spec", 65535,
                                  test::Bytes().u8(9).u8(250).u16(1).u16(513).u16(65535).str()));
  EXPECT_EQ(waveformAt(folder / "in.las", 0).counts, (std::vector<double>{1, 513, 65535}));
  EXPECT_EQ(waveformAt(folder / "in.las", 0).descriptor.spacing_ps, 500U);
  EXPECT_EQ(waveformAt(folder / "in.las", 1).counts, (std::vector<double>{9, 250}));

  const LasFile file(folder / "in.las");
  const WaveformSource source(file);
  WaveformReader reader(source);
  std::vector<std::byte> record(length);
  file.readRecords(2, 1, record.data());
  Waveform none;
  EXPECT_FALSE(reader.read(record.data(), 2, none));
}

TEST(WaveformSamples, OfAllSizesArePackedLeastSignificantBitFirst) {
  // 5, 1023, 512 in 10 bits: 0000000101 1111111111 1000000000, from the last bit to the first.
  const std::vector<std::byte> packed = packWaveform({5, 1023, 512}, 10);
  ASSERT_EQ(packed.size(), 4U);
  const std::uint32_t word = 5U | 1023U << 10U | 512U << 20U;
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::to_integer<unsigned>(packed[i]), word >> 8 * i & 255U);
  for (unsigned bits = 2; bits <= 32; ++bits) {
    WaveformDescriptor d;
    d.bits = bits;
    std::vector<double> counts;
    for (unsigned i = 0; i < 41; ++i)
      counts.push_back(std::floor(d.largestCount() * (i % 7) / 6.0));
    d.samples = static_cast<std::uint32_t>(counts.size());
    const std::vector<std::byte> bytes = packWaveform(counts, bits);
    ASSERT_EQ(bytes.size(), d.packedBytes());
    std::vector<double> back(counts.size());
    unpackWaveform(bytes.data(), bytes.size(), d, back.data());
    EXPECT_EQ(back, counts) << bits;
  }
  EXPECT_THROW(packWaveform({4}, 2), UsageError);
  EXPECT_THROW(packWaveform({-1}, 8), UsageError);
}

TEST(WaveformSamples, InWholeBytesAreKnownByTheSizeOfThePacket) {
  WaveformDescriptor d;
  d.bits = 12;
  d.samples = 3;
  const std::string aligned = test::Bytes().u16(4095).u16(1).u16(2048).str();
  std::vector<double> counts(3);
  unpackWaveform(reinterpret_cast<const std::byte*>(aligned.data()), aligned.size(), d,
                 counts.data());
  EXPECT_EQ(counts, (std::vector<double>{4095, 1, 2048}));
}

TEST(WaveformReference, GivesTheDirectionAwayFromTheSensor) {
  WaveformReference reference;
  reference.direction = Eigen::Vector3f(1e-5F, 0.0F, 1.5e-4F);  // towards an aircraft
  EXPECT_LT(reference.alongPulse().z(), 0.0);
  EXPECT_LT(reference.alongPulse().x(), 0.0);
  reference.direction = -reference.direction;
  EXPECT_LT(reference.alongPulse().z(), 0.0);
}

/// A file whose descriptor has the payload.
fs::path withDescriptor(const std::string& payload) {
  const fs::path folder = test::scratch("reader_damaged");
  LasBytes las = test::externalFile(4);
  las.vlrs = {test::descriptorVlr(1, payload)};
  test::writeBytes(folder / "in.las", las.str());
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  return folder / "in.las";
}

TEST(DamagedWaveforms, OfWrongDescriptorsAreNamed) {
  const auto fault = [](const std::string& payload) { return faultOf(withDescriptor(payload)); };
  const std::string start =
      withDescriptor("").string() + ": waveform packet descriptor (record 100)";
  EXPECT_EQ(fault("short"), start + " has 5 bytes instead of 26");
  EXPECT_EQ(fault(test::descriptorBytes(1, 256)),
            start + " describes 1 bit per sample; the specification allows 2 to 32");
  EXPECT_NE(fault(test::descriptorBytes(33, 256)).find("33 bits"), std::string::npos);
  // Without samples it describes nothing, and no other is there.
  EXPECT_NE(fault(test::descriptorBytes(8, 0, 0)).find("has no waveform packet descriptor"),
            std::string::npos);
  EXPECT_NE(fault(test::descriptorBytes(8, 256, 0)).find("0 ps"), std::string::npos);
  EXPECT_NE(fault(test::descriptorBytes(8, 256, 1000, 0.0)).find("gain of 0"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault(test::descriptorBytes(8, 256, 1000, 1.0, nan)).find("offset"), std::string::npos);
  EXPECT_NE(fault(test::descriptorBytes(8, 256, 1000, 1.0, 0.0, 3)).find("compression type 3"),
            std::string::npos);
  EXPECT_EQ(fault(test::descriptorBytes(8, 257)),
            withDescriptor("").string() +
                ": point 0: its waveform packet has 256 bytes, and descriptor 1 (record 100) "
                "describes 257 samples of 8 bits, 1000 ps apart, 257 bytes");
  EXPECT_NE(fault(test::descriptorBytes(32, 4'000'000'000U)).find("16000000000 bytes"),
            std::string::npos);
}

TEST(DamagedWaveforms, OfContradictoryDescriptorsAreRefused) {
  const fs::path folder = test::scratch("reader_twice");
  LasBytes las = test::externalFile(4);
  las.vlrs.push_back(las.vlrs[0]);
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  test::writeBytes(folder / "in.las", las.str());
  expectPacket(waveformAt(folder / "in.las", 1), 1);
  las.vlrs[1] = test::descriptorVlr(1, test::descriptorBytes(16, 128));
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_NE(faultOf(folder / "in.las").find("occurs twice"), std::string::npos);
}

TEST(DamagedWaveforms, OfWrongReferencesAreNamed) {
  const fs::path folder = test::scratch("reader_references");
  const LasBytes las = test::externalFile(4);
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  const auto fault = [&](const std::string& reference) {
    std::string bytes = las.str();
    test::put(bytes, las.offsetToPoints() + las.record(0).size() + 28, reference);
    test::writeBytes(folder / "in.las", bytes);
    return faultOf(folder / "in.las", 1);
  };
  const std::string start = (folder / "in.las").string() + ": point 1: ";
  EXPECT_EQ(fault(test::referenceBytes(7, 60, 256)),
            start + "the file has no waveform packet descriptor 7 (record 106)");
  EXPECT_EQ(fault(test::referenceBytes(1, 1085, 256)),
            start + "its waveform packet at byte 1085 reaches past the end of the packets in " +
                (folder / "in.wdp").string() + " (1340 bytes)");
  EXPECT_NE(fault(test::referenceBytes(1, ~std::uint64_t{0}, 256)).find("reaches past"),
            std::string::npos);
  EXPECT_NE(fault(test::referenceBytes(1, 60, 255)).find("255 bytes"), std::string::npos);
  EXPECT_NE(fault(test::referenceBytes(1, 60, 256, NAN)).find("no number"), std::string::npos);
  EXPECT_NE(fault(test::referenceBytes(1, 60, 256, 1.0F, INFINITY)).find("no number"),
            std::string::npos);
}

TEST(DamagedWaveforms, OfMissingPacketsAreNamed) {
  const fs::path folder = test::scratch("reader_missing");
  LasBytes las = test::externalFile(4);
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_EQ(
      faultOf(folder / "in.las"),
      (folder / "in.las").string() + ": its waveforms are in in.wdp, which is missing beside it");
  test::writeBytes(folder / "in.wdz", "compressed");
  EXPECT_NE(faultOf(folder / "in.las").find("compressed waveforms"), std::string::npos);
  las.encoding = 1 | 2;
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_NE(faultOf(folder / "in.las").find("no record of waveform packets"), std::string::npos);
  std::string bytes = las.str();
  test::put(bytes, 227, test::Bytes().u64(bytes.size() - 70).str());
  test::writeBytes(folder / "in.las", bytes);
  EXPECT_NE(faultOf(folder / "in.las").find("which its header states"), std::string::npos);
  test::put(bytes, 227, test::Bytes().u64(bytes.size() + 1).str());
  test::writeBytes(folder / "in.las", bytes);
  EXPECT_NE(faultOf(folder / "in.las").find("its header states that"), std::string::npos);
  test::put(bytes, 227, test::Bytes().u64(bytes.size()).str());
  test::writeBytes(folder / "in.las", bytes + test::packetRecord(5).substr(0, 1000));
  EXPECT_NE(faultOf(folder / "in.las").find("reaches past the end of the file"), std::string::npos);
  las.vlrs.clear();
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_NE(faultOf(folder / "in.las").find("no waveform packet descriptor"), std::string::npos);
  las.format = 1;
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_NE(faultOf(folder / "in.las").find("point format 1 has no waveforms"), std::string::npos);
}

TEST(WaveformDescription, NamesDescriptorsAndPackets) {
  const fs::path folder = test::scratch("reader_description");
  test::writeBytes(folder / "in.las", test::externalFile(4).str());
  test::writeBytes(folder / "in.wdp", test::packetRecord(5));
  EXPECT_EQ(describeWaveforms(LasFile(folder / "in.las")),
            (std::vector<std::string>{"waveform descriptor 1: 256 samples of 8 bits, 1000 ps "
                                      "apart, gain 0.5 V, offset -2 V"}));
  LasBytes las = test::externalFile(9);
  las.encoding = 1 | 2;
  las.evlrs = {test::packetRecord(5)};
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_EQ(describeWaveforms(LasFile(folder / "in.las")).back(),
            "waveforms in the file, 1 340 bytes");
  test::writeBytes(folder / "plain.las", LasBytes().str());
  EXPECT_TRUE(describeWaveforms(LasFile(folder / "plain.las")).empty());
}

}  // namespace
}  // namespace pcl_als
