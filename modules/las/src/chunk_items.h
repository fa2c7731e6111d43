// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "chunk_coder.h"
#include "layered_point14.h"

namespace pcl_als::laz {

template <class Coder>
std::unique_ptr<PointwiseItem<Coder>> makePointwiseItem(const LazItem& item) {
  const bool old = item.version == 1;
  const auto either = [old](auto first, auto second) -> std::unique_ptr<PointwiseItem<Coder>> {
    if (old) return first();
    return second();
  };
  switch (item.type) {
    case LazItemType::point10:
      return either([] { return std::make_unique<Point10V1<Coder>>(); },
                    [] { return std::make_unique<Point10V2<Coder>>(); });
    case LazItemType::gps_time11:
      return either([] { return std::make_unique<GpsTimeV1<Coder>>(); },
                    [] { return std::make_unique<GpsTimeV2<Coder>>(); });
    case LazItemType::rgb12:
      return either([] { return std::make_unique<ColourV1<Coder>>(); },
                    [] { return std::make_unique<ColourV2<Coder>>(); });
    case LazItemType::wave_packet13:
      return std::make_unique<WavePacketItem<Coder>>();
    default:
      return either([&] { return std::make_unique<BytesV1<Coder>>(item.size); },
                    [&] { return std::make_unique<BytesV2<Coder>>(item.size); });
  }
}

template <class Coder>
std::unique_ptr<LayeredItem<Coder>> makeLayeredItem(const LazItem& item) {
  switch (item.type) {
    case LazItemType::point14:
      return std::make_unique<Point14<Coder>>(item.version);
    case LazItemType::rgb14:
      return std::make_unique<LayeredColour<Coder>>(item.version, false);
    case LazItemType::rgb_nir14:
      return std::make_unique<LayeredColour<Coder>>(item.version, true);
    case LazItemType::wave_packet14:
      return std::make_unique<LayeredWavePacket<Coder>>(item.version);
    default:
      return std::make_unique<LayeredBytes<Coder>>(item.version, item.size);
  }
}

/// The items of a record and where each begins.
template <class Item>
struct PlacedItem {
  std::unique_ptr<Item> item;
  std::size_t position;
};

template <class Item, class Make>
std::vector<PlacedItem<Item>> placeItems(const LazSchema& schema, const Make& make) {
  std::vector<PlacedItem<Item>> items;
  std::size_t position = 0;
  for (const LazItem& item : schema.items) {
    items.push_back({make(item), position});
    position += item.size;
  }
  return items;
}

/// Scanner channel of a record of the formats 6 to 10.
inline unsigned channelOf(const std::uint8_t* record) {
  return ExtendedPoint::at(record).channel();
}

}  // namespace pcl_als::laz
