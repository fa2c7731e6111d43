// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <pcl_als/las/las_record.h>

namespace pcl_als::detail {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "LAS is little-endian and read as it lies in memory");

inline std::uint8_t byteAt(const std::byte* at) {
  return std::to_integer<std::uint8_t>(*at);
}

/// A fixed-size text field, up to its first zero.
inline std::string textField(const std::byte* at, std::size_t size) {
  const char* text = reinterpret_cast<const char*>(at);
  return std::string(text, std::find(text, text + size, '\0'));
}

inline void putTextField(std::byte* at, std::size_t size, const std::string& text) {
  std::memcpy(at, text.data(), std::min(size, text.size()));
}

/// Appends the bytes of a number.
template <typename T>
void putNumber(std::vector<std::byte>& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  storeLas(bytes.data() + at, value);
}

}  // namespace pcl_als::detail
