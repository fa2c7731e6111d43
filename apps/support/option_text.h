// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <deque>
#include <string>

#include "command_line.h"

namespace pcl_als::app {

/// "0.01 to 1000 m": the numbers that an option takes.
std::string rangeText(const Option& option);

/// What -h prints of options: parts with a title, in each the options that are needed before the
/// others. The text of an option begins two blanks or more after it or in the next line.
std::string optionHelp(const std::deque<Option>& options);

/** \brief What -list_options prints, for scripts and forms: a line for each positional argument and
 * option with name, role, need, default, unit, least and greatest number, and words (of a choice,
 * or the extensions of an output file, or the names of the files in a folder), and group, separated
 * by tabs.
 */
std::string optionTable(const CommandLine& line);

}  // namespace pcl_als::app
