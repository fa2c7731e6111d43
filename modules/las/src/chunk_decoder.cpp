// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include "chunk_items.h"

namespace pcl_als::laz {
namespace {

class PointwiseDecoder : public ChunkDecoder {
 public:
  explicit PointwiseDecoder(const LazSchema& schema)
      : record_length_(schema.recordLength()),
        items_(
            placeItems<PointwiseItem<EntropyDecoder>>(schema, makePointwiseItem<EntropyDecoder>)) {}

  void open(const LazReadAt* read, std::uint64_t begin, std::uint64_t end) override {
    coder_.source().open(read, begin, end);
    first_ = true;
  }

  void decode(std::size_t records, std::uint8_t* out) override {
    for (; records > 0; --records, out += record_length_) {
      if (first_)
        begin(out);
      else
        for (auto& placed : items_) placed.item->code(coder_, out + placed.position);
    }
  }

  std::uint64_t end() const override { return coder_.source().position(); }
  bool ended() const override { return !first_ && coder_.ended(); }

 private:
  void begin(std::uint8_t* out) {
    coder_.source().take(record_length_, out);
    for (auto& placed : items_) placed.item->start(out + placed.position);
    coder_.start();
    first_ = false;
  }

  std::size_t record_length_;
  std::vector<PlacedItem<PointwiseItem<EntropyDecoder>>> items_;
  EntropyDecoder coder_;
  bool first_ = true;
};

/// The fields of the layers of an item, in the order of its layers.
std::vector<unsigned> layerFields(const LazItem& item) {
  switch (item.type) {
    case LazItemType::point14:
      return {kLazAllFields, kLazZ,        kLazClassification, kLazFlags,  kLazIntensity,
              kLazScanAngle, kLazUserData, kLazPointSource,    kLazGpsTime};
    case LazItemType::rgb14:
      return {kLazColour};
    case LazItemType::rgb_nir14:
      return {kLazColour, kLazInfrared};
    case LazItemType::wave_packet14:
      return {kLazWavePacket};
    default:
      return std::vector<unsigned>(item.size, kLazExtraBytes);
  }
}

class LayeredDecoder : public ChunkDecoder {
 public:
  LayeredDecoder(const LazSchema& schema, unsigned fields)
      : record_length_(schema.recordLength()),
        items_(placeItems<LayeredItem<EntropyDecoder>>(schema, makeLayeredItem<EntropyDecoder>)) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const std::vector<unsigned> layer_fields = layerFields(schema.items[i]);
      for (std::size_t layer = 0; layer < layer_fields.size(); ++layer) {
        layers_.push_back(&items_[i].item->layer(layer));
        wanted_.push_back(layers_.size() == 1 || (layer_fields[layer] & fields) != 0);
      }
    }
  }

  void open(const LazReadAt* read, std::uint64_t begin, std::uint64_t end) override {
    read_ = read;
    header_.open(read, begin, end);
    end_ = end;
    first_ = true;
  }

  void decode(std::size_t records, std::uint8_t* out) override {
    for (; records > 0; --records, out += record_length_) {
      if (first_) {
        begin(out);
        continue;
      }
      if (left_ == 0) throw Damage("the chunk holds fewer points than it must");
      --left_;
      unsigned channel = 0;
      for (auto& placed : items_) placed.item->code(out + placed.position, channel);
    }
  }

  std::uint64_t end() const override { return end_; }
  bool ended() const override {
    return left_ == 0 && std::all_of(layers_.begin(), layers_.end(), [](const auto* layer) {
             return !layer->present || (layer->coder.source().left() == 0 && layer->coder.ended());
           });
  }

 private:
  void begin(std::uint8_t* out) {
    header_.take(record_length_, out);
    left_ = header_.nextU32();
    if (left_-- == 0) throw Damage("the chunk says that it has no points");
    openLayers();
    const unsigned channel = channelOf(out);
    for (auto& placed : items_) placed.item->start(out + placed.position, channel);
    first_ = false;
  }

  void openLayers() {
    sizes_.clear();
    for (std::size_t i = 0; i < layers_.size(); ++i) sizes_.push_back(header_.nextU32());
    std::uint64_t at = header_.position();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      if (sizes_[i] > end_ - at) throw Damage("the chunk is shorter than its layers");
      Layer<EntropyDecoder>& layer = *layers_[i];
      layer.present = wanted_[i] && (sizes_[i] > 0 || i == 0);
      if (layer.present) {
        layer.coder.source().open(read_, at, at + sizes_[i]);
        layer.coder.start();
      }
      at += sizes_[i];
    }
    end_ = at;
  }

  std::size_t record_length_;
  std::vector<PlacedItem<LayeredItem<EntropyDecoder>>> items_;
  std::vector<Layer<EntropyDecoder>*> layers_;
  std::vector<bool> wanted_;
  std::vector<std::uint32_t> sizes_;
  const LazReadAt* read_ = nullptr;
  ByteSource header_;
  std::uint64_t end_ = 0;
  std::uint32_t left_ = 0;
  bool first_ = true;
};

}  // namespace

void requireEnd(const ChunkDecoder& decoder, const Chunk& chunk, bool knows_end) {
  if (chunk.holds_more || (decoder.ended() && (!knows_end || decoder.end() == chunk.end))) return;
  throw Damage(
      "its data do not end behind its points: some of these are wrong, or the header announces too "
      "few");
}

std::unique_ptr<ChunkDecoder> makeChunkDecoder(const LazSchema& schema, unsigned fields) {
  if (schema.layered()) return std::make_unique<LayeredDecoder>(schema, fields);
  return std::make_unique<PointwiseDecoder>(schema);
}

LayeredExtent layeredExtent(const LazSchema& schema, const LazReadAt& read, std::uint64_t begin,
                            std::uint64_t end) {
  std::size_t layers = 0;
  for (const LazItem& item : schema.items) layers += layerFields(item).size();
  const std::uint64_t sizes = begin + schema.recordLength() + sizeof(std::uint32_t);
  const std::uint64_t data = sizes + layers * sizeof(std::uint32_t);
  if (data > end) throw Damage("the chunk is cut off");
  ByteSource header;
  header.open(&read, sizes - sizeof(std::uint32_t), data);
  LayeredExtent extent;
  extent.points = header.nextU32();
  extent.end = data;
  for (std::size_t i = 0; i < layers; ++i) extent.end += header.nextU32();
  if (extent.end > end) throw Damage("the chunk is cut off");
  return extent;
}

}  // namespace pcl_als::laz
