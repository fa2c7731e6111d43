// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/left_out.h>
#include <pcl_als/io/survey_census.h>
#include <pcl_als/io/trajectory_io.h>

namespace pcl_als {

/// The census as text; \a left_out: points that belong to none of its strips.
std::string censusText(const SurveyCensus& survey, const std::vector<LeftOutPoints>& left_out);

/// The census as JSON; its keys are those of the text, lengths in metres, times in seconds.
std::string censusJson(const SurveyCensus& survey, const std::vector<LeftOutPoints>& left_out);

/// The facts of a trajectory file as text: format, frame and datum, times, attitude against the
/// course, standard deviations.
std::string trajectoryText(const std::string& name, const TrajectoryFacts& facts);
/// The same of a file of accuracies, which is not empty.
std::string accuracyText(const std::string& name,
                         const std::vector<TrajectoryAccuracy>& accuracies);

/// Name of an ASPRS class; empty for a code without one.
std::string className(int code);

std::string timeKindName(TimeKind kind);

}  // namespace pcl_als
