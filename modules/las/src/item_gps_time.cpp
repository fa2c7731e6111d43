// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "item_gps_time.h"

namespace pcl_als::laz {
namespace {

constexpr unsigned kMostSurprises = 3;

std::int64_t difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

bool isShort(std::int64_t step) {
  return step == static_cast<std::int32_t>(step);
}

std::int64_t plus(std::int64_t time, std::int32_t step) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(time) +
                                   static_cast<std::uint64_t>(std::int64_t{step}));
}

float ratio(std::int64_t now, std::int64_t time, std::int32_t step) {
  return static_cast<float>(static_cast<std::int32_t>(difference(now, time))) /
         static_cast<float>(step);
}

template <class Coder>
std::int32_t codedStep(IntegerPredictor<Coder>& steps, Coder& coder, std::int32_t predicted,
                       std::int64_t now, std::int64_t last, std::size_t context) {
  return steps.code(coder, predicted, static_cast<std::int32_t>(difference(now, last)), context);
}

}  // namespace

template <class Coder, bool kCodesSame>
void TimeSequences<Coder, kCodesSame>::start(std::int64_t first) {
  sequences_.fill(Sequence());
  sequences_[0].time = first;
  active_ = newest_ = 0;
  firsts_.reset();
  multiples_.reset();
  steps_.reset();
}

template <class Coder, bool kCodesSame>
std::int64_t TimeSequences<Coder, kCodesSame>::code(Coder& coder, std::int64_t now) {
  for (unsigned i = 0; i < kSequences; ++i) {
    const bool done =
        sequences_[active_].step == 0 ? codeFirst(coder, now) : codeMultiple(coder, now);
    if (done) return sequences_[active_].time;
  }
  throw Damage("the times of a point are contradictory");
}

/// Offset of the sequence that a step of 32 bits continues; 0: none.
template <class Coder, bool kCodesSame>
unsigned TimeSequences<Coder, kCodesSame>::otherSequence(std::int64_t now) const {
  for (unsigned i = 1; i < kSequences; ++i)
    if (isShort(difference(now, sequences_[(active_ + i) % kSequences].time))) return i;
  return 0;
}

template <class Coder, bool kCodesSame>
unsigned TimeSequences<Coder, kCodesSame>::chooseFirst(std::int64_t now) const {
  const std::int64_t step = difference(now, sequences_[active_].time);
  if (kCodesSame && step == 0) return same_again;
  return isShort(step) ? unsigned{short_step} : new_sequence + otherSequence(now);
}

template <class Coder, bool kCodesSame>
unsigned TimeSequences<Coder, kCodesSame>::chooseMultiple(std::int64_t now) const {
  const Sequence& s = sequences_[active_];
  const std::int64_t step = difference(now, s.time);
  if (kCodesSame && step == 0) return kSame;
  if (!isShort(step)) return kNew + otherSequence(now);
  const float times =
      std::max(kLeast - 1.0F, std::min(kLargestMultiple + 1.0F, ratio(now, s.time, s.step)));
  const int rounded = static_cast<int>(times >= 0.0F ? times + 0.5 : times - 0.5);
  return static_cast<unsigned>(rounded >= 0 ? std::min(rounded, kLargestMultiple)
                                            : kLargestMultiple - std::max(rounded, kLeast));
}

/// \return whether the time is known; else the sequence was changed.
template <class Coder, bool kCodesSame>
bool TimeSequences<Coder, kCodesSame>::codeFirst(Coder& coder, std::int64_t now) {
  const unsigned chosen = Coder::kEncodes ? chooseFirst(now) - kShift : 0;
  const unsigned symbol = coder.symbol(firsts_[0], chosen) + kShift;
  Sequence& s = sequences_[active_];
  if (symbol == short_step) {
    s.step = codedStep(steps_, coder, 0, now, s.time, 0);
    s.time = plus(s.time, s.step);
    s.surprises = 0;
  } else if (symbol == new_sequence) {
    codeNewSequence(coder, now);
  } else if (symbol != same_again) {
    changeTo(symbol - other_sequence);
    return false;
  }
  return true;
}

template <class Coder, bool kCodesSame>
bool TimeSequences<Coder, kCodesSame>::codeMultiple(Coder& coder, std::int64_t now) {
  unsigned symbol = Coder::kEncodes ? chooseMultiple(now) : 0;
  if constexpr (kCodesSame) {
    symbol = coder.symbol(multiples_[0], symbol);
  } else {  // the symbol kSame is omitted
    symbol = coder.symbol(multiples_[0], symbol > kSame ? symbol - 1 : symbol);
    symbol += symbol >= kSame ? 1 : 0;
  }
  if (symbol < kSame) {
    codeStep(coder, now, symbol);
  } else if (symbol == kNew) {
    codeNewSequence(coder, now);
  } else if (symbol != kSame) {
    changeTo(symbol - kNew);
    return false;
  }
  return true;
}

