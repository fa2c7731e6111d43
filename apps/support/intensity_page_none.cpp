// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_page.h"

namespace pcl_als::app {

struct IntensityPage::State {};

IntensityPage::IntensityPage(const IntensityRun& /*run*/, bool /*wanted*/,
                             IntensityOutcome& /*outcome*/) {}
IntensityPage::~IntensityPage() = default;

bool IntensityPage::draws() {
  return false;
}

void IntensityPage::write(const CommandLine& /*line*/, const IntensityReport& /*report*/,
                          bool /*reliable*/) const {}

}  // namespace pcl_als::app
