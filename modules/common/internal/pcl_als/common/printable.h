// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcl_als {

/// Bytes of the UTF-8 character that begins a text, which is not empty; 0 where none does
/// (RFC 3629).
std::size_t utf8Length(std::string_view text);

/** \brief A text that may come from a file, fit for a message of one line on a terminal.
 *
 * Control characters (also those of ISO 6429 above ASCII) and bytes that are not UTF-8 become ?,
 * tabulators and ends of lines become blanks. What is longer than \a longest characters is cut and
 * ends in "...". Messages of errors pass through it whatever they quote (class Error).
 */
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Characters of a file that a message quotes.
inline constexpr std::size_t kLongestQuotation = 40;

}  // namespace pcl_als
