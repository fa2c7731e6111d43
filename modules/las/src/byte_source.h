// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <pcl_als/las/laz_io.h>

namespace pcl_als::laz {

/// Compressed bytes that contradict themselves; the reader adds file and chunk to the message.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes [begin, end) of a file, read through a window of bounded size on demand.
class ByteSource {
 public:
  void open(const LazReadAt* read, std::uint64_t begin, std::uint64_t end) {
    read_ = read;
    loaded_ = begin;
    end_ = end;
    at_ = limit_ = nullptr;
  }

  std::uint8_t next() {
    if (at_ == limit_) refill();
    return *at_++;
  }
  void take(std::size_t bytes, void* out);
  std::uint32_t nextU32();

  /// Position in the file of the byte that next() returns.
  std::uint64_t position() const { return loaded_ - static_cast<std::uint64_t>(limit_ - at_); }
  std::uint64_t left() const { return end_ - position(); }

 private:
  void refill();

  const LazReadAt* read_ = nullptr;
  std::uint64_t loaded_ = 0;  ///< position behind the window
  std::uint64_t end_ = 0;
  const std::uint8_t* at_ = nullptr;
  const std::uint8_t* limit_ = nullptr;
  std::vector<std::uint8_t> window_;
};

}  // namespace pcl_als::laz
