// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "layered_items.h"

namespace pcl_als::laz {

template <class Coder>
void LayeredColour<Coder>::State::begin(const Colour& first, std::uint16_t first_infrared) {
  last = first;
  last_infrared = first_infrared;
  colour.reset();
  infrared.reset();
}

template <class Coder>
void LayeredColour<Coder>::start(const std::uint8_t* first, unsigned channel) {
  const std::uint16_t infrared = infrared_ ? load<std::uint16_t>(first + sizeof(Colour)) : 0;
  states_.start(channel, [&](State& state) { state.begin(load<Colour>(first), infrared); });
}

template <class Coder>
void LayeredColour<Coder>::code(typename Coder::Record item, unsigned& channel) {
  const auto [models, reference] = states_.select(channel);
  Colour now{};
  std::uint16_t infrared = 0;
  if constexpr (Coder::kEncodes) {
    now = load<Colour>(item);
    if (infrared_) infrared = load<std::uint16_t>(item + sizeof(Colour));
  }
  if (layers_[0].coded() && models.colour.code(layers_[0].coder, now, reference.last))
    layers_[0].present = true;
  if (infrared_ && layers_[1].coded() &&
      models.infrared.code(layers_[1].coder, infrared, reference.last_infrared))
    layers_[1].present = true;
  if constexpr (!Coder::kEncodes) {
    store(item, reference.last);
    if (infrared_) store(item + sizeof(Colour), reference.last_infrared);
  }
}

template <class Coder>
void LayeredWavePacket<Coder>::State::begin(const WavePacket& first) {
  last = first;
  packets.reset();
}

template <class Coder>
void LayeredWavePacket<Coder>::start(const std::uint8_t* first, unsigned channel) {
  states_.start(channel, [&](State& state) { state.begin(WavePacket::at(first)); });
}

template <class Coder>
void LayeredWavePacket<Coder>::code(typename Coder::Record item, unsigned& channel) {
  const auto [models, reference] = states_.select(channel);
  WavePacket now;
  if constexpr (Coder::kEncodes) {
    now = WavePacket::at(item);
    if (!(now == reference.last)) layer_.present = true;
  }
  if (layer_.coded()) models.packets.code(layer_.coder, now, reference.last);
  if constexpr (!Coder::kEncodes) reference.last.storeAt(item);
}

template <class Coder>
void LayeredBytes<Coder>::State::begin(const std::uint8_t* first, std::size_t size) {
  last.assign(first, first + size);
  if (!models) models.emplace(size, 256);
  models->reset();
}

template <class Coder>
void LayeredBytes<Coder>::start(const std::uint8_t* first, unsigned channel) {
  states_.start(channel, [&](State& state) { state.begin(first, layers_.size()); });
}

template <class Coder>
void LayeredBytes<Coder>::code(typename Coder::Record item, unsigned& channel) {
  const auto [models, reference] = states_.select(channel);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    std::uint8_t& last = reference.last[i];
    Layer<Coder>& layer = layers_[i];
    if (layer.coded()) {
      std::uint8_t change = 0;
      if constexpr (Coder::kEncodes) change = static_cast<std::uint8_t>(item[i] - last);
      change = static_cast<std::uint8_t>(layer.coder.symbol((*models.models)[i], change));
      if (change != 0) layer.present = true;
      last = static_cast<std::uint8_t>(last + change);
    }
    if constexpr (!Coder::kEncodes) item[i] = last;
  }
}

template class LayeredColour<EntropyDecoder>;
template class LayeredColour<EntropyEncoder>;
template class LayeredWavePacket<EntropyDecoder>;
template class LayeredWavePacket<EntropyEncoder>;
template class LayeredBytes<EntropyDecoder>;
template class LayeredBytes<EntropyEncoder>;

}  // namespace pcl_als::laz
