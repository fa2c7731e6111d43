// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "las_bytes.h"

namespace pcl_als::test {

/// A PulseWaves file (.pls and .wvs) written by hand from the specification, independent of the
/// library.
struct PulseWavesBytes {
  struct Sampling {
    unsigned type = 2, channel = 0, duration_bits = 16;
    float duration_scale = 1.0F, duration_offset = 0.0F;
    unsigned segment_bits = 0, sample_bits = 8, segments = 1, samples = 0, bits = 16, table = 0;
    float spacing = 1.0F;
    unsigned compression = 0;
  };
  struct Segment {
    int duration = 0;  ///< as stored
    std::vector<unsigned> counts;
  };
  struct Pulse {
    std::int64_t time = 0;
    int anchor[3] = {0, 0, 0}, target[3] = {0, 0, -150000};  ///< steps
    int first = 0, last = 0;
    unsigned descriptor = 1, flags = 0;           ///< bits 4 to 7: edge, direction, facet
    std::vector<std::vector<Segment>> samplings;  ///< of its descriptor
    std::int64_t offset = -1;                     ///< -1: where its waves are
  };

  std::vector<std::vector<Sampling>> descriptors;  ///< 1, 2, …
  std::vector<Pulse> pulses;
  std::vector<std::string> vlrs;      ///< further records, complete
  std::vector<std::string> appended;  ///< complete, as avlr() makes them
  unsigned source = 7, attributes = 0, extra_bytes = 0, compression = 0, scanner = 1;
  std::int32_t appended_count = -1, centre = 0;
  double time_scale = 1e-6, time_offset = 0.0, scale = 0.001;
  double offset[3] = {500000.0, 5400000.0, 1000.0};

  static std::string header(const std::string& user, std::uint32_t id, std::size_t bytes) {
    return Bytes().text(user, 16).u32(id).u32(0).u64(bytes).text("made by hand", 64).str();
  }
  static std::string vlr(std::uint32_t id, const std::string& data,
                         const std::string& user = "PulseWaves_Spec") {
    return header(user, id, data.size()) + data;
  }
  static std::string avlr(std::uint32_t id, const std::string& data,
                          const std::string& user = "PulseWaves_Spec") {
    return data + header(user, id, data.size());
  }
  static std::string scannerBytes() {
    Bytes b;
    b.u32(248).u32(0).text("Scanner X", 64).text("4711", 64).f32(1064.0F).f32(4.0F).u32(2).u32(4);
    for (const float v : {160.0F, -30.0F, 30.0F, 240.0F, 10.0F, 0.5F, 100.0F, 4200.0F}) b.f32(v);
    return b.text("of a test", 64).str();
  }
  static std::string tableBytes(const std::vector<float>& entries) {
    Bytes b;
    b.u32(76).u32(0).u32(1).text("tables", 64);
    b.u32(84).u32(0).u32(entries.size()).u16(1).u8(8).u8(0).u32(0).text("decibels", 64);
    for (const float entry : entries) b.f32(entry);
    return b.str();
  }
  std::string descriptorBytes(const std::vector<Sampling>& samplings) const {
    Bytes b;
    b.u32(92)
        .u32(0)
        .i32(centre)
        .u16(extra_bytes)
        .u16(samplings.size())
        .f32(1.0F)
        .u32(0)
        .u32(scanner);
    b.text("composition", 64);
    for (const Sampling& s : samplings) {
      b.u32(104).u32(0).u8(s.type).u8(s.channel).u8(0).u8(s.duration_bits);
      b.f32(s.duration_scale).f32(s.duration_offset).u8(s.segment_bits).u8(s.sample_bits);
      b.u16(s.segments).u32(s.samples).u16(s.bits).u16(s.table).f32(s.spacing).u32(s.compression);
      b.text("sampling", 64);
    }
    return b.str();
  }

