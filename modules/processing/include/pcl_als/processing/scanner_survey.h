// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/processing/flight_file.h>
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

/// The same from files. Nothing is found where points or trajectory are unusable or do not belong
/// together; returns describe() of what is found, or the reason for which nothing is.
/// \param reading with an empty crs: that of the points
std::vector<std::string> detectScanners(const std::vector<std::string>& files,
                                        const PointWindow& window, const StripChoice& choice,
                                        const std::vector<std::filesystem::path>& trajectory,
                                        const TrajectoryReading& reading, int threads,
                                        std::vector<StripScanner>& found);

/// One line for each scanner, with the strips that it measured: "scanner of 1, 2: oscillating".
std::vector<std::string> describe(const std::vector<StripScanner>& scanners);

}  // namespace pcl_als
