// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/report/calibration_page.h>

namespace pcl_als {

struct CalibrationPage::State {};

CalibrationPage::CalibrationPage(bool /*wanted*/) {}
CalibrationPage::~CalibrationPage() = default;

bool CalibrationPage::draws() {
  return false;
}

SurveyObserver CalibrationPage::observer() {
  return {};
}

void CalibrationPage::write(const ReportOrigin& origin, const CalibrationResult& result,
                            const std::vector<SurveyArea>& /*areas*/,
                            const std::shared_ptr<const Trajectory>& /*trajectory*/) const {
  writeFile(origin.folder / "report.md", "# Calibration\n\n" + result.fullReport());
}

}  // namespace pcl_als