  static void number(Bytes& b, unsigned bits, std::int64_t value) {
    if (bits == 8) b.u8(static_cast<unsigned>(value));
    if (bits == 16) b.u16(static_cast<unsigned>(value));
    if (bits == 32) b.u32(static_cast<std::uint64_t>(value));
  }
  std::string wavesOf(const Pulse& pulse) const {
    Bytes b;
    b.raw(std::string(extra_bytes, 'x'));
    if (pulse.descriptor == 0 || pulse.descriptor > descriptors.size()) return b.str();
    const auto& samplings = descriptors[pulse.descriptor - 1];
    for (std::size_t k = 0; k < pulse.samplings.size(); ++k) {
      number(b, samplings[k].segment_bits, static_cast<std::int64_t>(pulse.samplings[k].size()));
      for (const Segment& segment : pulse.samplings[k]) {
        number(b, samplings[k].duration_bits, segment.duration);
        number(b, samplings[k].sample_bits, static_cast<std::int64_t>(segment.counts.size()));
        for (const unsigned count : segment.counts) number(b, samplings[k].bits, count);
      }
    }
    return b.str();
  }

  std::string wvs() const {
    std::string bytes = Bytes().text("PulseWavesWaves", 16).u32(0).text("", 40).str();
    for (const Pulse& pulse : pulses) bytes += wavesOf(pulse);
    return bytes;
  }

  std::size_t recordLength() const { return 48 + (attributes & 1U) * 2 + (attributes >> 1U) * 4; }
  std::string records() const {
    std::string vlr_bytes = vlr(100001, scannerBytes());
    for (std::size_t i = 0; i < descriptors.size(); ++i)
      vlr_bytes += vlr(static_cast<std::uint32_t>(200001 + i), descriptorBytes(descriptors[i]));
    for (const std::string& own : vlrs) vlr_bytes += own;
    return vlr_bytes;
  }
  std::string pls() const {
    const std::string vlr_bytes = records();
    Bytes b;
    b.text("PulseWavesPulse", 16).u32(0).u32(source).text("project", 16).text("Scanner X", 64);
    b.text("pulse_waves_bytes", 64).u16(45).u16(2026).u8(0).u8(3).u16(352);
    b.u64(352 + vlr_bytes.size()).u64(pulses.size()).u32(0).u32(attributes).u32(recordLength());
    b.u32(compression).u64(0).u32(1 + descriptors.size() + vlrs.size()).i32(appended_count);
    b.f64(time_scale).f64(time_offset).u64(0).u64(0).f64(scale).f64(scale).f64(scale);
    b.f64(offset[0]).f64(offset[1]).f64(offset[2]);
    for (int i = 0; i < 6; ++i) b.f64(i);
    b.raw(vlr_bytes);
    std::int64_t waves = 60;
    for (const Pulse& p : pulses) {
      b.add(p.time).add(p.offset < 0 ? waves : p.offset);
      for (const int v : p.anchor) b.i32(v);
      for (const int v : p.target) b.i32(v);
      b.i16(p.first).i16(p.last).u8(p.descriptor).u8(p.flags).u8(200).u8(3);
      if ((attributes & 1U) != 0) b.u16(321);
      if ((attributes & 2U) != 0) b.u32(70000);
      waves += static_cast<std::int64_t>(wavesOf(p).size());
    }
    b.raw(header("PulseWaves_Spec", 0xFFFFFFFFU, 0));
    for (const std::string& own : appended) b.raw(own);
    return b.str();
  }
  void write(const std::filesystem::path& path) const {
    std::filesystem::path beside = path;
    writeBytes(path, pls());
    writeBytes(beside.replace_extension(".wvs"), wvs());
  }
};

/// An echo of a simulated pulse: amplitude, and time from the anchor, nanoseconds.
struct PulseEcho {
  double amplitude = 0.0, time = 0.0;
};

/** \brief Pulses with the emitted waveform and one returning segment around each echo, or one for
 * both if they are close, of 16 bits and with noise of two counts.
 *
 * Pulse i leaves (500000 + 0.5 i, 5400000, 1000) downwards and to the east, 0.15 m per nanosecond.
 */
struct SimulatedPulses {
  static constexpr double kSpeed = 0.15;      // metres per nanosecond
  static constexpr double kBaseline = 200.0;  // counts
  static constexpr int kEmitted = 40;         // samples of the emitted pulse
  static constexpr double kEmittedPeak = 14.3;

