// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "item_point10.h"

namespace pcl_als::laz {

/// The 29 bytes that place the waveform of a point.
struct WavePacket {
  static constexpr std::size_t kSize = 29;
  std::uint8_t descriptor = 0;
  std::uint64_t offset = 0;
  std::array<std::int32_t, 5> numbers{};  ///< bytes, return location, dx, dy, dz (as bit patterns)

  static WavePacket at(const std::uint8_t* bytes);
  void storeAt(std::uint8_t* bytes) const;
  bool operator==(const WavePacket& other) const {
    return descriptor == other.descriptor && offset == other.offset && numbers == other.numbers;
  }
};

/// The part of both waveform items that one scanner channel has for itself.
template <class Coder>
class WavePacketCoder {
 public:
  void reset();
  /// \param[in,out] last the packet before; becomes \a now.
  void code(Coder& coder, const WavePacket& now, WavePacket& last);

 private:
  enum Place : unsigned { same, behind, near, far };

  unsigned choosePlace(const WavePacket& now, const WavePacket& last) const;
  std::uint64_t codeOffset(Coder& coder, const WavePacket& now, const WavePacket& last);

  unsigned last_place_ = same;
  std::int32_t last_difference_ = 0;
  ModelSet<typename Coder::Model> descriptors_{1, 256}, places_{4, 4};
  IntegerPredictor<Coder> differences_{32, 1}, sizes_{32, 1}, locations_{32, 1}, directions_{32, 3};
};

/// Item WAVEPACKET13, version 1.
template <class Coder>
class WavePacketItem : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override {
    last_ = WavePacket::at(first);
    packets_.reset();
  }
  void code(Coder& coder, typename Coder::Record item) override {
    packets_.code(coder, Coder::kEncodes ? WavePacket::at(item) : WavePacket(), last_);
    if constexpr (!Coder::kEncodes) last_.storeAt(item);
  }

 private:
  WavePacket last_;
  WavePacketCoder<Coder> packets_;
};

/// Item BYTE, version 2: differences, one model per byte.
template <class Coder>
class BytesV2 : public PointwiseItem<Coder> {
 public:
  explicit BytesV2(std::size_t size) : last_(size), models_(size, 256) {}
  void start(const std::uint8_t* first) override {
    std::copy(first, first + last_.size(), last_.begin());
    models_.reset();
  }
  void code(Coder& coder, typename Coder::Record item) override {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      std::uint8_t change = 0;
      if constexpr (Coder::kEncodes) change = static_cast<std::uint8_t>(item[i] - last_[i]);
      last_[i] = static_cast<std::uint8_t>(last_[i] + coder.symbol(models_[i], change));
      if constexpr (!Coder::kEncodes) item[i] = last_[i];
    }
  }

 private:
  std::vector<std::uint8_t> last_;
  ModelSet<typename Coder::Model> models_;
};

/// Item BYTE, version 1: each byte is a number with a context of its own.
template <class Coder>
class BytesV1 : public PointwiseItem<Coder> {
 public:
  explicit BytesV1(std::size_t size) : last_(size), numbers_(8, size) {}
  void start(const std::uint8_t* first) override {
    std::copy(first, first + last_.size(), last_.begin());
    numbers_.reset();
  }
  void code(Coder& coder, typename Coder::Record item) override {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      std::uint8_t now = 0;
      if constexpr (Coder::kEncodes) now = item[i];
      last_[i] = static_cast<std::uint8_t>(numbers_.code(coder, last_[i], now, i));
      if constexpr (!Coder::kEncodes) item[i] = last_[i];
    }
  }

 private:
  std::vector<std::uint8_t> last_;
  IntegerPredictor<Coder> numbers_;
};

}  // namespace pcl_als::laz
