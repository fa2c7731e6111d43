// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

struct ScanGeometry;

/** \brief Gives a result its verdict from its iterations, parameters and misfit.
 *
 * Objections that other checks have added to result.verdict are kept. A usable result gets the
 * change of the misfit as its reason.
 * No improvement: the misfit is larger afterwards by more than twice the standard deviation of the
 * change and by more than a hundredth; or it is no smaller although the biases differ from zero
 * significantly (chi-squared of all estimated biases, 1 %). A system that was calibrated before has
 * biases that do not differ from zero and an unchanged misfit, which is usable.
 *
 * \param requested the parameters requested by name; empty: chosen automatically
 * \param not_converged why the iteration did not converge, in words; empty when it did
 */
void judgeCalibration(const std::vector<SystemParameter>& requested,
                      const std::string& not_converged, CalibrationResult& result);

/** \brief Names the estimates that tell nothing: within two standard deviations of zero, one of
 * which moves points at the edge of the swath by more than \a limit metres.
 *
 * They stay in the result, because parameters that are correlated with them are right only together
 * with them. Each gets a reason (ParameterEstimate::determined), and the verdict names them.
 */
void nameUndetermined(const ScanGeometry& edge, double limit, CalibrationResult& result);

/// Whether the estimated biases together differ from zero at a level of 1 %.
bool biasesAreSignificant(const CalibrationResult& result);

}  // namespace pcl_als
