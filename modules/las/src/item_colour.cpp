// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "item_colour.h"

namespace pcl_als::laz {
namespace {

std::uint8_t clamped(int value) {
  return static_cast<std::uint8_t>(std::max(0, std::min(255, value)));
}

}  // namespace

template <class Coder>
void ColourCoder<Coder>::reset() {
  changes_.reset();
  corrections_.reset();
}

template <class Coder>
typename ColourCoder<Coder>::Halves ColourCoder<Coder>::halves(const Colour& colour) {
  Halves halves;
  for (unsigned band = 0; band < 3; ++band) {
    halves[0][band] = static_cast<std::uint8_t>(colour[band]);
    halves[1][band] = static_cast<std::uint8_t>(colour[band] >> 8U);
  }
  return halves;
}

/// Bit 2 band + half of every byte that changed, and whether the bands differ.
template <class Coder>
unsigned ColourCoder<Coder>::changes(const Halves& now, const Halves& last) {
  unsigned changed = 0;
  for (unsigned band = 0; band < 3; ++band)
    for (unsigned half = 0; half < 2; ++half) {
      if (now[half][band] != last[half][band]) changed |= 1U << (2 * band + half);
      if (now[half][band] != now[half][0]) changed |= kNotGrey;
    }
  return changed;
}

template <class Coder>
std::uint8_t ColourCoder<Coder>::codeByte(Coder& coder, unsigned part, unsigned changed,
                                          int predicted, std::uint8_t now, std::uint8_t last) {
  if ((changed >> part & 1U) == 0) return last;
  const unsigned correction = static_cast<std::uint8_t>(now - predicted);
  return static_cast<std::uint8_t>(predicted + coder.symbol(corrections_[part], correction));
}

template <class Coder>
void ColourCoder<Coder>::codeOthers(Coder& coder, unsigned changed, Halves& now,
                                    const Halves& last) {
  for (unsigned half = 0; half < 2; ++half) {
    const auto& before = last[half];
    auto& after = now[half];
    int change = after[0] - before[0];
    after[1] = codeByte(coder, 2 + half, changed, clamped(before[1] + change), after[1], before[1]);
    change = (change + after[1] - before[1]) / 2;
    after[2] = codeByte(coder, 4 + half, changed, clamped(before[2] + change), after[2], before[2]);
  }
}

template <class Coder>
bool ColourCoder<Coder>::code(Coder& coder, Colour now, Colour& last) {
  Halves after = halves(now);
  const Halves before = halves(last);
  const unsigned changed = coder.symbol(changes_[0], Coder::kEncodes ? changes(after, before) : 0U);
  for (unsigned half = 0; half < 2; ++half)
    after[half][0] =
        codeByte(coder, half, changed, before[half][0], after[half][0], before[half][0]);
  if ((changed & kNotGrey) != 0)
    codeOthers(coder, changed, after, before);
  else
    for (auto& half : after) half.fill(half[0]);
  for (unsigned band = 0; band < 3; ++band)
    last[band] = static_cast<std::uint16_t>(after[0][band] | after[1][band] << 8);
  return changed != 0;
}

template <class Coder>
void InfraredCoder<Coder>::reset() {
  changes_.reset();
  corrections_.reset();
}

template <class Coder>
bool InfraredCoder<Coder>::code(Coder& coder, std::uint16_t now, std::uint16_t& last) {
  const unsigned difference = now ^ last;
  const unsigned changed = coder.symbol(
      changes_[0], ((difference & 0xFFU) != 0 ? 1U : 0U) | (difference >> 8U != 0 ? 2U : 0U));
  unsigned result = 0;
  for (unsigned half = 0; half < 2; ++half) {
    const unsigned shift = 8 * half;
    auto byte = static_cast<std::uint8_t>(last >> shift);
    if ((changed >> half & 1U) != 0)
      byte = static_cast<std::uint8_t>(
          byte +
          coder.symbol(corrections_[half], static_cast<std::uint8_t>((now >> shift) - byte)));
    result |= unsigned{byte} << shift;
  }
  last = static_cast<std::uint16_t>(result);
  return changed != 0;
}

template <class Coder>
void ColourV1<Coder>::start(const std::uint8_t* first) {
  std::memcpy(last_.data(), first, kBytes);
  changes_.reset();
  bytes_.reset();
}

template <class Coder>
void ColourV1<Coder>::code(Coder& coder, typename Coder::Record item) {
  auto now = last_;
  unsigned changed = 0;
  if constexpr (Coder::kEncodes) {
    std::memcpy(now.data(), item, kBytes);
    for (unsigned i = 0; i < kBytes; ++i) changed |= (now[i] != last_[i] ? 1U : 0U) << i;
  }
  changed = coder.symbol(changes_[0], changed);
  for (unsigned i = 0; i < kBytes; ++i)
    if ((changed >> i & 1U) != 0)
      now[i] = static_cast<std::uint8_t>(bytes_.code(coder, last_[i], now[i], i));
  last_ = now;
  if constexpr (!Coder::kEncodes) std::memcpy(item, now.data(), kBytes);
}

template class ColourCoder<EntropyDecoder>;
template class ColourCoder<EntropyEncoder>;
template class InfraredCoder<EntropyDecoder>;
template class InfraredCoder<EntropyEncoder>;
template class ColourV1<EntropyDecoder>;
template class ColourV1<EntropyEncoder>;

}  // namespace pcl_als::laz
