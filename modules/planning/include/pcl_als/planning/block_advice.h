// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/calibration/parameter_choice.h>
#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/planning/observability.h>
#include <pcl_als/planning/synthetic_pairs.h>

namespace pcl_als {

/// What is needed to adjust a block as the calibration does.
struct ObservabilitySettings {
  std::vector<SystemParameter> estimate;  ///< empty: automatic, all that the data determine
  DeterminationLimits limits;
  SharedErrorModel shared_errors;
  SharedErrorLevels levels;  ///< of the shared errors, as found from the data
  /// For the pairs of lines that are not flown: noise and points per area. The surface is that of
  /// the block's own pairs unless \a planned is set.
  SyntheticPairs::Settings pairs;
  bool planned = false;
  /// Standard deviations as reported, internal units; where they exceed those of the block as it
  /// is given, all are enlarged by their ratio. Zero: none reported.
  SystemVector reported = SystemVector::Zero();
  bool advise = true;
  int threads = 0;
};

/// A line or control that is not there, and what it would do.
struct Advice {
  std::string what;  ///< "an opposite line at 540 m over line 3"
  bool is_line = true;
  StripGeometry line;                          ///< of a line
  std::vector<Eigen::Vector2d> control;        ///< places, of control
  SystemVector before = SystemVector::Zero();  ///< see AdjustedBlock::expected()
  SystemVector after = SystemVector::Zero();
  double benefit = 0.0;  ///< sum of ln(before / after) of AdjustedBlock::deviations()
  std::string text;      ///< what and what for, one line

  double duration() const { return is_line ? line.duration() : 0.0; }  ///< seconds
};

/// What a block determines, why not more, and what would help.
struct ObservabilityReport {
  std::string facts;
  std::vector<ParameterDirection> directions;  ///< weakest first
  std::vector<WeakCombination> weak;           ///< weakest first
  std::vector<Advice> advice;                  ///< best first; only what helps

  /// The line with the most benefit for its flying time; null when no line helps.
  const Advice* cheapestLine() const;
  /// The report line by line: directions known worse than a centimetre, the best six of the advice.
  std::vector<std::string> text() const;
};

/// A block adjusted with the shared errors of its strips eliminated.
class AdjustedBlock {
 public:
  /// \a block must outlive it.
  AdjustedBlock(const ObservedBlock& block, const ObservabilitySettings& settings);

  const Adjustment& adjustment() const { return adjustment_; }
  const ParameterChoice& choice() const { return choice_; }
  /// Standard deviations of what was tried, internal units, if each was known beforehand to twice
  /// its limit: never larger with more observations, whatever is left out as not determined.
  const SystemVector& deviations() const { return deviations_; }
  /// The same of what is determined; for others the value by the observations alone,
  /// infinite where they show nothing.
  SystemVector expected() const;
  /// What was tried; includes range_bias where no parameter was requested, with control or without.
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
 * Every piece of advice is a whole adjustment: the virtual strip with pairs to all strips it
 * overlaps, its own trajectory errors, and those of the flown strips as unknowns of both.
 */
ObservabilityReport describeObservability(const ObservedBlock& block,
                                          const ObservabilitySettings& settings);

/** \brief A calibrated block for describeObservability().
 *
 * Strips become straight lines from their first to their last pose; their height is the median of
 * their pairs' (sensor above patch), their swath what the pairs reach to. A strip left out has an
 * empty span and no pairs.
 */
ObservedBlock observedBlock(const AdjustedSurvey& survey, const Trajectory& trajectory);

/** \brief What a calibrated block determines, why not more, and what an added line or control would
 * change: the lines of CalibrationResult::observability.
 *
 * \param calibration after calibrate(), which returned \a result
 */
std::vector<std::string> describeObservability(const SystemCalibrationEngine& calibration,
                                               const CalibrationResult& result);

}  // namespace pcl_als