  std::function<double(double)> shape = [](double t) { return std::exp(-0.5 * t * t / 4.0); };
  std::vector<std::vector<PulseEcho>> echoes;
  double jitter = 0.0;         ///< largest deviation of emission, ns, which echoes share
  bool state_emitted = false;  ///< when the emitted samples begin; their maximum is the origin
  PulseWavesBytes bytes;
  std::mt19937_64 random{5};

  /// 200 pulses: two echoes 20 ns apart, two in segments of their own, one.
  SimulatedPulses() {
    PulseWavesBytes::Sampling emitted;
    emitted.type = 1;
    emitted.duration_bits = 0;
    emitted.sample_bits = 0;
    emitted.samples = kEmitted;
    PulseWavesBytes::Sampling returning;
    returning.segment_bits = 8;
    returning.duration_scale = 0.25F;
    returning.duration_offset = 4000.0F;
    bytes.descriptors = {{emitted, returning}};
    for (int i = 0; i < 200; ++i) {
      const double time = 4021.0 + 0.37 * i;
      echoes.push_back({{400.0, time}});
      if (i % 3 == 0) echoes.back().push_back({150.0, time + 20.0});
      if (i % 3 == 1) echoes.back().push_back({250.0, time + 300.25});
    }
  }

  static double metresAlong(double ns) { return kSpeed * ns; }
  static double directionX() { return 0.28; }
  static double directionZ() { return -0.96; }

  std::vector<unsigned> counts(const std::vector<PulseEcho>& of, double start, int samples) {
    std::normal_distribution<double> noise(0.0, 2.0);
    std::vector<unsigned> values;
    for (int k = 0; k < samples; ++k) {
      double power = kBaseline + noise(random);
      for (const PulseEcho& echo : of)
        for (int part = 0; part < 10; ++part)
          power += 0.1 * echo.amplitude * shape(start + k + (part - 4.5) / 10.0 - echo.time);
      values.push_back(static_cast<unsigned>(std::lround(power)));
    }
    return values;
  }
  /// The emitted pulse, \a late behind its usual time.
  PulseWavesBytes::Segment emitted(double late) {
    PulseWavesBytes::Sampling& sampling = bytes.descriptors[0][0];
    sampling.duration_bits = state_emitted ? 32 : 0;
    sampling.duration_scale = 0.01F;
    return {static_cast<int>(std::lround(-100.0 * kEmittedPeak)),
            counts({{900.0, kEmittedPeak + late}}, 0.0, kEmitted)};
  }
  PulseWavesBytes::Segment segment(const std::vector<PulseEcho>& of, double start, int samples) {
    return {static_cast<int>(std::lround((start - 4000.0) / 0.25)), counts(of, start, samples)};
  }

  /// Makes the bytes of all pulses.
  const PulseWavesBytes& make() {
    bytes.pulses.clear();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      PulseWavesBytes::Pulse p;
      p.time = 230038250000 + 10 * static_cast<std::int64_t>(i);
      p.anchor[0] = 500 * static_cast<int>(i);
      p.target[0] = p.anchor[0] + static_cast<int>(std::lround(1e6 * kSpeed * directionX()));
      p.target[2] = static_cast<int>(std::lround(1e6 * kSpeed * directionZ()));
      const double late = std::uniform_real_distribution<double>(-jitter, jitter)(random);
      std::vector<PulseEcho> own = echoes[i];
      for (PulseEcho& echo : own) echo.time += late;
      const double start = std::floor(own[0].time) - 20.0;
      std::vector<PulseWavesBytes::Segment> returning;
      const bool apart = own.size() > 1 && own[1].time - own[0].time > 100.0;
      returning.push_back(segment(own, start, 70));
      if (apart) returning.push_back(segment(own, start + 280.0, 50));
      p.first = static_cast<int>(start);
      p.last = static_cast<int>(start) + (apart ? 280 + 49 : 69);
      p.flags = i % 2 == 0 ? 0x20U : 0x10U;
      p.samplings = {{emitted(late)}, returning};
      bytes.pulses.push_back(p);
    }
    return bytes;
  }
};

}  // namespace pcl_als::test
