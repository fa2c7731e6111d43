// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/printable.h>
#include <pcl_als/io/class_io.h>

namespace pcl_als {
namespace {

constexpr std::size_t kLongestName = 100;

}  // namespace

std::string classNameFault(std::string_view name) {
  if (name.empty()) return "must name the class";
  if (name.size() > kLongestName) return "is longer than 100 bytes; a class needs a shorter name";
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t length = utf8Length(rest);
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
