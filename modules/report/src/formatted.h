// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace pcl_als {

/// The text that std::snprintf() makes of a pattern and values, at most 511 characters.
__attribute__((format(printf, 1, 2))) inline std::string formatted(const char* pattern, ...) {
  char line[512];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(line, sizeof line, pattern, values);
  va_end(values);
  return line;
}

}  // namespace pcl_als
