// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "byte_source.h"

#include <algorithm>

namespace pcl_als::laz {
namespace {

constexpr std::uint64_t kWindow = std::uint64_t{1} << 16;

}  // namespace

void ByteSource::refill() {
  const std::uint64_t bytes = std::min(kWindow, end_ - loaded_);
  if (bytes == 0) throw Damage("the compressed data end too early");
  if (window_.size() < bytes) window_.resize(bytes);
  (*read_)(loaded_, bytes, window_.data());
  loaded_ += bytes;
  at_ = window_.data();
  limit_ = at_ + bytes;
}

void ByteSource::take(std::size_t bytes, void* out) {
  auto* to = static_cast<std::uint8_t*>(out);
  while (bytes > 0) {
    if (at_ == limit_) refill();
    const std::size_t part = std::min<std::size_t>(bytes, limit_ - at_);
    to = std::copy(at_, at_ + part, to);
    at_ += part;
    bytes -= part;
  }
}

std::uint32_t ByteSource::nextU32() {
  std::uint32_t value = 0;
  for (unsigned shift = 0; shift < 32; shift += 8) value |= std::uint32_t{next()} << shift;
  return value;
}

}  // namespace pcl_als::laz
