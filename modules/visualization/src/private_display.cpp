// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/private_display.h>

namespace pcl_als {
namespace {

constexpr int kStartMilliseconds = 30000;

const char* displayVariable() {
  const char* display = std::getenv("DISPLAY");
  return display == nullptr ? "" : display;
}

std::string findXvfb() {
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "/usr/bin" : path;
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t to = std::min(folders.find(':', from), folders.size());
    std::string file = folders.substr(from, to - from) + "/Xvfb";
    if (to > from && access(file.c_str(), X_OK) == 0) return file;
    from = to + 1;
  }
  throw InputError(
      "drawing needs an X display, and there is none: DISPLAY is not set to one that answers and "
      "Xvfb is not installed (Debian: apt-get install xvfb)");
}

/// Output of Xvfb: its display number and a new line. Empty when it ends or takes too long.
std::string readNumber(int descriptor) {
  std::string text;
  pollfd waiting{descriptor, POLLIN, 0};
  while (poll(&waiting, 1, kStartMilliseconds) > 0) {
    char c = 0;
    if (read(descriptor, &c, 1) != 1) return {};
    if (c == '\n') return text;
    text += c;
  }
  return {};
}

[[noreturn]] void becomeXvfb(const std::string& program, int write_end) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // A Ctrl-C at the terminal is for the tool, which then ends its server.
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing >= 0) {
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
  }
  const std::string number = std::to_string(write_end);
  execl(program.c_str(), "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24",
        "-nolisten", "tcp", "-noreset", static_cast<char*>(nullptr));
  _exit(127);
}

/// Mesa's software renderer ends the process where it gets no memory (LLVM 19, limit of 400 MB).
void requireAddressSpace() {
  constexpr rlim_t kNeeded = 1'000'000'000;  // bytes, with the libraries of the process
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur >= kNeeded) return;  // or unlimited
  throw InputError("drawing needs 1000 MB of addresses, and this process may use " +
                   std::to_string(limit.rlim_cur / 1'000'000) + " MB: raise the limit (ulimit -v)");
}

}  // namespace

std::shared_ptr<void> PrivateDisplay::connect(const std::string& name) {
  if (name.empty()) return nullptr;
  // VTK brings libX11 but ends the process where a display does not answer: ask before it does.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return nullptr;
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  const auto open_display = reinterpret_cast<Open>(dlsym(library, "XOpenDisplay"));
  const auto close_display = reinterpret_cast<Close>(dlsym(library, "XCloseDisplay"));
  if (open_display == nullptr || close_display == nullptr) return nullptr;
  void* display = open_display(name.c_str());
  if (display == nullptr) return nullptr;
  return {display, [close_display](void* connection) { close_display(connection); }};
}

std::shared_ptr<void> PrivateDisplay::connectToCurrent() {
  return connect(displayVariable());
}

PrivateDisplay::PrivateDisplay() {
  requireAddressSpace();  // before the libraries of a display take a part of it
  name_ = displayVariable();
  connection_ = connect(name_);
  if (connection_ == nullptr) start();
}

PrivateDisplay::~PrivateDisplay() {
  if (!isPrivate()) return;
  stop();
  unsetenv("DISPLAY");
}

void PrivateDisplay::start() {
  const std::string program = findXvfb();
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    throw InputError(std::string("cannot start Xvfb: ") + std::strerror(errno));
  }
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  server_ = fork();
  if (server_ == 0) becomeXvfb(program, ends[1]);
  close(ends[1]);
  const std::string number = server_ > 0 ? readNumber(ends[0]) : "";
  close(ends[0]);
  if (number.empty()) {
    stop();
    throw InputError(program + " does not start; run it in a terminal for its messages");
  }
  name_ = ":" + number;
  setenv("DISPLAY", name_.c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);  // leaves no files in the user's home
}

void PrivateDisplay::stop() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  for (int tries = 0; tries < 100; ++tries) {
    if (waitpid(server_, nullptr, WNOHANG) != 0) {
      server_ = 0;
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(server_, SIGKILL);
  waitpid(server_, nullptr, 0);
  server_ = 0;
}

}  // namespace pcl_als
