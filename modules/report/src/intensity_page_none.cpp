// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/report/intensity_page.h>

namespace pcl_als {

std::unique_ptr<IntensityPage> makeIntensityPage() {
  return nullptr;
}

}  // namespace pcl_als
