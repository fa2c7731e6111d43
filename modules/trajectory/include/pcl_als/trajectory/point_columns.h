// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als {

/// Points as columns: time in the time system of the trajectory, metres in the ground frame.
struct PointColumns {
  const double* time = nullptr;
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
};

}  // namespace pcl_als
