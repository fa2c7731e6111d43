// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// las_damage IN OUT CHANGE…: a copy of a LAS file with lies in it, for tests.
//   set FIELD VALUE   a field of the header, see kFields
//   zero_times        the GPS time of every point (formats 6-10)
//   some_times        the GPS time of every tenth point (formats 6-10)
//   whole_seconds     the GPS time of every point rounded down (formats 6-10)
//   append FILE       the points of another file of the same layout (no lie; formats 6-10)
//   source_id BYTE    both bytes of the point source id of every point (formats 6-10)
//   pulse_ids         point source ids count the points from one (formats 6-10)
//   class CODE        of every point
//   keep BYTES        only the first bytes
//   crop_y FROM TO    only the points in that range of northings (no lie; LAS 1.2, 1.3)
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace {

struct Field {
  std::size_t position, size;
  bool real;
};

const std::map<std::string, Field> kFields{
    {"signature", {0, 4, false}},
    {"version_minor", {25, 1, false}},
    {"header_size", {94, 2, false}},
    {"offset_to_points", {96, 4, false}},
    {"vlr_count", {100, 4, false}},
    {"point_format", {104, 1, false}},
    {"record_length", {105, 2, false}},
    {"scale_x", {131, 8, true}},
    {"offset_x", {155, 8, true}},
    {"max_x", {179, 8, true}},
    {"min_x", {187, 8, true}},
    {"max_y", {195, 8, true}},
    {"min_y", {203, 8, true}},
    {"evlr_start", {235, 8, false}},
    {"evlr_count", {243, 4, false}},
    {"point_count", {247, 8, false}},
    {"vlr_length", {375 + 20, 2, false}},
    {"vlr_record", {375 + 18, 2, false}},
};

template <typename T>
T load(const std::vector<char>& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

void set(std::vector<char>& bytes, const Field& field, const std::string& text) {
  if (field.real) {
    const double value = std::strtod(text.c_str(), nullptr);
    std::memcpy(bytes.data() + field.position, &value, sizeof(value));
  } else {
    const std::uint64_t value = std::strtoull(text.c_str(), nullptr, 0);
    std::memcpy(bytes.data() + field.position, &value, field.size);
  }
}

std::vector<char> readAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Sets bytes of every record, or of some.
void fillRecords(std::vector<char>& bytes, std::size_t at, std::size_t size, int value,
                 std::size_t every = 1) {
  const std::size_t length = load<std::uint16_t>(bytes, 105);
  const auto count = load<std::uint64_t>(bytes, 247);
  for (std::size_t i = 0; i < count; i += every)
    std::memset(bytes.data() + load<std::uint32_t>(bytes, 96) + i * length + at, value, size);
}

void cutTimes(std::vector<char>& bytes) {
  const std::size_t length = load<std::uint16_t>(bytes, 105);
  const auto count = load<std::uint64_t>(bytes, 247);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = load<std::uint32_t>(bytes, 96) + i * length + 22;
    const double time = std::floor(load<double>(bytes, at));
    std::memcpy(bytes.data() + at, &time, sizeof(time));
  }
}

void countInIds(std::vector<char>& bytes) {
  const std::size_t length = load<std::uint16_t>(bytes, 105);
  const auto count = load<std::uint64_t>(bytes, 247);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = load<std::uint32_t>(bytes, 96) + i * length + 20;
    const auto id = static_cast<std::uint16_t>(1 + i % 65535);
    std::memcpy(bytes.data() + at, &id, sizeof(id));
  }
}

/// Sets the class of every record, of any point format.
void setClasses(std::vector<char>& bytes, int code) {
  const bool old = (bytes[104] & 0x3f) < 6;
  const std::size_t length = load<std::uint16_t>(bytes, 105), at = old ? 15 : 16;
  const std::uint64_t count =
      old ? load<std::uint32_t>(bytes, 107) : load<std::uint64_t>(bytes, 247);
  for (std::size_t i = 0; i < count; ++i)
    bytes[load<std::uint32_t>(bytes, 96) + i * length + at] = static_cast<char>(code);
}

/// Puts the records of another file behind those there are; its scale and offset must be the same.
void append(std::vector<char>& bytes, const std::vector<char>& other) {
  const std::size_t length = load<std::uint16_t>(bytes, 105);
  const auto mine = load<std::uint64_t>(bytes, 247), theirs = load<std::uint64_t>(other, 247);
  const auto first = other.begin() + load<std::uint32_t>(other, 96);
  bytes.resize(load<std::uint32_t>(bytes, 96) + mine * length);
  bytes.insert(bytes.end(), first, first + static_cast<std::ptrdiff_t>(theirs * length));
  const std::uint64_t all = mine + theirs;
  std::memcpy(bytes.data() + 247, &all, sizeof(all));
}

void cropNorthings(std::vector<char>& bytes, double from, double to) {
  const std::size_t length = load<std::uint16_t>(bytes, 105);
  const auto count = load<std::uint32_t>(bytes, 107);
  const auto first = bytes.begin() + load<std::uint32_t>(bytes, 96);
  const double scale = load<double>(bytes, 139), offset = load<double>(bytes, 163);
  auto end = first;
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto record = first + static_cast<std::ptrdiff_t>(i * length);
    std::int32_t y = 0;
    std::memcpy(&y, &*record + 4, sizeof(y));
    const double northing = y * scale + offset;
    if (northing < from || northing >= to) continue;
    end = std::copy_n(record, length, end);
    ++kept;
  }
  bytes.erase(end, bytes.end());
  std::memcpy(bytes.data() + 107, &kept, sizeof(kept));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 2) return EXIT_FAILURE;
  std::vector<char> bytes = readAll(words[0]);
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (words[i] == "set" && i + 2 < words.size() && kFields.count(words[i + 1]) != 0) {
      set(bytes, kFields.at(words[i + 1]), words[i + 2]);
      i += 2;
    } else if (words[i] == "zero_times") {
      fillRecords(bytes, 22, 8, 0);
    } else if (words[i] == "some_times") {
      fillRecords(bytes, 22, 8, 0, 10);
    } else if (words[i] == "append" && i + 1 < words.size()) {
      append(bytes, readAll(words[++i]));
    } else if (words[i] == "whole_seconds") {
      cutTimes(bytes);
    } else if (words[i] == "pulse_ids") {
      countInIds(bytes);
    } else if (words[i] == "source_id" && i + 1 < words.size()) {
      fillRecords(bytes, 20, 2, std::stoi(words[++i]));
    } else if (words[i] == "crop_y" && i + 2 < words.size()) {
      cropNorthings(bytes, std::stod(words[i + 1]), std::stod(words[i + 2]));
      i += 2;
    } else if (words[i] == "class" && i + 1 < words.size()) {
      setClasses(bytes, std::stoi(words[++i]));
    } else if (words[i] == "keep" && i + 1 < words.size()) {
      bytes.resize(std::min<std::size_t>(bytes.size(), std::stoul(words[++i])));
    } else {
      std::cerr << "las_damage: unknown change " << words[i] << '\n';
      return EXIT_FAILURE;
    }
  }
  std::ofstream out(words[1], std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return out ? EXIT_SUCCESS : EXIT_FAILURE;
}
