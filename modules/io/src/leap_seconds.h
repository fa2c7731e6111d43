// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::detail {

/// Seconds by which UTC lags GPS time at a GPS time (IERS Bulletin C); 13 before 2006.
double leapSecondsAt(double gps_seconds);

}  // namespace pcl_als::detail
