// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/left_out.h>
#include <pcl_als/io/survey_census.h>

namespace pcl_als {

/// The census as text; \a left_out: points that belong to none of its strips.
std::string censusText(const SurveyCensus& survey, const std::vector<LeftOutPoints>& left_out);

/// The census as JSON; its keys are those of the text, lengths in metres, times in seconds.
std::string censusJson(const SurveyCensus& survey, const std::vector<LeftOutPoints>& left_out);

/// Name of an ASPRS class; empty for a code without one.
std::string className(int code);

std::string timeKindName(TimeKind kind);

}  // namespace pcl_als
