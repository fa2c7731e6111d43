// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/errors.h>

namespace pcl_als::test {

/// The texts of warnings, one a line.
inline std::string joinedTexts(const Warnings& warnings) {
  std::string texts;
  for (const Warning& warning : warnings) texts += warning.text + '\n';
  return texts;
}

/// Whether the warnings contain a text.
inline bool isWarnedOf(const Warnings& warnings, const std::string& text) {
  return joinedTexts(warnings).find(text) != std::string::npos;
}

}  // namespace pcl_als::test
