// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>

#include <pcl_als/processing/intensity_input.h>

namespace pcl_als {

/// A PCD file, whose points are one window. \throw Error as of IntensityInput::open()
std::unique_ptr<IntensityInput> openIntensityPcd(const std::string& path,
                                                 const IntensityInput::Options& options);

}  // namespace pcl_als
