// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/report/trajectory_page.h>

namespace pcl_als {

struct TrajectoryPage::State {};

TrajectoryPage::TrajectoryPage(bool /*wanted*/) {}
TrajectoryPage::~TrajectoryPage() = default;

bool TrajectoryPage::draws() {
  return false;
}

SurveyObserver TrajectoryPage::observer() {
  return {};
}

void TrajectoryPage::write(const ReportOrigin& /*origin*/, const ReconstructedFlight& /*flight*/,
                           const std::vector<std::string>& /*files*/) const {}

}  // namespace pcl_als
