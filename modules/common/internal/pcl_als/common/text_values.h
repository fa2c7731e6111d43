// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl_als {

/// The whole text as a decimal number of type T, independent of the locale and without blanks; a
/// sign + is allowed for floating-point numbers, for which "nan" and "inf" are numbers.
template <typename T>
std::optional<T> valueIn(std::string_view text) {
  if constexpr (std::is_floating_point_v<T>) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  }
  T value{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

/// The text as a finite number.
std::optional<double> finiteNumber(std::string_view text);

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// "a, b,, c" → {"a", "b", "c"}: the parts between commas, without blanks and empty parts.
std::vector<std::string> splitList(std::string_view list);

/// {"a", "b"} → "a, b".
std::string joined(const std::vector<std::string>& names);

/// "NAME=VALUE" → {"NAME", "VALUE"}, divided at the last equals sign; nothing where the sign or the
/// name is missing.
std::optional<std::pair<std::string, std::string>> assignmentIn(const std::string& text);

/// The finite numbers of a text, separated by one character each; empty where it has another form.
std::vector<double> numbersIn(const std::string& text, char separator);

/// "A:B" → {"A", "B"}; UsageError for another form.
std::pair<std::string, std::string> pairIn(const std::string& text);

/// "A:B,C:D" → {{"A", "B"}, {"C", "D"}}; UsageError for another form and for a list without pairs.
std::vector<std::pair<std::string, std::string>> pairsIn(const std::string& list);

/// "strip1.las, strip2.las, strip3.las and 4 more": names of files without their folders.
std::string fileNames(const std::vector<std::string>& paths);

/// The values in [low, high] of a list "3=0.8,4=1.1" by names of strips. UsageError for another
/// form, for a strip that is given twice, and for a list without entries.
std::map<std::string, double> stripValuesIn(const std::string& list, double low, double high);

}  // namespace pcl_als
