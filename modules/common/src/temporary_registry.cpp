// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "temporary_registry.h"

#include <array>
#include <atomic>
#include <cstring>

#include <limits.h>
#include <unistd.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace detail {

enum SlotState : int { kFree, kClaimed, kArmed };

struct TemporarySlot {
  std::atomic<int> state{kClaimed};
  pid_t owner = 0;  ///< a forked child must not remove the files of its parent
  std::array<char, PATH_MAX> path{};
  TemporarySlot* next = nullptr;
};

namespace {

std::atomic<TemporarySlot*> first_slot{nullptr};

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
  if (path.size() + 1 > PATH_MAX) throw InputError(path + ": the path is too long");
  TemporarySlot* slot = claimSlot();
  slot->owner = getpid();
  std::memcpy(slot->path.data(), path.c_str(), path.size() + 1);
  slot->state.store(kArmed);
  return slot;
}

void unregisterTemporary(TemporarySlot* slot) {
  if (slot != nullptr) slot->state.store(kFree);
}

}  // namespace detail

// Only async-signal-safe calls: lock-free atomics, getpid, unlink.
void removeUnfinishedFiles() noexcept {
  const pid_t self = getpid();
  for (detail::TemporarySlot* slot = detail::first_slot.load(); slot != nullptr; slot = slot->next)
    if (slot->state.load() == detail::kArmed && slot->owner == self) unlink(slot->path.data());
}

}  // namespace pcl_als
