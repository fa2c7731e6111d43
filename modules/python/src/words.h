// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/errors.h>

namespace pcl_als::python {

/// A word that stands for a value.
template <typename T>
struct Word {
  const char* name;
  T value;
};

/// The value of a word; UsageError that lists the words for any other.
template <typename T, std::size_t N>
T valueOf(const Word<T> (&words)[N], const std::string& name, const char* what) {
  std::string all;
  for (const Word<T>& word : words) {
    if (name == word.name) return word.value;
    all += (all.empty() ? "'" : ", '") + std::string(word.name) + "'";
  }
  throw UsageError(std::string(what) + ": '" + name + "' is none of " + all);
}

template <typename T, std::size_t N>
const char* nameOf(const Word<T> (&words)[N], T value) {
  for (const Word<T>& word : words)
    if (word.value == value) return word.name;
  return "";
}

}  // namespace pcl_als::python
