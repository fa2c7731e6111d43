// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "interruption.h"

#include <csignal>

#include <pcl_als/common/atomic_file.h>

namespace pcl_als::app {
namespace {

// Only async-signal-safe calls.
extern "C" void endBySignal(int number) {
  removeUnfinishedFiles();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

void removeUnfinishedFilesOnSignals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    if (sigaction(number, nullptr, &current) != 0) continue;
    if ((current.sa_flags & SA_SIGINFO) != 0 || current.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = endBySignal;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

}  // namespace pcl_als::app
