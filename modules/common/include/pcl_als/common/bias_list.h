// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string_view>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// Sets biases from "boresight_roll=-90,range_bias=0.1" in interface units (m, arcsec, 1); a
/// leading "none" sets all to zero first. UsageError for an unknown name or a value that is no
/// number.
void setBiases(std::string_view text, SystemVector& bias);

}  // namespace pcl_als
