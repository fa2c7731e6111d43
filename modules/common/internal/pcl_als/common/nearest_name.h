// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als {

/// Single-character edits (insert, delete, replace, swap of neighbours) that turn one word into
/// another.
std::size_t editDistance(const std::string& from, const std::string& to);

/// The one of \a names that \a word was probably meant to be: at most a third of its letters
/// differ. Empty where none is near, or two are equally near.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

}  // namespace pcl_als
