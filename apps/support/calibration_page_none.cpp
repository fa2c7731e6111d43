// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>

#include <pcl_als/io/atomic_file.h>

#include "calibration_page.h"
#include "calibration_tables.h"

namespace pcl_als::app {

struct CalibrationPage::State {};

CalibrationPage::CalibrationPage(const SurveyReader& /*survey*/, bool /*wanted*/) {}
CalibrationPage::~CalibrationPage() = default;

bool CalibrationPage::draws() {
  return false;
}

void CalibrationPage::add(int /*strip*/, const CalibrationPoint* /*points*/,
                          std::size_t /*count*/) {}

void CalibrationPage::write(const CommandLine& line, const CalibrationResult& result,
                            const std::vector<SurveyArea>& /*areas*/,
                            const std::shared_ptr<const Trajectory>& /*trajectory*/) const {
  writeFile(std::filesystem::path(line.text("report")) / "report.md",
            "# Calibration\n\n" + calibrationTables(result));
}

}  // namespace pcl_als::app
