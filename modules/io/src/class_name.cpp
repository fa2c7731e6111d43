// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/io/class_io.h>

namespace pcl_als {
namespace {

constexpr std::size_t kLongestName = 100;

/// Bytes of the UTF-8 character that begins a text; 0 where none does (RFC 3629).
std::size_t characterLength(std::string_view text) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (at(0) < 0x80) return 1;
  const std::size_t length = at(0) >= 0xC2 && at(0) < 0xE0   ? 2
                             : at(0) >= 0xE0 && at(0) < 0xF0 ? 3
                             : at(0) >= 0xF0 && at(0) < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((at(i) & 0xC0U) != 0x80U) return 0;
  // Overlong forms, surrogates, beyond U+10FFFF.
  const bool wrong = (at(0) == 0xE0 && at(1) < 0xA0) || (at(0) == 0xED && at(1) > 0x9F) ||
                     (at(0) == 0xF0 && at(1) < 0x90) || (at(0) == 0xF4 && at(1) > 0x8F);
  return wrong ? 0 : length;
}

}  // namespace

std::string classNameFault(std::string_view name) {
  if (name.empty()) return "must name the class";
  if (name.size() > kLongestName) return "is longer than 100 bytes; a class needs a shorter name";
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t length = characterLength(rest);
    if (length == 0) return "is not UTF-8; save the file in that encoding";
    const auto first = static_cast<unsigned char>(rest.front());
    if (first < 0x20 || first == 0x7F) return "has a control character; rename the class";
    rest.remove_prefix(length);
  }
  if (name.find_first_of(",;\"") != std::string_view::npos)
    return "has a comma, semicolon or quote, which tables cannot keep; rename the class";
  return {};
}

}  // namespace pcl_als
