// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/pulse_waves_reader.h>

#include "pulse_waves_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::PulseWavesBytes;
using Sampling = PulseWavesBytes::Sampling;

/// Two pulses: an emitted one of 8 bits, and two channels of 8 and 16 bits with segments.
PulseWavesBytes twoPulses() {
  PulseWavesBytes file;
  Sampling emitted;
  emitted.type = 1;
  emitted.duration_bits = 32;
  emitted.duration_scale = 0.5F;
  emitted.bits = 8;
  Sampling low;
  low.bits = 8;
  low.duration_bits = 32;
  low.duration_scale = 0.25F;
  low.duration_offset = 100.0F;
  low.segment_bits = 16;
  Sampling high = low;
  high.channel = 1;
  high.duration_bits = 8;
  high.duration_scale = 2.0F;
  high.bits = 16;
  high.sample_bits = 16;
  high.segment_bits = 0;
  high.segments = 1;
  high.spacing = 2.0F;
  file.descriptors = {{emitted, low, high}, {emitted}};
  PulseWavesBytes::Pulse p;
  p.time = 230038250123;
  p.anchor[0] = 1000;
  p.anchor[1] = -2000;
  p.anchor[2] = 500;
  p.target[0] = 31000;
  p.target[1] = -2000;
  p.target[2] = -139500;
  p.first = 110;
  p.last = 216;
  p.flags = 0x20U | 0x10U | 0x80U;
  p.samplings = {{{-6, {1, 2, 255}}},
                 {{40, {3, 4, 5, 6}}, {400, {7, 8, 9}}, {412, {10, 11}}},
                 {{55, {65535, 300, 2, 1}}}};
  file.pulses.push_back(p);
  p.descriptor = 2;
  p.first = p.last = 0;
  p.samplings = {{{0, {9, 8}}}};
  file.pulses.push_back(p);
  p.descriptor = 0;
  p.samplings = {};
  file.pulses.push_back(p);
  return file;
}

struct Opened {
  PulseWavesFile file;
  WavesFile waves;
  PulseWavesReader reader;
  std::vector<PulseRecord> pulses;
  std::vector<PulseSegment> segments;

  explicit Opened(const fs::path& path) : file(path), waves(file), reader(waves) {
    file.read(0, file.header().pulse_count, pulses);
  }
  bool read(std::size_t i) { return reader.read(pulses[i], i, segments); }
};

fs::path written(const PulseWavesBytes& bytes, const std::string& name = "pulses.pls") {
  const fs::path path = test::scratch("pulse_waves") / name;
  bytes.write(path);
  return path;
}

TEST(PulseWaves, ReadsPulses) {
  PulseWavesBytes bytes = twoPulses();
  bytes.attributes = 1;
  Opened in(written(bytes));
  EXPECT_EQ(in.file.header().pulse_count, 3U);
  EXPECT_EQ(in.file.header().system_id, "Scanner X");
  const PulseRecord& p = in.pulses[0];
  EXPECT_NEAR(in.file.timeOf(p), 230038.250123, 1e-9);
  EXPECT_FALSE(in.file.hasStandardTime());
  EXPECT_LT((p.anchor - Eigen::Vector3d(500001.0, 5399998.0, 1000.5)).norm(), 1e-9);
  EXPECT_LT((p.direction() - Eigen::Vector3d(0.03, 0.0, -0.14)).norm(), 1e-12);
  EXPECT_EQ(p.first_sample, 110);
  EXPECT_EQ(p.last_sample, 216);
  EXPECT_EQ(p.descriptor, 1U);
  EXPECT_TRUE(p.edge);
  EXPECT_TRUE(p.scan_direction);
  EXPECT_EQ(p.facet, 2U);
  EXPECT_EQ(p.intensity, 200U);
  EXPECT_EQ(p.classification, 3U);
  EXPECT_EQ(p.source_id, 321U);
}

