// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als::app {

/** \brief The words of a command, with those of the files that `@FILE` names in their place.
 *
 * Such a file holds words separated by blanks and line ends; words with blanks stand in single or
 * double quotes, and `#` at the beginning of a word starts a comment that ends with the line. Words
 * that name files again are taken as they are. InputError for a file that cannot be read or is no
 * text, UsageError for a quote that is not closed.
 */
std::vector<std::string> withArgumentFiles(const std::vector<std::string>& words);

/// The arguments with the point files of each folder among them, sorted by name, in its place; a
/// folder without point files stays. InputError for a folder that cannot be read.
std::vector<std::string> withFilesOfFolders(const std::vector<std::string>& arguments);

}  // namespace pcl_als::app
