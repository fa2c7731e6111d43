// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/report/quality_page.h>

namespace pcl_als {

struct QualityPage::State {};

QualityPage::QualityPage(bool /*wanted*/) {}
QualityPage::~QualityPage() = default;

bool QualityPage::draws() {
  return false;
}

SurveyObserver QualityPage::observer() {
  return {};
}

void QualityPage::write(const ReportOrigin& /*origin*/, const QualityReport& /*report*/,
                        const std::vector<SurveyArea>& /*areas*/) const {}

}  // namespace pcl_als
