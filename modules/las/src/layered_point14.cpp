// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "layered_point14.h"

namespace pcl_als::laz {
namespace {

/// Points with a similar place among the returns of their pulse: six groups.
unsigned groupOf(unsigned returns, unsigned number) {
  const unsigned low = std::min(returns, number), high = std::max(returns, number);
  if (low == 0) {  // not numbered as the standard says
    constexpr std::array<std::uint8_t, 9> groups = {0, 1, 2, 3, 4, 5, 3, 4, 4};
    return high < groups.size() ? groups[high] : 5;
  }
  if (high <= 2) return high + low - 2;
  if (low == 1) return 3;
  if (low == 2) return high <= 10 ? 4 : 3;
  return low == high || (low >= 11 && high == low + 1) ? 5 : 4;
}

/// Bits: first return, last return.
unsigned placeOf(const ExtendedPoint& point, unsigned first, unsigned last) {
  return (point.number() == 1 ? first : 0U) + (point.number() >= point.returns() ? last : 0U);
}

unsigned flag(bool set, unsigned value) {
  return set ? value : 0U;
}

}  // namespace

template <class Coder>
void Point14<Coder>::Channel::begin(const ExtendedPoint& first) {
  last = first;
  time_changed = false;
  dx_median.fill(RunningMedian());
  dy_median.fill(RunningMedian());
  last_z.fill(first.f.z);
  last_intensity.fill(first.f.intensity);
  for (auto* models :
       {&changes, &channels, &returns, &numbers, &numbers_same_time, &types, &flags, &users})
    models->reset();
  for (auto* numbers_coder : {&dx, &dy, &z, &intensity, &angle, &source}) numbers_coder->reset();
  times.start(first.time);
}

template <class Coder>
void Point14<Coder>::start(const std::uint8_t* first, unsigned channel) {
  used_.fill(false);
  active_ = channel;
  channelOf(channel, ExtendedPoint::at(first));
}

template <class Coder>
typename Point14<Coder>::Channel& Point14<Coder>::channelOf(unsigned index,
                                                            const ExtendedPoint& first) {
  auto& channel = channels_[index];
  if (used_[index]) return *channel;
  if (!channel) channel = std::make_unique<Channel>();
  channel->begin(first);
  used_[index] = true;
  return *channel;
}

template <class Coder>
void Point14<Coder>::code(typename Coder::Record item, unsigned& channel) {
  Channel& before = *channels_[active_];
  ExtendedPoint now;
  unsigned changed = 0;
  if constexpr (Coder::kEncodes) {
    now = ExtendedPoint::at(item);
    changed = changes(now);
  }
  const unsigned place = placeOf(before.last, 1, 2) + (before.time_changed ? 4 : 0);
  changed = layers_[xy].coder.symbol(before.changes[place], changed);
  const unsigned index = codeChannel(changed, now.channel());
  Channel& c = channelOf(index, before.last);
  if (!Coder::kEncodes) now = c.last;
  now.setChannel(index);
  channel = tells_channel_always_ || index != active_ ? index : 0;
  active_ = index;

  codeReturns(c, changed, now);
  const unsigned time_changed = (changed & time_change) != 0 ? 1 : 0;
  const Context context{time_changed, placeOf(now, 2, 1), groupOf(now.returns(), now.number()),
                        std::min(returnsBelow(now.returns(), now.number()), 7U),
                        now.returns() == 1 ? 1U : 0U};
  codeXY(c, context, now);
  codeZ(c, context, now);
  codeClassification(c, context, now);
  codeFlags(c, now);
  codeIntensity(c, context, now);
  codeUser(c, now);
  codeChanges(c, changed, now);
  c.last = now;
  c.time_changed = time_changed != 0;
  if constexpr (!Coder::kEncodes) now.storeAt(item);
}

template <class Coder>
unsigned Point14<Coder>::changes(const ExtendedPoint& now) const {
  const unsigned channel = now.channel();
  const ExtendedPoint& last = channels_[used_[channel] ? channel : active_]->last;
  const unsigned step = (now.number() - last.number()) & 15U;
  unsigned number = number_mask;
  if (step <= 1) number = step;
  if (step == 15) number = 2;
  return number | flag(now.returns() != last.returns(), returns_change) |
         flag(now.f.angle != last.f.angle, angle_change) |
         flag(now.time != last.time, time_change) |
         flag(now.f.source != last.f.source, source_change) |
         flag(channel != active_, channel_change);
}

template <class Coder>
unsigned Point14<Coder>::codeChannel(unsigned changed, unsigned now) {
  if ((changed & channel_change) == 0) return active_;
  auto& model = channels_[active_]->channels[0];
  const unsigned step = layers_[xy].coder.symbol(model, (now - active_ - 1) % kChannels);
  return (active_ + step + 1) % kChannels;
}

template <class Coder>
void Point14<Coder>::codeReturns(Channel& c, unsigned changed, ExtendedPoint& now) {
  Coder& coder = layers_[xy].coder;
  const unsigned last_returns = c.last.returns(), last_number = c.last.number();
  unsigned returns = last_returns, number = last_number;
  if ((changed & returns_change) != 0)
    returns = coder.symbol(c.returns[last_returns], now.returns());
  switch (changed & number_mask) {
    case 0:
      break;
    case 1:
      number = last_number + 1;
      break;
    case 2:
      number = last_number + 15;
      break;
    default:
      number =
          (changed & time_change) != 0
              ? coder.symbol(c.numbers[last_number], now.number())
              : last_number + 2 +
                    coder.symbol(c.numbers_same_time[0], (now.number() - last_number - 2) & 15U);
  }
  now.setReturns(number & 15U, returns);
}

template <class Coder>
void Point14<Coder>::codeXY(Channel& c, const Context& context, ExtendedPoint& now) {
  Coder& coder = layers_[xy].coder;
  const ExtendedPoint::Fields& last = c.last.f;
  RunningMedian& dx_median = c.dx_median[context.group * 2 + context.time_changed];
  RunningMedian& dy_median = c.dy_median[context.group * 2 + context.time_changed];
  const std::int32_t dx =
      c.dx.code(coder, dx_median.value(), wrappedDifference(now.f.x, last.x), context.single);
  dx_median.add(dx);
  const std::int32_t dy = c.dy.code(coder, dy_median.value(), wrappedDifference(now.f.y, last.y),
                                    context.single + pairedClass(c.dx.lastClass(), 20));
  dy_median.add(dy);
  now.f.x = wrappedSum(last.x, dx);
  now.f.y = wrappedSum(last.y, dy);
}

template <class Coder>
void Point14<Coder>::codeZ(Channel& c, const Context& context, ExtendedPoint& now) {
  Layer<Coder>& layer = layers_[z];
  if (!layer.coded()) return;
  const unsigned precision = (c.dx.lastClass() + c.dy.lastClass()) / 2;
  std::int32_t& last = c.last_z[context.level];
  last = c.z.code(layer.coder, last, now.f.z, context.single + pairedClass(precision, 18));
  now.f.z = last;
}

template <class Coder>
void Point14<Coder>::codeClassification(Channel& c, const Context& context, ExtendedPoint& now) {
  Layer<Coder>& layer = layers_[type];
  if (!layer.coded()) return;
  const std::uint8_t last = c.last.f.classification;
  const unsigned only_return = context.place == 3 ? 1 : 0;
  auto& model = c.types[(last & 31U) * 2 + only_return];
  now.f.classification = static_cast<std::uint8_t>(layer.coder.symbol(model, now.f.classification));
  if (now.f.classification != last) layer.present = true;
}

template <class Coder>
void Point14<Coder>::codeFlags(Channel& c, ExtendedPoint& now) {
  Layer<Coder>& layer = layers_[flags];
  if (!layer.coded()) return;
  const unsigned last = c.last.flags();
  const unsigned coded = layer.coder.symbol(c.flags[last], now.flags());
  now.setFlags(coded);
  if (coded != last) layer.present = true;
}

template <class Coder>
void Point14<Coder>::codeIntensity(Channel& c, const Context& context, ExtendedPoint& now) {
  Layer<Coder>& layer = layers_[intensity];
  if (!layer.coded()) return;
  std::uint16_t& last = c.last_intensity[context.place * 2 + context.time_changed];
  last = static_cast<std::uint16_t>(
      c.intensity.code(layer.coder, last, now.f.intensity, context.place));
  now.f.intensity = last;
  if (now.f.intensity != c.last.f.intensity) layer.present = true;
}

template <class Coder>
void Point14<Coder>::codeUser(Channel& c, ExtendedPoint& now) {
  Layer<Coder>& layer = layers_[user];
  if (!layer.coded()) return;
  const std::uint8_t last = c.last.f.user;
  now.f.user = static_cast<std::uint8_t>(layer.coder.symbol(c.users[last / 4], now.f.user));
  if (now.f.user != last) layer.present = true;
}

/// The layers that hold a value only for points where the first layer announces a change.
template <class Coder>
void Point14<Coder>::codeChanges(Channel& c, unsigned changed, ExtendedPoint& now) {
  const auto announced = [&](LayerIndex i, Change change) {
    if ((changed & change) == 0 || !layers_[i].coded()) return false;
    layers_[i].present = true;
    return true;
  };
  const ExtendedPoint::Fields& last = c.last.f;
  if (announced(angle, angle_change))
    now.f.angle = static_cast<std::int16_t>(c.angle.code(
        layers_[angle].coder, last.angle, now.f.angle, (changed & time_change) != 0 ? 1 : 0));
  if (announced(source, source_change))
    now.f.source =
        static_cast<std::uint16_t>(c.source.code(layers_[source].coder, last.source, now.f.source));
  if (announced(time, time_change)) now.time = c.times.code(layers_[time].coder, now.time);
}

template class Point14<EntropyDecoder>;
template class Point14<EntropyEncoder>;

}  // namespace pcl_als::laz
