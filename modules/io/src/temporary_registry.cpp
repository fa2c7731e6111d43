// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "temporary_registry.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <mutex>

#include <limits.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {

enum SlotState : int { kFree, kClaimed, kArmed };

struct TemporarySlot {
  std::atomic<int> state{kClaimed};
  pid_t owner = 0;  ///< a forked child must not remove the files of its parent
  std::array<char, PATH_MAX> path{};
  TemporarySlot* next = nullptr;
};

namespace {

std::atomic<TemporarySlot*> first_slot{nullptr};

// Only async-signal-safe calls: lock-free atomics, getpid, unlink, signal, raise.
extern "C" void removeTemporaries(int number) {
  const pid_t self = getpid();
  for (TemporarySlot* slot = first_slot.load(); slot != nullptr; slot = slot->next)
    if (slot->state.load() == kArmed && slot->owner == self) unlink(slot->path.data());
  std::signal(number, SIG_DFL);
  std::raise(number);
}

// A program's own handler, or a signal ignored on purpose (nohup), is left as it is.
void installHandlers() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    if (sigaction(number, nullptr, &current) != 0) continue;
    if ((current.sa_flags & SA_SIGINFO) != 0 || current.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = removeTemporaries;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

TemporarySlot* claimSlot() {
  for (TemporarySlot* slot = first_slot.load(); slot != nullptr; slot = slot->next) {
    int expected = kFree;
    if (slot->state.compare_exchange_strong(expected, kClaimed)) return slot;
  }
  auto* slot = new TemporarySlot;  // lives as long as the process: the handler may be reading it
  slot->next = first_slot.load();
  while (!first_slot.compare_exchange_weak(slot->next, slot)) {
  }
  return slot;
}

}  // namespace

TemporarySlot* registerTemporary(const std::string& path) {
  static std::once_flag once;
  std::call_once(once, installHandlers);
  if (path.size() + 1 > PATH_MAX) throw InputError(path + ": the path is too long");
  TemporarySlot* slot = claimSlot();
  slot->owner = getpid();
  std::memcpy(slot->path.data(), path.c_str(), path.size() + 1);
  slot->state.store(kArmed);
  return slot;
}

void forgetTemporary(TemporarySlot* slot) {
  if (slot != nullptr) slot->state.store(kFree);
}

}  // namespace pcl_als::detail
