// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// A prior from "boresight_roll=0:5,lever_arm_x=0.12:0.01": value and standard deviation in
/// interface units (m, arcsec, 1). UsageError for an unknown name, values that are no numbers, or a
/// standard deviation that is not positive.
BiasPrior biasPrior(std::string_view text);

/// Sets biases from "boresight_roll=-90,range_bias=0.1" in interface units (m, arcsec, 1); a
/// leading "none" sets all to zero first. UsageError for an unknown name or a value that is no
/// number.
void setBiases(std::string_view text, SystemVector& bias);

/// The biases of such a list, zero where it names none. UsageError also for a list without entries
/// and for a bias that no sensor has (refusedBias()).
SystemVector biasesIn(std::string_view text);

/// The parameter of that name; UsageError that lists all parameters for another name.
SystemParameter requireSystemParameter(const std::string& name);
/// The parameters of a list "boresight_roll,range_bias", each once. UsageError for an unknown name
/// and for a list without names.
std::vector<SystemParameter> systemParametersIn(const std::string& list);

}  // namespace pcl_als
