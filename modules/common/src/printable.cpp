// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/printable.h>

namespace pcl_als {
namespace {

/// Whether a character, given by its bytes, controls a terminal.
bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  if (first < 0x20 || first == 0x7F) return true;
  // U+0080 to U+009F: terminals with eight bits take them for escape sequences.
  return character.size() == 2 && first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

}  // namespace

std::size_t utf8Length(std::string_view text) {
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

std::string printable(std::string_view text, std::size_t longest) {
  std::string shown;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == longest) return shown + "...";
    const std::size_t length = utf8Length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length > 0 && !isControl(character))
      shown += character;
    else
      shown += std::string_view("\t\n\r").find(text.front()) == std::string_view::npos ? '?' : ' ';
    text.remove_prefix(character.size());
  }
  return shown;
}

}  // namespace pcl_als
