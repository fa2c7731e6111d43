// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/las/las_header.h>
#include <pcl_als/las/laz_point_writer.h>

#include "las_bytes.h"

namespace pcl_als::test {

/** \brief A COPC file made from points by the published specification (COPC 1.0): point format 6,
 * a chunk for each node, the hierarchy in an EVLR.
 *
 * A node takes a point where its grid of 16^3 cells has none yet; others go to a child. The
 * hierarchy has a page for the levels 0 and 1, and one for each node of level 2 with those below.
 */
class CopcBytes {
 public:
  struct Point {
    std::int32_t x = 0, y = 0, z = 0;  ///< steps, from 0 to the side of the cube
    std::string record;                ///< of 30 bytes, with these coordinates
  };
  using Key = std::array<std::int32_t, 4>;  ///< level, x, y, z

  /// The cube and what its coordinates mean.
  struct Frame {
    std::int32_t side = 1 << 16;                       ///< of the cube, steps; a power of 2
    double step = 0.01;                                ///< m
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of the cube, m
    int deepest = 4;                                   ///< level
    int version_minor = 4;                             ///< of LAS; 5: times are offset by 1e8 s
    double sideLength() const { return side * step; }
    double spacing() const { return sideLength() / 16; }  ///< of the root node
  };

  CopcBytes(const std::vector<Point>& points, const Frame& frame) : frame_(frame) {
    for (const Point& point : points) insert(point);
    write();
  }

  /// Position of the payload of the info VLR, which follows the header.
  static std::size_t infoAt(int version_minor = 4) { return LasHeader::sizeOf(version_minor) + 54; }
  const Frame& frame() const { return frame_; }
  const std::string& str() const { return bytes_; }
  const std::map<Key, std::vector<Point>>& nodes() const { return nodes_; }
  std::size_t rootPage() const { return root_page_; }  ///< position
  /// Positions of the entries of the root page that refer to other pages.
  const std::vector<std::size_t>& pageEntries() const { return page_entries_; }
  /// Position of the entry of a node in its page.
  std::size_t entryOf(const Key& key) const { return entries_.at(key); }
  /// All points in the order of the file.
  std::vector<Point> inOrder() const {
    std::vector<Point> all;
    for (const auto& node : nodes_) all.insert(all.end(), node.second.begin(), node.second.end());
    return all;
  }

 private:
  void insert(const Point& point) {
    for (int level = 0;; ++level) {
      const std::int32_t size = frame_.side >> level, cell = std::max(1, size / 16);
      const Key key{level, std::min(point.x, frame_.side - 1) / size,
                    std::min(point.y, frame_.side - 1) / size,
                    std::min(point.z, frame_.side - 1) / size};
      const Key place{level, point.x / cell, point.y / cell, point.z / cell};
      if (level < frame_.deepest && !taken_.insert(place).second) continue;
      nodes_[key].push_back(point);
      return;
    }
  }

  struct Chunk {
    std::uint64_t offset = 0;
    std::int32_t bytes = 0, points = 0;
  };

  void put(std::size_t at, const std::string& data) {
    if (bytes_.size() < at + data.size()) bytes_.resize(at + data.size());
    bytes_.replace(at, data.size(), data);
  }

  void write() {
    const LazSchema schema = LazSchema::forFormat(6, 30, kLazVariableChunks);
    const auto payload = schema.serialise();
    const std::string laszip =
        LasBytes::vlr(kLazUser, kLazRecord, std::string(payload.begin(), payload.end()));
    const std::size_t info_at = infoAt(frame_.version_minor);
    const std::size_t points_at = info_at + 160 + laszip.size();
    std::map<Key, Chunk> chunks;
    const std::uint64_t evlr = writePoints(schema, points_at, chunks);
    writeHierarchy(evlr, chunks);
    const double half = 0.5 * frame_.sideLength();
    Bytes info;
    for (int axis = 0; axis < 3; ++axis) info.f64(frame_.offset[axis] + half);
    info.f64(half).f64(frame_.spacing());
    info.u64(root_page_).u64(root_bytes_).f64(0.0).f64(0.0).raw(std::string(88, '\0'));
    put(info_at - 54, LasBytes::vlr("copc", 1, info.str()));
    put(info_at + 160, laszip);
    writeHeader(points_at, evlr);
  }

  std::uint64_t writePoints(const LazSchema& schema, std::size_t points_at,
                            std::map<Key, Chunk>& chunks) {
    LazPointWriter writer(
        schema,
        [this](std::uint64_t position, std::size_t bytes, const void* data) {
          put(position, std::string(static_cast<const char*>(data), bytes));
        },
        points_at, 1);
    for (const auto& [key, points] : nodes_) {
      std::string records;
      for (const Point& point : points) records += point.record;
      writer.write(records.data(), points.size());
      writer.endChunk();
    }
    const std::uint64_t end = writer.finish();
    // The sizes of the layers tell where a chunk ends: the format has no other list of positions
    // than the chunk table, which would be decoded by the code under test.
    std::uint64_t at = points_at + 8;
    for (const auto& [key, points] : nodes_) {
      std::uint32_t count = 0, size = 0;
      std::memcpy(&count, &bytes_[at + 30], sizeof count);
      std::uint64_t chunk_end = at + 30 + 4 + 9 * 4;
      for (int layer = 0; layer < 9; ++layer) {
        std::memcpy(&size, &bytes_[at + 34 + 4 * static_cast<std::size_t>(layer)], sizeof size);
        chunk_end += size;
      }
      chunks[key] = {at, static_cast<std::int32_t>(chunk_end - at),
                     static_cast<std::int32_t>(count)};
      at = chunk_end;
    }
    return end;
  }

