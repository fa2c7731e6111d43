// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>

namespace pcl_als {

/// What a user should know of a result, in one line without names of options, and what a caller may
/// set about it.
struct Warning {
  std::string text;
  Hint hint = Hint::none;

  // Implicit, because most warnings are texts only.
  Warning(std::string what, Hint with = Hint::none) : text(std::move(what)), hint(with) {}
  Warning(const char* what, Hint with = Hint::none) : text(what), hint(with) {}
};
using Warnings = std::vector<Warning>;

/// The texts of warnings, in order.
inline std::vector<std::string> textsOf(const Warnings& warnings) {
  std::vector<std::string> texts;
  texts.reserve(warnings.size());
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace pcl_als