TEST(PulseWaves, ReadsSegments) {
  Opened in(written(twoPulses()));
  ASSERT_TRUE(in.read(0));
  ASSERT_EQ(in.segments.size(), 4U);
  using Counts = std::vector<double>;
  EXPECT_EQ(in.segments[0].sampling->type, PulseSampling::Type::outgoing);
  EXPECT_EQ(in.segments[0].start, -3.0);
  EXPECT_EQ(in.segments[0].waveform.counts, Counts({1, 2, 255}));
  EXPECT_EQ(in.segments[1].start, 110.0);
  EXPECT_EQ(in.segments[1].waveform.counts, Counts({3, 4, 5, 6}));
  EXPECT_EQ(in.segments[2].start, 200.0);
  EXPECT_EQ(in.segments[2].waveform.counts, Counts({7, 8, 9, 10, 11}));  // these continue
  EXPECT_EQ(in.segments[3].start, 210.0);
  EXPECT_EQ(in.segments[3].step, 2.0);
  EXPECT_EQ(in.segments[3].unitsAt(3.0), 216.0);
  EXPECT_EQ(in.segments[3].waveform.counts, Counts({65535, 300, 2, 1}));
  EXPECT_EQ(in.segments[3].waveform.descriptor.spacing_ps, 2000U);
  EXPECT_EQ(in.segments[3].waveform.descriptor.samples, 4U);
  // Towards the anchor, per picosecond of the sampling unit of 1 ns.
  const Eigen::Vector3f direction = in.segments[1].waveform.reference.direction;
  EXPECT_LT((direction - Eigen::Vector3f(-3e-5F, 0.0F, 1.4e-4F)).norm(), 1e-10);
  ASSERT_TRUE(in.read(1));
  EXPECT_EQ(in.segments.size(), 1U);
  EXPECT_FALSE(in.read(2));
  ASSERT_EQ(in.file.waveformDescriptors().size(), 2U);
  EXPECT_EQ(in.file.waveformDescriptors().at(1).bits, 8U);
  EXPECT_EQ(in.file.waveformDescriptors().at(2).spacing_ps, 2000U);
}

TEST(PulseWaves, CountsEmittedSamplesFromTheOriginOfThePulse) {
  PulseWavesBytes bytes = twoPulses();
  bytes.centre = 50;
  Opened in(written(bytes));
  EXPECT_EQ(in.file.descriptors().at(1).centre_to_anchor, 50.0);
  ASSERT_TRUE(in.read(0));
  EXPECT_EQ(in.segments[0].start, -3.0);
  EXPECT_EQ(in.segments[1].start, 110.0);
  bytes.centre = static_cast<std::int32_t>(0x8FFFFFFF);
  EXPECT_FALSE(PulseWavesFile(written(bytes)).descriptors().at(1).centre_to_anchor);
}

TEST(PulseWaves, ReadsSegmentsWithoutSamples) {
  PulseWavesBytes bytes = twoPulses();
  bytes.pulses[0].samplings = {{{-6, {1, 2, 255}}}, {}, {{55, {}}}};
  Opened in(written(bytes));
  ASSERT_TRUE(in.read(0));
  ASSERT_EQ(in.segments.size(), 2U);
  EXPECT_TRUE(in.segments[1].waveform.counts.empty());
}

TEST(PulseWaves, ReadsExtraBytesAppendedRecordsAndTables) {
  PulseWavesBytes bytes = twoPulses();
  bytes.extra_bytes = 5;
  bytes.time_offset = 1e9;
  const std::string third = bytes.descriptorBytes({Sampling()});
  for (const std::int32_t count : {-1, 3}) {
    bytes.appended_count = count;
    bytes.appended = {PulseWavesBytes::avlr(200003, third),
                      PulseWavesBytes::avlr(2112, "LOCAL_CS[\"x\"]", "PulseWaves_Proj"),
                      PulseWavesBytes::avlr(300001, PulseWavesBytes::tableBytes({1.0F, 2.5F}))};
    Opened in(written(bytes));
    EXPECT_EQ(in.file.descriptors().size(), 3U);
    EXPECT_EQ(in.file.scanners().at(1).instrument, "Scanner X");
    EXPECT_EQ(in.file.scanners().at(1).divergence_mrad, 0.5F);
    EXPECT_EQ(in.file.tables().at(1).at(0).entries, std::vector<float>({1.0F, 2.5F}));
    ASSERT_EQ(in.file.projection().size(), 1U);
    EXPECT_EQ(in.file.projection()[0].record_id, 2112);
    EXPECT_EQ(in.file.projection()[0].user_id, "LASF_Projection");
    EXPECT_TRUE(in.file.hasStandardTime());
    EXPECT_NEAR(in.file.timeOf(in.pulses[0]), 230038.250123, 1e-9);
    ASSERT_TRUE(in.read(0));
    EXPECT_EQ(in.segments[1].waveform.counts.size(), 4U);
  }
}

