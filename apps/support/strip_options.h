// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/survey/strip_assignment.h>

#include "command_line.h"

namespace pcl_als::app {

/// Adds -strips, -without and, where \a split, -split, which mean the same in every tool that takes
/// strips. -trajectory is declared before, where a tool has it.
void addStripOptions(CommandLine& line, bool split = true);
/// Adds -channels, which windowOf() and stripChoice() take into account.
void addChannelOption(CommandLine& line);
/// Whether any of them is given.
bool choosesStrips(const CommandLine& line);
/// Their values. UsageError for an option without a name, and for a name in both lists.
StripChoice stripChoice(const CommandLine& line);
}  // namespace pcl_als::app
