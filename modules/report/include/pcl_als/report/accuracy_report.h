// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/io/class_io.h>

namespace pcl_als {

class FieldTable;

/// The content of accuracy.json.
struct AccuracyReport {
  ConfusionMatrix matrix;
  AccuracyResult result;
  std::string compared_with;  ///< file of the other classification; empty: none
  std::optional<AccuracyResult> other;
  std::optional<AccuracyComparison> comparison;
  std::vector<std::string> inputs, remarks;
  std::vector<ExcludedPoints> excluded;  ///< points of strips that were excluded
};

/// The accuracy of a classification from a file of a confusion matrix or of check points, and its
/// comparison with another of the same kind (empty: none). InputError for files that cannot be read
/// or differ in kind, and for a matrix without check points.
AccuracyReport accuracyOfFiles(const std::string& input, const std::string& other);

/// The tables that the tools print.
std::string accuracyText(const AccuracyReport& report);
/// The text of accuracy.json.
std::string accuracyJson(const AccuracyReport& report);
/// The description of accuracy.json.
const FieldTable& accuracyFields();

ConfusionMatrix matrixOf(const CountTable& table);

/// Check points of one or two classifications with a common list of classes. Classes of check
/// points only, and points without a class, have a row of their own ("unclassified").
struct CountedSites {
  std::vector<std::string> classes;
  std::vector<CheckedPoint> points;
};
inline constexpr const char* kUnclassified = "unclassified";
CountedSites countSites(const std::vector<CheckedSite>& sites, std::vector<std::string> classes);

/// assessAccuracy() without remarks on the row of points without a class.
AccuracyResult assessSites(const CountedSites& sites);

/// The same check points in another classification, identified by their positions. InputError when
/// they are not the same points.
std::vector<CheckedSite> matchSites(const std::string& file, const std::vector<CheckedSite>& wanted,
                                    const std::vector<CheckedSite>& sites);

}  // namespace pcl_als
