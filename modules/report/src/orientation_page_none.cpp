// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/report/orientation_page.h>
#include <pcl_als/report/orientation_report.h>

namespace pcl_als {

void writeOrientationPage(const ReportOrigin& origin, const ImageOrientationResult& result) {
  writeFile(origin.folder / "report.md",
            "# Orientation of images\n\n```\n" + orientationText(result) + "```\n");
}

}  // namespace pcl_als
