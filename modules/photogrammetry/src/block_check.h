// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/photogrammetry/image_block.h>

namespace pcl_als::photogrammetry {

/// InputError where the rays of most places on lines, by the approximate orientation of their
/// image, point elsewhere than to the lines of the control: other coordinate systems or units.
void checkDirections(const ImageBlock& block);

}  // namespace pcl_als::photogrammetry
