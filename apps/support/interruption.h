// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::app {

/// SIGINT, SIGTERM and SIGHUP remove unfinished output files before they end the process. A signal
/// that is ignored on purpose (nohup) or already handled is left as it is.
void removeUnfinishedFilesOnSignals();

}  // namespace pcl_als::app
