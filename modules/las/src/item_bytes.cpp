// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "item_bytes.h"

namespace pcl_als::laz {
namespace {

constexpr std::size_t kOffset = 1, kNumbers = 9;

}  // namespace

WavePacket WavePacket::at(const std::uint8_t* bytes) {
  WavePacket packet;
  packet.descriptor = bytes[0];
  packet.offset = load<std::uint64_t>(bytes + kOffset);
  packet.numbers = load<decltype(packet.numbers)>(bytes + kNumbers);
  return packet;
}

void WavePacket::storeAt(std::uint8_t* bytes) const {
  bytes[0] = descriptor;
  store(bytes + kOffset, offset);
  store(bytes + kNumbers, numbers);
}

template <class Coder>
void WavePacketCoder<Coder>::reset() {
  last_place_ = same;
  last_difference_ = 0;
  descriptors_.reset();
  places_.reset();
  for (auto* numbers : {&differences_, &sizes_, &locations_, &directions_}) numbers->reset();
}

template <class Coder>
unsigned WavePacketCoder<Coder>::choosePlace(const WavePacket& now, const WavePacket& last) const {
  const auto difference = static_cast<std::int64_t>(now.offset - last.offset);
  if (difference != static_cast<std::int32_t>(difference)) return far;
  if (difference == 0) return same;
  return difference > 0 && difference == last.numbers[0] ? behind : near;
}

template <class Coder>
std::uint64_t WavePacketCoder<Coder>::codeOffset(Coder& coder, const WavePacket& now,
                                                 const WavePacket& last) {
  last_place_ = coder.symbol(places_[last_place_], Coder::kEncodes ? choosePlace(now, last) : 0U);
  if (last_place_ == same) return last.offset;
  if (last_place_ == behind) return last.offset + static_cast<std::uint32_t>(last.numbers[0]);
  if (last_place_ == near) {
    last_difference_ = differences_.code(coder, last_difference_,
                                         static_cast<std::int32_t>(now.offset - last.offset));
    return last.offset + static_cast<std::uint64_t>(std::int64_t{last_difference_});
  }
  const std::uint64_t low = coder.raw(32, static_cast<std::uint32_t>(now.offset));
  return std::uint64_t{coder.raw(32, static_cast<std::uint32_t>(now.offset >> 32))} << 32 | low;
}

template <class Coder>
void WavePacketCoder<Coder>::code(Coder& coder, const WavePacket& now, WavePacket& last) {
  WavePacket next = now;
  next.descriptor = static_cast<std::uint8_t>(coder.symbol(descriptors_[0], now.descriptor));
  next.offset = codeOffset(coder, now, last);
  next.numbers[0] = sizes_.code(coder, last.numbers[0], now.numbers[0]);
  next.numbers[1] = locations_.code(coder, last.numbers[1], now.numbers[1]);
  for (unsigned axis = 0; axis < 3; ++axis)
    next.numbers[2 + axis] =
        directions_.code(coder, last.numbers[2 + axis], now.numbers[2 + axis], axis);
  last = next;
}

template class WavePacketCoder<EntropyDecoder>;
template class WavePacketCoder<EntropyEncoder>;

}  // namespace pcl_als::laz
