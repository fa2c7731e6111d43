// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/flight_plan.h>

#include "adjustment.h"
#include "block_calibration.h"
#include "observability.h"
#include "parameter_choice.h"
#include "synthetic_pairs.h"

namespace pcl_als {

/// Settings of an adjustment of a block as by the calibration.
struct ObservabilitySettings {
  std::vector<SystemParameter> estimate;  ///< empty: automatic, all that the data determine
  DeterminationLimits limits;
  SharedErrorModel shared_errors;
  /// variance components of the shared errors, as estimated from the data
  VarianceFactors levels;
  /// For the pairs of virtual lines: noise and points per area. The surface is that of the block's
  /// own pairs unless \a planned is set.
  SyntheticPairs::Settings pairs;
  bool planned = false;
  /// Standard deviations of the calibration, internal units; where they exceed those of the
  /// adjusted block, all are enlarged by their ratio. Zero: not given.
  SystemVector reported = SystemVector::Zero();
  bool advise = true;
  int threads = 0;
};

/// A block adjusted with the shared errors of its strips eliminated.
class BlockAdjustment {
 public:
  /// \a block must exist as long as this object.
  BlockAdjustment(const ObservedBlock& block, const ObservabilitySettings& settings);

  const Adjustment& adjustment() const { return adjustment_; }
  const ParameterChoice& choice() const { return choice_; }
  /// Standard deviations of the considered parameters, internal units, each with a prior of twice
  /// its limit: they never increase with more observations, whatever is excluded as not determined.
  const SystemVector& deviations() const { return deviations_; }
  /// The same of parameters that are determined; for others the value from the observations alone,
  /// which is infinite where there is none.
  SystemVector expected() const;
  /// The considered parameters; includes range_bias where no parameter was requested, with or
  /// without control.
  const std::vector<SystemParameter>& wanted() const { return wanted_; }
  bool determines(SystemParameter p) const;

 private:
  SharedErrors errors_;
  Adjustment adjustment_;
  ParameterChoice choice_;
  std::vector<SystemParameter> wanted_;
  SystemVector deviations_, alone_;
};

/** \brief Directions, weak combinations and advice for a block.
 *
 * Each piece of advice is the result of a complete adjustment: the virtual strip has pairs with all
 * strips that it overlaps and its own trajectory errors; those of the flown strips are common
 * unknowns.
 */
ObservabilityReport describeObservability(const ObservedBlock& block,
                                          const ObservabilitySettings& settings);

/** \brief A calibrated block for describeObservability().
 *
 * Strips become straight lines from their first to their last pose; their height is the median of
 * their pairs (sensor above patch), their swath the largest angle of these. A strip that was left
 * out has an empty span and no pairs.
 */
ObservedBlock observedBlock(const AdjustedSurvey& survey, const Trajectory& trajectory);

/** \brief What a calibrated block determines, the causes of weak determination, and the effect of
 * additional lines or control: the lines of CalibrationResult::observability.
 */
std::vector<std::string> describeObservability(const SurveyBlock& calibrated,
                                               const BlockCalibration& calibration);

}  // namespace pcl_als
