// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/las/las_rewriter.h>

namespace pcl_als::test {

/// Leaves the records as they are.
inline const LasEdit kNothing = [](const LasRecordBlock&) {};

}  // namespace pcl_als::test
