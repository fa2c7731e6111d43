// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

#include <pcl_als/common/calibration_result.h>

#include "block.h"
#include "block_estimate.h"
#include "jump_search.h"

namespace pcl_als {

// What is said of a block after its estimation: each function adds to the result, and none changes
// the estimate.

// Surfaces that are held fixed.

/// The fit of the held surfaces for some biases: \a after selects the values that are set.
void addHeldFit(const SurveyBlock& block, const PairSet& pairs, const SystemVector& biases,
                bool after, CalibrationResult& result);
/// The height of each held surface above the rest of the block, by an adjustment in which it is
/// unknown, with its judgement.
void checkHeldHeights(const SurveyBlock& block, const BlockSolution& solution,
                      CalibrationResult& result);
/// Lets observations be those of a block without held surfaces: these become control.
void replaceHeld(const BlockStrips& strips, std::vector<AreaObservations>& observations);

// The whole block.

/// One strip of each pass whose trajectory errors are estimated.
std::vector<JumpSearch::Strip> correctedPasses(const SurveyBlock& block);
/// The parameters that cannot be told from a height offset of the block.
void judgeBlockOffset(const BlockEstimate& estimate, CalibrationResult& result);
/// The model of the shared errors with the prior of the parameters that the solution has used.
SharedErrorModel errorModelOf(const SurveyBlock& block, const BlockSolution& solution);
/// The causes that concern parts of the block: jumps of the trajectory, differences between
/// sessions or channels, between points of one strip that differ in a field, and an error of the
/// scan angle as a function of it. Collective. Returns the place of a jump, if there is one.
std::optional<JumpSearch::Place> diagnoseParts(const AreaSample& sample,
                                               const BlockEstimate& estimate,
                                               CalibrationResult& result);
/// Constant differences between points of one strip that differ in their channel, user data or scan
/// direction. Collective.
void diagnoseFields(const AreaSample& sample, const BlockEstimate& estimate,
                    const ScanGeometry& edge, CalibrationResult& result);
/// Parameters that differ between halves of the block.
void assessParts(const SurveyBlock& block, const BlockEstimate& estimate,
                 CalibrationResult& result);
/// Strips that do not fit the others.
void diagnoseStrips(const SurveyBlock& block, CalibrationResult& result);

// Control.

/// The strips that cover a target that was not located there. Collective.
void warnOfTargets(const AreaSample& sample, CalibrationResult& result);
/// Residuals of control, and the parameters that depend on contradictory control.
void assessControl(const SurveyBlock& block, const BlockEstimate& estimate,
                   CalibrationResult& result);

}  // namespace pcl_als
