// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

namespace pcl_als::detail {

/** \brief Names of the temporary files that removeUnfinishedFiles() removes.
 *
 * Slots are never freed, only reused, so that a signal handler can walk them at any moment without
 * a lock.
 */
struct TemporarySlot;

/// Enters a name (before the file is created, so that there is no moment without protection).
TemporarySlot* registerTemporary(const std::string& path);
void unregisterTemporary(TemporarySlot* slot);

}  // namespace pcl_als::detail
