// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/processing/survey_reader.h>
#include <pcl_als/trajectory/scanner_detection.h>

namespace pcl_als {

struct StripScanner {
  std::string strip;
  DetectedScanner scanner;
};

/// Detects the scanner of every strip that \a choice names, in the order of the strips; reads all
/// points once. InputError where points and trajectory have no time in common.
std::vector<StripScanner> detectScanners(SurveyReader& survey, const StripChoice& choice,
                                         const SurveyReader::Flight& flight);

/// One line for each scanner, with the strips that it measured: "1, 2: oscillating".
std::vector<std::string> describe(const std::vector<StripScanner>& scanners);

}  // namespace pcl_als
