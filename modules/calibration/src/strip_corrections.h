// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "area_matcher.h"
#include "block_calibration.h"

namespace pcl_als {

/// Corrections for the systems of a block, as the corrections of its strips.
class StripCorrections {
 public:
  StripCorrections(const SurveyBlock& block, const Corrections& corrections);
  StripCorrections(const StripCorrections&) = delete;
  StripCorrections& operator=(const StripCorrections&) = delete;

  const std::vector<AreaMatcher::StripCorrection>& strips() const { return strips_; }

 private:
  std::vector<BiasEvaluator> of_systems_;
  std::vector<AreaMatcher::StripCorrection> strips_;
};

}  // namespace pcl_als
