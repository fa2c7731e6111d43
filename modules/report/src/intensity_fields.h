// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/fields.h>
#include <pcl_als/report/intensity_report.h>

namespace pcl_als {

/// The part "report" of model.json.
const Fields<IntensityReport>& intensityEffectFields();

}  // namespace pcl_als
