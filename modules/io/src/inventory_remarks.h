// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/io/dataset_inventory.h>

namespace pcl_als::detail {

/// Adds what is suspicious about files, strips and the whole, in plain words.
void addRemarks(DatasetInventory& survey);

}  // namespace pcl_als::detail
