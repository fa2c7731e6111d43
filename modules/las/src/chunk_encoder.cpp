// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "chunk_items.h"

namespace pcl_als::laz {
namespace {

void append(std::vector<std::uint8_t>& out, const std::uint8_t* data, std::size_t size) {
  out.insert(out.end(), data, data + size);
}

void appendU32(std::vector<std::uint8_t>& out, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  const std::size_t at = out.size();
  out.resize(at + sizeof number);
  store(&out[at], number);
}

class PointwiseEncoder : public ChunkEncoder {
 public:
  explicit PointwiseEncoder(const LazSchema& schema)
      : record_length_(schema.recordLength()),
        items_(
            placeItems<PointwiseItem<EntropyEncoder>>(schema, makePointwiseItem<EntropyEncoder>)) {}

  void encode(std::size_t records, const std::uint8_t* data) override {
    for (; records > 0; --records, data += record_length_) {
      if (first_.empty())
        begin(data);
      else
        for (auto& placed : items_) placed.item->code(coder_, data + placed.position);
    }
  }

  void finish(std::vector<std::uint8_t>& out) override {
    if (first_.empty()) return;
    coder_.finish();
    append(out, first_.data(), first_.size());
    append(out, coder_.data(), coder_.size());
    first_.clear();
  }

 private:
  void begin(const std::uint8_t* data) {
    first_.assign(data, data + record_length_);
    for (auto& placed : items_) placed.item->start(data + placed.position);
    coder_.start();
  }

  std::size_t record_length_;
  std::vector<PlacedItem<PointwiseItem<EntropyEncoder>>> items_;
  EntropyEncoder coder_;
  std::vector<std::uint8_t> first_;
};

class LayeredEncoder : public ChunkEncoder {
 public:
  explicit LayeredEncoder(const LazSchema& schema)
      : record_length_(schema.recordLength()),
        items_(placeItems<LayeredItem<EntropyEncoder>>(schema, makeLayeredItem<EntropyEncoder>)) {
    for (auto& placed : items_)
      for (std::size_t i = 0; i < placed.item->layers(); ++i)
        layers_.push_back(&placed.item->layer(i));
  }

  void encode(std::size_t records, const std::uint8_t* data) override {
    points_ += records;
    for (; records > 0; --records, data += record_length_) {
      if (first_.empty()) {
        begin(data);
        continue;
      }
      unsigned channel = 0;
      for (auto& placed : items_) placed.item->code(data + placed.position, channel);
    }
  }

  void finish(std::vector<std::uint8_t>& out) override {
    if (first_.empty()) return;
    append(out, first_.data(), first_.size());
    appendU32(out, points_);
    for (Layer<EntropyEncoder>* layer : layers_) {
      layer->coder.finish();
      appendU32(out, layer->present ? layer->coder.size() : 0);
    }
    for (Layer<EntropyEncoder>* layer : layers_)
      if (layer->present) append(out, layer->coder.data(), layer->coder.size());
    first_.clear();
    points_ = 0;
  }

 private:
  void begin(const std::uint8_t* data) {
    first_.assign(data, data + record_length_);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      layers_[i]->coder.start();
      layers_[i]->present = i <= Point14<EntropyEncoder>::z;  // the coordinates are always there
    }
    const unsigned channel = channelOf(data);
    for (auto& placed : items_) placed.item->start(data + placed.position, channel);
  }

  std::size_t record_length_;
  std::vector<PlacedItem<LayeredItem<EntropyEncoder>>> items_;
  std::vector<Layer<EntropyEncoder>*> layers_;
  std::vector<std::uint8_t> first_;
  std::size_t points_ = 0;
};

}  // namespace

std::unique_ptr<ChunkEncoder> makeChunkEncoder(const LazSchema& schema) {
  if (schema.layered()) return std::make_unique<LayeredEncoder>(schema);
  return std::make_unique<PointwiseEncoder>(schema);
}

}  // namespace pcl_als::laz
