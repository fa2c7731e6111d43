// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/processing/image_orientation.h>
#include <pcl_als/report/report_origin.h>

namespace pcl_als {

/// Writes the report of an image block into the folder of \a origin: report.html with pictures of
/// the block, residuals and check points, report.md, and tables as CSV. Without module
/// visualization (PCL_ALS_WITH_VTK=OFF) report.md with the text only.
void writeOrientationPage(const ReportOrigin& origin, const ImageOrientationResult& result);

}  // namespace pcl_als
