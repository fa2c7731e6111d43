// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pcl_als::detail {

/// The whole text as a number, independent of the locale; "nan" and "inf" are numbers.
inline std::optional<double> parseNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

/// The whole text as an integer of type T.
template <typename T>
std::optional<T> parseInteger(std::string_view text) {
  T value = 0;
  const auto end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

inline std::optional<std::uint64_t> parseUnsigned(std::string_view text) {
  return parseInteger<std::uint64_t>(text);
}

}  // namespace pcl_als::detail
