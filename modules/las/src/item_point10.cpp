// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "item_point10.h"

namespace pcl_als::laz {
namespace {

/// Points with the same place among the returns of their pulse are alike: sixteen groups.
unsigned groupOf(const LegacyPoint& point) {
  const unsigned low = std::min(point.number(), point.returns());
  const unsigned high = std::max(point.number(), point.returns());
  if (low == 0) return 15 - high;  // not numbered as the standard says
  if (high <= 4) return high * (high - 1) / 2 + low - 1;
  return high < 7 ? 9 + low : 8 + low;
}

unsigned flag(bool set, unsigned value) {
  return set ? value : 0U;
}

std::int32_t median(const std::array<std::int32_t, 3>& of) {
  return std::max(std::min(of[0], of[1]), std::min(std::max(of[0], of[1]), of[2]));
}

}  // namespace

template <class Coder>
void Point10V2<Coder>::start(const std::uint8_t* first) {
  last_ = load<LegacyPoint>(first);
  dx_median_.fill(RunningMedian());
  dy_median_.fill(RunningMedian());
  last_intensity_.fill(0);
  last_z_.fill(0);
  changes_.reset();
  angles_.reset();
  for (auto* bytes : {&bits_, &classifications_, &users_}) bytes->reset();
  for (auto* numbers : {&intensity_, &source_, &dx_, &dy_, &z_}) numbers->reset();
}

template <class Coder>
void Point10V2<Coder>::code(Coder& coder, typename Coder::Record item) {
  LegacyPoint now = last_;
  if constexpr (Coder::kEncodes) now = load<LegacyPoint>(item);
  codeAttributes(coder, now);
  codeCoordinates(coder, now);
  last_ = now;
  if constexpr (!Coder::kEncodes) store(item, now);
}

template <class Coder>
unsigned Point10V2<Coder>::changes(const LegacyPoint& now) const {
  return flag(now.bits != last_.bits, bits) |
         flag(now.intensity != last_intensity_[groupOf(now)], intensity) |
         flag(now.classification != last_.classification, type) |
         flag(now.angle != last_.angle, angle) | flag(now.user != last_.user, user) |
         flag(now.source != last_.source, source);
}

template <class Coder>
void Point10V2<Coder>::codeAttributes(Coder& coder, LegacyPoint& now) {
  const unsigned changed = coder.symbol(changes_[0], Coder::kEncodes ? changes(now) : 0U);
  if ((changed & bits) != 0) now.bits = bits_.code(coder, last_.bits, now.bits);
  const unsigned group = groupOf(now);
  std::uint16_t& last_intensity = last_intensity_[group];
  if ((changed & intensity) != 0)
    last_intensity = static_cast<std::uint16_t>(
        intensity_.code(coder, last_intensity, now.intensity, std::min(group, 3U)));
  now.intensity = last_intensity;
  if ((changed & type) != 0)
    now.classification = classifications_.code(coder, last_.classification, now.classification);
  if ((changed & angle) != 0)
    now.angle = static_cast<std::uint8_t>(
        last_.angle +
        coder.symbol(angles_[now.direction()], static_cast<std::uint8_t>(now.angle - last_.angle)));
  if ((changed & user) != 0) now.user = users_.code(coder, last_.user, now.user);
  if ((changed & source) != 0)
    now.source = static_cast<std::uint16_t>(source_.code(coder, last_.source, now.source));
}

template <class Coder>
void Point10V2<Coder>::codeCoordinates(Coder& coder, LegacyPoint& now) {
  const unsigned group = groupOf(now), single = now.returns() == 1 ? 1 : 0;
  const std::int32_t dx =
      dx_.code(coder, dx_median_[group].value(), wrappedDifference(now.x, last_.x), single);
  dx_median_[group].add(dx);
  const std::int32_t dy =
      dy_.code(coder, dy_median_[group].value(), wrappedDifference(now.y, last_.y),
               single + pairedClass(dx_.lastClass(), 20));
  dy_median_[group].add(dy);
  std::int32_t& last_z = last_z_[returnsBelow(now.returns(), now.number())];
  const unsigned precision = (dx_.lastClass() + dy_.lastClass()) / 2;
  last_z = z_.code(coder, last_z, now.z, single + pairedClass(precision, 18));
  now.x = wrappedSum(last_.x, dx);
  now.y = wrappedSum(last_.y, dy);
  now.z = last_z;
}

template <class Coder>
void Point10V1<Coder>::start(const std::uint8_t* first) {
  last_ = load<LegacyPoint>(first);
  dx_last_.fill(0);
  dy_last_.fill(0);
  oldest_ = 0;
  changes_.reset();
  for (auto* bytes : {&bits_, &classifications_, &users_}) bytes->reset();
  for (auto* numbers : {&dx_, &dy_, &z_, &intensity_, &angle_, &source_}) numbers->reset();
}

template <class Coder>
void Point10V1<Coder>::code(Coder& coder, typename Coder::Record item) {
  LegacyPoint now = last_;
  if constexpr (Coder::kEncodes) now = load<LegacyPoint>(item);
  const unsigned precision = codeCoordinates(coder, now);
  codeAttributes(coder, now, precision);
  last_ = now;
  if constexpr (!Coder::kEncodes) store(item, now);
}

template <class Coder>
unsigned Point10V1<Coder>::codeCoordinates(Coder& coder, LegacyPoint& now) {
  constexpr unsigned last_context = 19;
  const std::int32_t dx = dx_.code(coder, median(dx_last_), wrappedDifference(now.x, last_.x));
  const std::int32_t dy = dy_.code(coder, median(dy_last_), wrappedDifference(now.y, last_.y),
                                   std::min(dx_.lastClass(), last_context));
  const unsigned precision = (dx_.lastClass() + dy_.lastClass()) / 2;
  now.z = z_.code(coder, last_.z, now.z, std::min(precision, last_context));
  now.x = wrappedSum(last_.x, dx);
  now.y = wrappedSum(last_.y, dy);
  dx_last_[oldest_] = dx;
  dy_last_[oldest_] = dy;
  oldest_ = (oldest_ + 1) % 3;
  return precision;
}

template <class Coder>
unsigned Point10V1<Coder>::changes(const LegacyPoint& now) const {
  return flag(now.intensity != last_.intensity, intensity) | flag(now.bits != last_.bits, bits) |
         flag(now.classification != last_.classification, type) |
         flag(now.angle != last_.angle, angle) | flag(now.user != last_.user, user) |
         flag(now.source != last_.source, source);
}

template <class Coder>
void Point10V1<Coder>::codeAttributes(Coder& coder, LegacyPoint& now, unsigned precision) {
  const unsigned changed = coder.symbol(changes_[0], Coder::kEncodes ? changes(now) : 0U);
  if ((changed & intensity) != 0)
    now.intensity =
        static_cast<std::uint16_t>(intensity_.code(coder, last_.intensity, now.intensity));
  if ((changed & bits) != 0) now.bits = bits_.code(coder, last_.bits, now.bits);
  if ((changed & type) != 0)
    now.classification = classifications_.code(coder, last_.classification, now.classification);
  if ((changed & angle) != 0)
    now.angle = static_cast<std::uint8_t>(
        angle_.code(coder, last_.angle, now.angle, precision < 3 ? 1 : 0));
  if ((changed & user) != 0) now.user = users_.code(coder, last_.user, now.user);
  if ((changed & source) != 0)
    now.source = static_cast<std::uint16_t>(source_.code(coder, last_.source, now.source));
}

template class Point10V1<EntropyDecoder>;
template class Point10V1<EntropyEncoder>;
template class Point10V2<EntropyDecoder>;
template class Point10V2<EntropyEncoder>;

}  // namespace pcl_als::laz
