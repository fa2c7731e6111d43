// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/communicator.h>
#include <pcl_als/processing/file_batch.h>

#include "command_line.h"

namespace pcl_als::app {

/// As run(), of a tool that shares its job among the processes that mpirun started, or that were
/// started with -process and -exchange, which it declares: the first one prints.
int runShared(int argc, const char* const* argv, CommandLine (*options)(),
              int (*job)(const CommandLine& line));
/// The processes of the job; null where there is one.
Communicator* processes();

/// Declares -resume.
void addResumeOption(CommandLine& line);
/// The files of a job are shared among processes(); with -resume, those of an earlier run are kept
/// if all options and files that they name are the same.
BatchOptions batchOptions(const CommandLine& line);

}  // namespace pcl_als::app