template <class Coder, bool kCodesSame>
void TimeSequences<Coder, kCodesSame>::codeStep(Coder& coder, std::int64_t now, unsigned symbol) {
  Sequence& s = sequences_[active_];
  const std::int32_t multiple = static_cast<std::int32_t>(symbol) <= kLargestMultiple
                                    ? symbol
                                    : kLargestMultiple - static_cast<int>(symbol);
  std::size_t context = 0;
  if (multiple == 1) context = 1;
  if (multiple > 1) context = multiple < 10 ? 2 : multiple < kLargestMultiple ? 3 : 4;
  if (multiple < 0) context = multiple > kLeast ? 5 : 6;
  if (multiple == 0) context = 7;
  const std::int32_t step =
      codedStep(steps_, coder, wrappedProduct(multiple, s.step), now, s.time, context);
  s.time = plus(s.time, step);
  if (multiple == 1) s.surprises = 0;
  if ((multiple == 0 || multiple == kLargestMultiple || multiple == kLeast) &&
      ++s.surprises > kMostSurprises) {
    s.step = step;
    s.surprises = 0;
  }
}

template <class Coder, bool kCodesSame>
void TimeSequences<Coder, kCodesSame>::codeNewSequence(Coder& coder, std::int64_t now) {
  const auto upper = [](std::int64_t time) {
    return static_cast<std::int32_t>(static_cast<std::uint64_t>(time) >> 32);
  };
  const std::int32_t high = steps_.code(coder, upper(sequences_[active_].time), upper(now), 8);
  const std::uint32_t low = coder.raw(32, static_cast<std::uint32_t>(now));
  newest_ = (newest_ + 1) % kSequences;
  active_ = newest_;
  sequences_[active_] = Sequence();
  sequences_[active_].time = static_cast<std::int64_t>(
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32 | low);
}

template <class Coder>
void GpsTimeV1<Coder>::start(const std::uint8_t* first) {
  time_ = load<std::int64_t>(first);
  step_ = 0;
  surprises_ = 0;
  firsts_.reset();
  multiples_.reset();
  steps_.reset();
}

template <class Coder>
void GpsTimeV1<Coder>::code(Coder& coder, typename Coder::Record item) {
  std::int64_t now = 0;
  if constexpr (Coder::kEncodes) now = load<std::int64_t>(item);
  if (step_ == 0)
    codeFirst(coder, now);
  else
    codeMultiple(coder, now);
  if constexpr (!Coder::kEncodes) store(item, time_);
}

template <class Coder>
void GpsTimeV1<Coder>::codeFirst(Coder& coder, std::int64_t now) {
  unsigned symbol = 0;
  if constexpr (Coder::kEncodes)
    symbol = now == time_ ? 0 : isShort(difference(now, time_)) ? 1 : 2;
  symbol = coder.symbol(firsts_[0], symbol);
  if (symbol == 1) {
    step_ = codedStep(steps_, coder, 0, now, time_, 0);
    time_ = plus(time_, step_);
  } else if (symbol == 2) {
    codeWhole(coder, now);
  }
}

template <class Coder>
unsigned GpsTimeV1<Coder>::chooseMultiple(std::int64_t now) const {
  if (now == time_) return kSame;
  if (!isShort(difference(now, time_))) return kWhole;
  const float times = std::max(0.0F, std::min(kLargestMultiple + 1.0F, ratio(now, time_, step_)));
  return std::min(kLargestMultiple, static_cast<unsigned>(times + 0.5F));
}

template <class Coder>
void GpsTimeV1<Coder>::codeMultiple(Coder& coder, std::int64_t now) {
  const unsigned symbol = coder.symbol(multiples_[0], Coder::kEncodes ? chooseMultiple(now) : 0U);
  if (symbol <= kLargestMultiple)
    codeStep(coder, now, symbol);
  else if (symbol == kWhole)
    codeWhole(coder, now);
}

template <class Coder>
void GpsTimeV1<Coder>::codeStep(Coder& coder, std::int64_t now, unsigned multiple) {
  std::size_t context = 1;
  if (multiple == 0) context = 2;
  if (multiple > 1) context = multiple < 10 ? 3 : multiple < 50 ? 4 : 5;
  const std::int32_t predicted =
      multiple == 0 ? step_ / 4 : wrappedProduct(static_cast<std::int32_t>(multiple), step_);
  const std::int32_t step = codedStep(steps_, coder, predicted, now, time_, context);
  time_ = plus(time_, step);
  const bool surprise = multiple == 0 || multiple == kLargestMultiple;
  if (surprise) ++surprises_;
  if (multiple == 1 || (surprise && surprises_ > kMostSurprises)) {
    step_ = step;
    surprises_ = 0;
  }
}

template <class Coder>
void GpsTimeV1<Coder>::codeWhole(Coder& coder, std::int64_t now) {
  std::uint64_t time = 0;
  for (unsigned shift = 0; shift < 64; shift += 16)
    time |= std::uint64_t{coder.raw(
                16, static_cast<std::uint32_t>(static_cast<std::uint64_t>(now) >> shift) & 0xFFFFU)}
            << shift;
  time_ = static_cast<std::int64_t>(time);
}

template class TimeSequences<EntropyDecoder, false>;
template class TimeSequences<EntropyEncoder, false>;
template class TimeSequences<EntropyDecoder, true>;
template class TimeSequences<EntropyEncoder, true>;
template class GpsTimeV1<EntropyDecoder>;
template class GpsTimeV1<EntropyEncoder>;

}  // namespace pcl_als::laz
