// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>

#include "item_bytes.h"
#include "item_colour.h"
#include "item_gps_time.h"

namespace pcl_als::laz {

inline constexpr unsigned kChannels = 4;  ///< scanner channels, each with models of its own

/** \brief One layer of a chunk: a stream of its own, which is absent where nothing in it changes.
 *
 * An encoder codes always and notes whether a layer says more than "as before"; an absent layer is
 * not decoded and its fields stay those of the first point.
 */
template <class Coder>
struct Layer {
  Coder coder;
  bool present = false;
  bool coded() const { return Coder::kEncodes || present; }
};

/// An item of layered compression.
template <class Coder>
class LayeredItem {
 public:
  virtual ~LayeredItem() = default;
  virtual std::size_t layers() const = 0;
  virtual Layer<Coder>& layer(std::size_t i) = 0;
  /// Begins a chunk behind its first point. \param channel of that point.
  virtual void start(const std::uint8_t* first, unsigned channel) = 0;
  /// Passes the item of the next point through the coder. POINT14 sets \a channel for the others.
  virtual void code(typename Coder::Record item, unsigned& channel) = 0;
};

/** \brief State per scanner channel, which begins as the one of the channel before.
 *
 * Where versions 2 and 3 of the format return to a channel that was seen before, the point is
 * compared with the last one of the *former* channel (but coded with the models of the new one).
 * Version 4 compares with the last of its own channel.
 */
template <class State>
class ChannelStates {
 public:
  struct Selection {
    State& models;
    State& reference;
  };

  explicit ChannelStates(unsigned version) : own_reference_(version >= 4) {}

  template <class Begin>
  void start(unsigned channel, const Begin& begin) {
    for (Slot& slot : slots_) slot.used = false;
    active_ = channel;
    use(channel, begin);
  }

  Selection select(unsigned channel) {
    State* reference = &*slots_[active_].state;
    if (channel != active_) {
      const bool known = slots_[channel].used;
      if (!known) use(channel, [reference](State& state) { state.begin(*reference); });
      active_ = channel;
      if (own_reference_ || !known) reference = &*slots_[channel].state;
    }
    return {*slots_[active_].state, *reference};
  }

 private:
  struct Slot {
    std::unique_ptr<State> state;
    bool used = false;
  };

  template <class Begin>
  void use(unsigned channel, const Begin& begin) {
    Slot& slot = slots_[channel];
    if (!slot.state) slot.state = std::make_unique<State>();
    slot.used = true;
    begin(*slot.state);
  }

  bool own_reference_;
  unsigned active_ = 0;
  std::array<Slot, kChannels> slots_;
};

/// Items RGB14 (without infrared) and RGBNIR14.
template <class Coder>
class LayeredColour : public LayeredItem<Coder> {
 public:
  LayeredColour(unsigned version, bool infrared) : states_(version), infrared_(infrared) {}
  std::size_t layers() const override { return infrared_ ? 2 : 1; }
  Layer<Coder>& layer(std::size_t i) override { return layers_[i]; }
  void start(const std::uint8_t* first, unsigned channel) override;
  void code(typename Coder::Record item, unsigned& channel) override;

 private:
  struct State {
    Colour last{};
    std::uint16_t last_infrared = 0;
    ColourCoder<Coder> colour;
    InfraredCoder<Coder> infrared;
    void begin(const State& other) { begin(other.last, other.last_infrared); }
    void begin(const Colour& first, std::uint16_t first_infrared);
  };

  ChannelStates<State> states_;
  bool infrared_;
  std::array<Layer<Coder>, 2> layers_;
};

/// Item WAVEPACKET14.
template <class Coder>
class LayeredWavePacket : public LayeredItem<Coder> {
 public:
  explicit LayeredWavePacket(unsigned version) : states_(version) {}
  std::size_t layers() const override { return 1; }
  Layer<Coder>& layer(std::size_t) override { return layer_; }
  void start(const std::uint8_t* first, unsigned channel) override;
  void code(typename Coder::Record item, unsigned& channel) override;

 private:
  struct State {
    WavePacket last;
    WavePacketCoder<Coder> packets;
    void begin(const State& other) { begin(other.last); }
    void begin(const WavePacket& first);
  };

  ChannelStates<State> states_;
  Layer<Coder> layer_;
};

/// Item BYTE14: a layer for every extra byte.
template <class Coder>
class LayeredBytes : public LayeredItem<Coder> {
 public:
  LayeredBytes(unsigned version, std::size_t size) : states_(version), layers_(size) {}
  std::size_t layers() const override { return layers_.size(); }
  Layer<Coder>& layer(std::size_t i) override { return layers_[i]; }
  void start(const std::uint8_t* first, unsigned channel) override;
  void code(typename Coder::Record item, unsigned& channel) override;

 private:
  struct State {
    std::vector<std::uint8_t> last;
    std::optional<ModelSet<typename Coder::Model>> models;
    void begin(const State& other) { begin(other.last.data(), other.last.size()); }
    void begin(const std::uint8_t* first, std::size_t size);
  };

  ChannelStates<State> states_;
  std::vector<Layer<Coder>> layers_;
};

}  // namespace pcl_als::laz