TEST(PulseWaves, DescribesFiles) {
  PulseWavesBytes bytes = twoPulses();
  bytes.vlrs = {PulseWavesBytes::vlr(300001, PulseWavesBytes::tableBytes({1.0F}))};
  std::string all;
  for (const std::string& text : describePulseWaves(PulseWavesFile(written(bytes))))
    all += text + '\n';
  for (const char* part :
       {"PulseWaves 0.3, 3 pulses", "seconds of the week", "scanner 1: Scanner X", "0.5000 mrad",
        "pulse descriptor 1, outgoing: 1 segment of samples of 8 bits, 1 ns apart",
        "returning, channel 1: 1 segment of samples of 16 bits, 2 ns apart",
        "lookup table 1: 1 value, decibels", "waveforms in pulses.wvs, 1"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
}

/// What reading all of a file complains of.
std::string fault(const PulseWavesBytes& bytes, const std::string& name = "pulses.pls") {
  return test::messageOf<InputError>([&] {
    Opened in(written(bytes, name));
    for (std::size_t i = 0; i < in.pulses.size(); ++i) in.read(i);
  });
}

TEST(PulseWaves, RefusesWhatContradictsItself) {
  struct Case {
    std::function<void(PulseWavesBytes&)> change;
    const char* message;
  };
  const Case cases[] = {
      {[](auto& b) { b.compression = 1; }, "pulses.pls: compressed pulses cannot be read"},
      {[](auto& b) { b.scale = 0.0; }, "coordinates is no number"},
      {[](auto& b) { b.time_scale = -1.0; }, "times is no number"},
      {[](auto& b) { b.descriptors[0][1].bits = 12; }, "sampling 1 describes 12 bits per sample"},
      {[](auto& b) { b.descriptors[0][1].duration_bits = 7; }, "7 bits for durations"},
      {[](auto& b) { b.descriptors[0][1].spacing = -1.0F; }, "a time of -1 ns"},
      {[](auto& b) { b.descriptors[0][2].sample_bits = 0; }, "segments without samples"},
      {[](auto& b) { b.descriptors[0][1].compression = 1; }, "compressed samples (type 1)"},
      {[](auto& b) { b.descriptors[0][1].type = 3; }, "the type 3"},
      {[](auto& b) { b.descriptors[0].clear(); }, "record 200001 of PulseWaves_Spec has no"},
      {[](auto& b) { b.vlrs = {PulseWavesBytes::vlr(200001, b.descriptorBytes({Sampling()}))}; },
       "occurs twice, with different values"},
      {[](auto& b) { b.vlrs = {PulseWavesBytes::vlr(300001, std::string(40, 'x'))}; },
       "record 300001"},
      {[](auto& b) { b.pulses[0].descriptor = 9; }, "pulse 0: the file has no pulse descriptor 9"},
      {[](auto& b) { b.pulses[0].offset = 12; }, "pulse 0: its waves begin at byte 12"},
      {[](auto& b) { b.pulses[1].offset = 5000; }, "pulse 1: its waves at byte 5000 reach past"},
      {[](auto& b) { b.pulses[0].first = 90; }, "states returning samples from 90 to 216"},
      {[](auto& b) {
         for (int k = 0; k < 3; ++k) b.pulses[0].target[k] = b.pulses[0].anchor[k];
       },
       "anchor and its target coincide"}};
  EXPECT_EQ(fault(twoPulses()), "no error");
  for (const Case& c : cases) {
    PulseWavesBytes bytes = twoPulses();
    c.change(bytes);
    EXPECT_NE(fault(bytes).find(c.message), std::string::npos) << c.message << ": " << fault(bytes);
  }
  EXPECT_NE(fault(twoPulses(), "pulses.plz").find("compressed pulses"), std::string::npos);
}

TEST(PulseWaves, RefusesTruncatedFiles) {
  const fs::path path = written(twoPulses());
  const std::string pls = test::readBytes(path), wvs = twoPulses().wvs();
  const auto messageOfBoth = [&] {
    return test::messageOf<InputError>([&] {
      Opened in(path);
      for (std::size_t i = 0; i < in.pulses.size(); ++i) in.read(i);
    });
  };
  for (std::size_t size = 0; size < pls.size(); size += 7) {
    test::writeBytes(path, pls.substr(0, size));
    EXPECT_NE(messageOfBoth().find("pulses.pls"), std::string::npos) << size;
  }
  test::writeBytes(path, pls);
  fs::path waves = path;
  waves.replace_extension(".wvs");
  for (std::size_t size = 0; size < wvs.size(); ++size) {
    test::writeBytes(waves, wvs.substr(0, size));
    EXPECT_NE(messageOfBoth(), "no error") << size;
  }
  fs::path packed = path;
  fs::rename(waves, packed.replace_extension(".wvz"));
  EXPECT_NE(messageOfBoth().find("compressed waves cannot be read; decompress them to pulses.wvs"),
            std::string::npos);
  fs::remove(packed);
  EXPECT_NE(messageOfBoth().find("its waves are in pulses.wvs, which is missing"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
