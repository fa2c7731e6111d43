// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <pcl_als/las/laz_point_reader.h>
#include <pcl_als/las/laz_point_writer.h>

namespace pcl_als::test {

using ByteVector = std::vector<std::uint8_t>;

/// The reader of a LAZ file that lies in memory.
inline LazReadAt readFrom(const ByteVector& file) {
  return [&file](std::uint64_t position, std::size_t bytes, void* out) {
    if (position > file.size() || bytes > file.size() - position)
      throw std::logic_error("the codec reads past the end of the file");
    std::memcpy(out, file.data() + position, bytes);
  };
}

/// \param chunk_ends where the chunks of variable size end; ascending.
inline ByteVector encode(const LazSchema& schema, const ByteVector& records, int threads = 1,
                         const std::vector<std::size_t>& chunk_ends = {}) {
  ByteVector file;
  LazPointWriter writer(
      schema,
      [&file](std::uint64_t position, std::size_t bytes, const void* data) {
        if (file.size() < position + bytes) file.resize(position + bytes);
        std::memcpy(file.data() + position, data, bytes);
      },
      0, threads);
  const std::size_t length = schema.recordLength(), count = records.size() / length;
  std::size_t first = 0;
  for (const std::size_t end : chunk_ends) {
    writer.write(&records[first * length], end - first);
    writer.endChunk();
    first = end;
  }
  while (first < count) {
    const std::size_t part = std::min<std::size_t>(777, count - first);
    writer.write(&records[first * length], part);
    first += part;
  }
  writer.finish();
  return file;
}

inline ByteVector decode(const LazSchema& schema, const ByteVector& file, std::size_t count,
                         int threads = 1, std::size_t step = 1000,
                         unsigned fields = kLazAllFields) {
  LazPointReader reader(schema, readFrom(file), {0, file.size(), count, fields, threads}, "a.laz");
  const std::size_t length = schema.recordLength();
  ByteVector records(count * length);
  for (std::size_t first = 0; first < count; first += step)
    reader.read(first, std::min(step, count - first), &records[first * length]);
  return records;
}

/// The parts of a complete LAZ file that its decoding needs, read by hand.
struct LazFile {
  ByteVector bytes;
  LazSchema schema;
  LazPoints points;
  int format = 0;

  explicit LazFile(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    if (bytes.size() < 227) throw std::runtime_error(path + " cannot be read");
    const std::size_t vlr = number<std::uint16_t>(94);  // the only one
    schema = LazSchema::parse(&bytes[vlr + 54], number<std::uint16_t>(vlr + 20), path);
    format = bytes[104] & 63;
    points.offset_to_points = number<std::uint32_t>(96);
    points.point_count = bytes[25] < 4 ? number<std::uint32_t>(107) : number<std::uint64_t>(247);
    points.file_size = bytes.size();
  }

  ByteVector decode(int threads = 1) const {
    LazPoints wanted = points;
    wanted.threads = threads;
    LazPointReader reader(schema, readFrom(bytes), wanted, "a.laz");
    ByteVector records(points.point_count * schema.recordLength());
    reader.read(0, points.point_count, records.data());
    return records;
  }

 private:
  template <typename T>
  T number(std::size_t at) const {
    T value;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  }
};

}  // namespace pcl_als::test
