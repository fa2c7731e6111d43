// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "layered_items.h"

namespace pcl_als::laz {

/// The 30 bytes that point formats 6 to 10 have in common.
struct ExtendedPoint {
  struct Fields {
    std::int32_t x, y, z;
    std::uint16_t intensity;
    std::uint8_t returns_byte, flags_byte, classification, user;
    std::int16_t angle;
    std::uint16_t source;
  };
  Fields f{};
  std::int64_t time = 0;  ///< bit pattern of the double

  unsigned number() const { return f.returns_byte & 15U; }
  unsigned returns() const { return f.returns_byte >> 4U; }
  unsigned channel() const { return f.flags_byte >> 4U & 3U; }
  /// Edge of flight line, scan direction and the four classification flags.
  unsigned flags() const { return (f.flags_byte >> 2U & 0x30U) | (f.flags_byte & 15U); }

  void setReturns(unsigned number, unsigned returns) {
    f.returns_byte = static_cast<std::uint8_t>(returns << 4U | number);
  }
  void setChannel(unsigned channel) {
    f.flags_byte = static_cast<std::uint8_t>((f.flags_byte & ~0x30U) | channel << 4U);
  }
  void setFlags(unsigned flags) {
    f.flags_byte =
        static_cast<std::uint8_t>((f.flags_byte & 0x30U) | (flags & 0x30U) << 2U | (flags & 15U));
  }

  static ExtendedPoint at(const std::uint8_t* bytes) {
    ExtendedPoint point;
    std::memcpy(&point.f, bytes, kTime);
    point.time = load<std::int64_t>(bytes + kTime);
    return point;
  }
  void storeAt(std::uint8_t* bytes) const {
    std::memcpy(bytes, &f, kTime);
    store(bytes + kTime, time);
  }

 private:
  static constexpr std::size_t kTime = 22;
};

/// Item POINT14: coordinates and attributes in nine layers.
template <class Coder>
class Point14 : public LayeredItem<Coder> {
 public:
  /// In the order of the file.
  enum LayerIndex : std::size_t { xy, z, type, flags, intensity, angle, user, source, time, count };

  explicit Point14(unsigned version) : tells_channel_always_(version >= 4) {}
  std::size_t layers() const override { return count; }
  Layer<Coder>& layer(std::size_t i) override { return layers_[i]; }
  void start(const std::uint8_t* first, unsigned channel) override;
  void code(typename Coder::Record item, unsigned& channel) override;

 private:
  using Model = typename Coder::Model;
  enum Change : unsigned {
    number_mask = 3,
    returns_change = 4,
    angle_change = 8,
    time_change = 16,
    source_change = 32,
    channel_change = 64
  };

  struct Channel {
    ExtendedPoint last;
    bool time_changed = false;
    std::array<RunningMedian, 12> dx_median, dy_median;
    std::array<std::int32_t, 8> last_z{};
    std::array<std::uint16_t, 8> last_intensity{};
    ModelSet<Model> changes{8, 128}, channels{1, 3}, returns{16, 16}, numbers{16, 16},
        numbers_same_time{1, 13}, types{64, 256}, flags{64, 64}, users{64, 256};
    IntegerPredictor<Coder> dx{32, 2}, dy{32, 22}, z{32, 20}, intensity{16, 4}, angle{16, 2},
        source{16, 1};
    TimeSequences<Coder, false> times;

    void begin(const ExtendedPoint& first);
  };
  /// What later layers need to know about a point.
  struct Context {
    unsigned time_changed, place, group, level, single;
  };

  Channel& channelOf(unsigned index, const ExtendedPoint& first);
  unsigned changes(const ExtendedPoint& now) const;
  unsigned codeChannel(unsigned changed, unsigned now);
  void codeReturns(Channel& c, unsigned changed, ExtendedPoint& now);
  void codeXY(Channel& c, const Context& context, ExtendedPoint& now);
  void codeZ(Channel& c, const Context& context, ExtendedPoint& now);
  void codeClassification(Channel& c, const Context& context, ExtendedPoint& now);
  void codeFlags(Channel& c, ExtendedPoint& now);
  void codeIntensity(Channel& c, const Context& context, ExtendedPoint& now);
  void codeUser(Channel& c, ExtendedPoint& now);
  void codeChanges(Channel& c, unsigned changed, ExtendedPoint& now);

  bool tells_channel_always_;
  unsigned active_ = 0;
  std::array<std::unique_ptr<Channel>, kChannels> channels_;
  std::array<bool, kChannels> used_{};
  std::array<Layer<Coder>, count> layers_;
};

}  // namespace pcl_als::laz
