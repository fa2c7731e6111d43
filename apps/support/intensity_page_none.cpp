// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_page.h"

namespace pcl_als::app {

std::unique_ptr<IntensityPage> loadIntensityPage(const IntensityRun& /*run*/,
                                                 IntensityOutcome& /*outcome*/) {
  return nullptr;
}

}  // namespace pcl_als::app
