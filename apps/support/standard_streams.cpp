// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "standard_streams.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>

namespace pcl_als::app {
namespace {

constexpr int kUnusable = 2;            // exit status
std::array<char, 300> abort_message{};  // written by a signal handler: made before
std::size_t abort_message_length = 0;

void onAbort(int /*signal*/) {
  // What cannot be written cannot be reported either.
  if (write(STDERR_FILENO, abort_message.data(), abort_message_length) < 0) _exit(kUnusable);
  _exit(kUnusable);
}

}  // namespace

void openStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is taken, which is this one.
    if (open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY) < 0) return;
  }
}

void reportAborts(const char* tool) {
  const int length =
      std::snprintf(abort_message.data(), abort_message.size(),
                    "%s: stopped by a library it uses: not enough memory, or, for pictures, a "
                    "display without OpenGL\n",
                    tool);
  abort_message_length = length > 0 ? static_cast<std::size_t>(length) : 0;
  struct sigaction action {};
  action.sa_handler = onAbort;
  sigemptyset(&action.sa_mask);
  sigaction(SIGABRT, &action, nullptr);
}

bool flushStandardOutput(const char*& reason) {
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (flushed && std::cout.good()) return true;
  reason = errno != 0 ? std::strerror(errno) : "write error";
  return false;
}

}  // namespace pcl_als::app
