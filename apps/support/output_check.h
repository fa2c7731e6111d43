// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.h"

namespace pcl_als::app {

/// The files of a command: those that it reads and those that it writes.
struct CommandFiles {
  struct Input {
    std::string option;  ///< empty: a positional argument
    std::filesystem::path path;
  };
  struct Output {
    std::string option;  ///< empty: the positional argument
    std::filesystem::path path;
    std::vector<std::string> extensions;  ///< of a file
    bool is_folder = false;
    std::vector<std::string> files;  ///< in a folder: names, with * for any characters
  };
  std::vector<Input> inputs;
  std::vector<Output> outputs;
};
CommandFiles filesOf(const CommandLine& line);

/** \brief Refuses a command whose outputs would replace files that it must not replace, before it
 * reads one.
 *
 * UsageError where an output has an extension that the tool does not write, is an input (by any
 * path, symbolic or hard link) or another output, or where a file that is written into a folder
 * would replace one that the tools did not write there.
 */
void refuseLosses(const CommandFiles& files);

/// InputError where an output cannot be written.
void checkWritable(const CommandFiles& files);

}  // namespace pcl_als::app
