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

/// Accuracy of a classification, the content of accuracy.json.
struct AccuracyReport {
  ConfusionMatrix matrix;
  AccuracyResult result;
  std::string compared_with;  ///< file of a second classification; empty: none
  std::optional<AccuracyResult> other;
  std::optional<AccuracyComparison> comparison;
  std::vector<std::string> inputs, remarks;
  std::vector<ExcludedPoints> excluded;  ///< points of strips that were excluded
};

/// Computes the accuracy of a classification from a file with a confusion matrix or check points
/// (readCountTable(), readCheckedSites()), and its comparison with a second file of the same kind
/// (\a other; empty: none). InputError for files that cannot be read or differ in kind, and for a
/// matrix without check points.
AccuracyReport accuracyOfFiles(const std::string& input, const std::string& other);

/// The tables that the tools print.
std::string accuracyText(const AccuracyReport& report);
/// The text of accuracy.json.
std::string accuracyJson(const AccuracyReport& report);
/// The fields of accuracy.json with their meanings and units.
const FieldTable& accuracyFields();

/// The confusion matrix of a table.
ConfusionMatrix matrixOf(const CountTable& table);

/// Check points as indices into a list of classes, which contains all classes of the check points.
/// Points without a class have the class "unclassified".
struct CountedSites {
  std::vector<std::string> classes;
  std::vector<CheckedPoint> points;
};
inline constexpr const char* kUnclassified = "unclassified";
/// Converts check sites; classes that \a classes lacks are appended.
CountedSites countSites(const std::vector<CheckedSite>& sites, std::vector<std::string> classes);

/// assessAccuracy() without remarks on the class "unclassified".
AccuracyResult assessSites(const CountedSites& sites);

/// Sorts the check points \a sites of a second classification (\a file, for messages) into the
/// order of \a wanted, by their positions and reference classes. InputError if they are not the
/// same points.
std::vector<CheckedSite> matchSites(const std::string& file, const std::vector<CheckedSite>& wanted,
                                    const std::vector<CheckedSite>& sites);

}  // namespace pcl_als
