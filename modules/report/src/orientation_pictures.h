// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/processing/image_orientation.h>

namespace pcl_als {

/// Map of the block: perspective centres, points, control lines by use, and the differences at
/// check points as arrows, enlarged.
Canvas blockPicture(const ImageOrientationResult& result);
/// Residuals of all measurements over the format of the image, mm.
Canvas residualPicture(const ImageOrientationResult& result);
/// Standardised residuals: histogram.
Canvas standardisedPicture(const ImageOrientationResult& result);

}  // namespace pcl_als
