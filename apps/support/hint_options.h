// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/errors.h>

#include "command_line.h"

namespace pcl_als::app {

/// The message of an error, with the option of the tool that serves its hint, if it has one.
std::string withHint(const CommandLine& line, const Error& error);

/// Adds the options of the tool to warnings that have a hint, for all outputs alike.
void nameOptions(const CommandLine& line, Warnings& warnings);

}  // namespace pcl_als::app
