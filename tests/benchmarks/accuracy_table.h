// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>

#include "fisher_bound.h"

namespace pcl_als::bench {

/// Errors of calibrated parameters against their standard deviations, over many blocks; printed as
/// Markdown rows in interface units. lever_arm_z, which is never estimated, has no column.
class AccuracyTable {
 public:
  static void printHeader();
  /// The errors of one block, each with its standard deviation; adds them to the sums.
  void printRow(const std::string& name, const CalibrationResult& result, const SystemVector& truth,
                const std::string& rest);
  void addBound(const FisherBound& bound);
  void printTotals() const;

 private:
  void add(const ParameterEstimate& estimate, int parameter, double truth);
  static void printValues(const std::string& name, const SystemVector& values, bool in_units);

  SystemVector count_ = SystemVector::Zero(), squares_ = SystemVector::Zero(),
               largest_ = SystemVector::Zero(), variances_ = SystemVector::Zero(),
               standardised_ = SystemVector::Zero(), inside_68_ = SystemVector::Zero(),
               inside_95_ = SystemVector::Zero();
  SystemVector independent_ = SystemVector::Zero(), shared_ = SystemVector::Zero();
};

}  // namespace pcl_als::bench
