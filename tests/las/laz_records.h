// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace pcl_als::test {

/// splitmix64: the same numbers on every machine.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(next() % n); }
  bool once(unsigned in) { return below(in) == 0; }

 private:
  std::uint64_t state_;
};

inline constexpr std::size_t kStandardLength[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

enum class PointKind {
  survey,    ///< like a flight line, with jumps of height and time
  random,    ///< every byte random
  constant,  ///< the same record again and again
  channels   ///< like a survey, of four scanner channels in turn and at random (formats 6 to 10)
};

/// Records of a point format that use every branch of the codec.
class LazRecords {
 public:
  LazRecords(int format, std::size_t extra, PointKind kind, std::uint64_t seed)
      : format_(format), length_(kStandardLength[format] + extra), kind_(kind), numbers_(seed) {}

  std::size_t length() const { return length_; }

  std::vector<std::uint8_t> make(std::size_t count) {
    std::vector<std::uint8_t> records(count * length_);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t* record = records.data() + i * length_;
      const bool again = kind_ == PointKind::constant && i > 0;
      if (again)
        std::memcpy(record, record - length_, length_);
      else if (kind_ == PointKind::random || kind_ == PointKind::constant)
        randomise(record);
      else
        survey(record, i);
    }
    return records;
  }

 private:
  template <typename T>
  static void put(std::uint8_t* at, T value) {
    std::memcpy(at, &value, sizeof value);
  }

  void randomise(std::uint8_t* record) {
    for (std::size_t k = 0; k < length_; ++k)
      record[k] = static_cast<std::uint8_t>(numbers_.next());
  }

  void move() {
    x_ += static_cast<int>(numbers_.below(40)) - 10;
    y_ += static_cast<int>(numbers_.below(20)) - 10;
    z_ += static_cast<int>(numbers_.below(9)) - 4;
    if (numbers_.once(50)) z_ += static_cast<int>(numbers_.below(3000));
    if (numbers_.once(300)) x_ -= 1 << 20U;
    // Doubles of this size are 2^-26 s apart: steps of some hundred units.
    std::uint64_t step = 700 + numbers_.below(3);
    if (numbers_.once(20)) step *= 1 + numbers_.below(700);
    if (numbers_.once(100)) step = 0 - 5 * step;
    if (numbers_.once(400)) step <<= 30U;
    if (!numbers_.once(3)) time_ += step;
    if (numbers_.once(500)) std::swap(time_, other_time_);
    if (numbers_.once(200)) source_ = static_cast<std::uint16_t>(numbers_.below(5));
  }

  void survey(std::uint8_t* record, std::size_t i) {
    move();
    put(record, x_);
    put(record + 4, y_);
    put(record + 8, z_);
    put(record + 12, static_cast<std::uint16_t>(numbers_.below(200)));
    if (format_ < 6)
      legacy(record, i);
    else
      extended(record, i);
    const std::size_t begin = format_ < 6 ? (hasTime() ? 28 : 20) : 30;
    for (std::size_t k = begin; k < length_; ++k) {
      if (numbers_.once(4)) last_[k] = static_cast<std::uint8_t>(numbers_.below(40));
      record[k] = last_[k];
    }
    if (numbers_.once(5) && begin + 6 <= kStandardLength[format_]) {  // grey
      std::memcpy(record + begin + 2, record + begin, 2);
      std::memcpy(record + begin + 4, record + begin, 2);
    }
  }

  bool hasTime() const { return format_ == 1 || (format_ >= 3 && format_ < 6); }

  void legacy(std::uint8_t* record, std::size_t i) {
    const unsigned returns = 1 + numbers_.below(numbers_.once(10) ? 7 : 3);
    const unsigned number = numbers_.once(50) ? 0 : 1 + numbers_.below(returns);
    record[14] = static_cast<std::uint8_t>(number | returns << 3U | (i / 100 % 2) << 6U |
                                           (numbers_.once(50) ? 128U : 0U));
    record[15] = numbers_.once(10) ? 2 : 1;
    record[16] = static_cast<std::uint8_t>(i / 30 % 60 - 30);
    record[17] = numbers_.once(100) ? static_cast<std::uint8_t>(numbers_.next()) : 0;
    put(record + 18, source_);
    if (hasTime()) put(record + 20, time_);
  }

  void extended(std::uint8_t* record, std::size_t i) {
    const unsigned returns = 1 + numbers_.below(numbers_.once(10) ? 15 : 3);
    const unsigned number = numbers_.once(50) ? 0 : 1 + numbers_.below(returns);
    unsigned channel = 1;
    if (kind_ == PointKind::channels)
      channel = (numbers_.once(5) ? numbers_.below(4) : static_cast<unsigned>(i / 20)) % 4;
    record[14] = static_cast<std::uint8_t>(number | returns << 4U);
    record[15] = static_cast<std::uint8_t>((numbers_.once(30) ? 1U : 0U) | channel << 4U |
                                           (i / 100 % 2) << 6U);
    record[16] = static_cast<std::uint8_t>(numbers_.once(10) ? 2 : numbers_.below(40));
    record[17] = numbers_.once(100) ? static_cast<std::uint8_t>(numbers_.next()) : 0;
    put(record + 18, static_cast<std::int16_t>(static_cast<int>(i / 10 % 6000) - 3000));
    put(record + 20, source_);
    put(record + 22, time_);
  }

  int format_;
  std::size_t length_;
  PointKind kind_;
  Numbers numbers_;
  std::int32_t x_ = 1000000, y_ = -2000000, z_ = 50000;
  std::uint64_t time_ = 0x41A0000000000000ULL, other_time_ = 0x41B0000000000000ULL;
  std::uint16_t source_ = 1;
  std::uint8_t last_[512] = {};
};

}  // namespace pcl_als::test