  static std::string entry(const Key& key, const Chunk& chunk) {
    return Bytes()
        .i32(key[0])
        .i32(key[1])
        .i32(key[2])
        .i32(key[3])
        .u64(chunk.offset)
        .i32(chunk.bytes)
        .i32(chunk.points)
        .str();
  }

  /// The node of level 2 that contains a deeper one, or itself.
  static Key subtreeOf(const Key& key) {
    const int up = key[0] - 2;
    return {2, key[1] >> up, key[2] >> up, key[3] >> up};
  }

  void writeHierarchy(std::uint64_t evlr, const std::map<Key, Chunk>& chunks) {
    std::map<Key, std::vector<Key>> pages;  // of the nodes of level 2
    std::vector<Key> root;
    for (const auto& chunk : chunks) {
      if (chunk.first[0] < 2)
        root.push_back(chunk.first);
      else
        pages[subtreeOf(chunk.first)].push_back(chunk.first);
    }
    std::string payload;
    std::size_t at = evlr + 60;
    root_page_ = at;
    root_bytes_ = 32 * (root.size() + pages.size());
    std::size_t page_at = at + root_bytes_;
    for (const Key& key : root) {
      entries_[key] = at + payload.size();
      payload += entry(key, chunks.at(key));
    }
    for (const auto& [key, keys] : pages) {
      page_entries_.push_back(at + payload.size());
      payload += entry(key, {page_at, static_cast<std::int32_t>(32 * keys.size()), -1});
      page_at += 32 * keys.size();
    }
    for (const auto& page : pages)
      for (const Key& key : page.second) {
        entries_[key] = at + payload.size();
        payload += entry(key, chunks.at(key));
      }
    put(evlr, LasBytes::evlr("copc", 1000, payload));
  }

  void writeHeader(std::size_t points_at, std::uint64_t evlr) {
    const std::vector<Point> all = inOrder();
    LasHeader header;
    header.global_encoding = kLasAdjustedStandardTime | kLasWkt;
    header.version_minor = frame_.version_minor;
    header.header_size = LasHeader::sizeOf(header.version_minor);
    if (header.version_minor == 5) {
      header.global_encoding |= kLasTimeOffset;
      header.time_offset = 100;
    }
    header.offset_to_points = static_cast<std::uint32_t>(points_at);
    header.vlr_count = 2;
    header.point_format = 6;
    header.record_length = 30;
    header.point_count = all.size();
    for (const Point& p : all)
      ++header.points_by_return[(static_cast<unsigned char>(p.record[14]) & 15U) - 1];
    header.scale.setConstant(frame_.step);
    header.offset = frame_.offset;
    header.minimum.setConstant(1e9);
    header.maximum.setConstant(-1e9);
    for (const Point& p : all) {
      const Eigen::Vector3d place = frame_.step * Eigen::Vector3d(p.x, p.y, p.z) + frame_.offset;
      header.minimum = header.minimum.cwiseMin(place);
      header.maximum = header.maximum.cwiseMax(place);
    }
    header.evlr_start = evlr;
    header.evlr_count = 1;
    std::vector<std::byte> block = serialiseLasHeader(header);
    block[104] |= std::byte{0x80};
    put(0, std::string(reinterpret_cast<const char*>(block.data()), block.size()));
  }

  Frame frame_;
  std::map<Key, std::vector<Point>> nodes_;
  std::set<Key> taken_;
  std::string bytes_;
  std::size_t root_page_ = 0, root_bytes_ = 0;
  std::map<Key, std::size_t> entries_;
  std::vector<std::size_t> page_entries_;
};

/// Points of a rough surface, in an order without relation to their places.
inline std::vector<CopcBytes::Point> copcPoints(std::size_t count) {
  std::vector<CopcBytes::Point> points(count);
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::int32_t>(state >> 48U);  // 0 to 65535
  };
  for (std::size_t i = 0; i < count; ++i) {
    CopcBytes::Point& p = points[i];
    p.x = next(), p.y = next();
    p.z = 30000 + next() / 64;
    Bytes record;
    record.i32(p.x).i32(p.y).i32(p.z).u16(i % 65536).u8(1U | 1U << 4U).u8(0).u8(2).u8(0).i16(0);
    record.u16(1 + p.y / 32768).f64(1e8 + 1e-4 * static_cast<double>(i));
    p.record = record.str();
  }
  return points;
}

}  // namespace pcl_als::test
