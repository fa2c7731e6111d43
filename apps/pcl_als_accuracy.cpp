// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/report/accuracy_report.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

ConfusionMatrix readMatrix(const std::string& path) {
  ConfusionMatrix matrix = matrixOf(readCountTable(path));
  if (matrix.total() == 0) throw InputError(path + ": counts no check points");
  return matrix;
}

AccuracyReport ofMatrices(const std::string& input, const std::string& other) {
  const ConfusionMatrix matrix = readMatrix(input);
  AccuracyReport report{matrix, assessAccuracy(matrix), {}, {}, {}, {}, {}, {}};
  if (other.empty()) return report;
  const ConfusionMatrix second = readMatrix(other);
  report.other = assessAccuracy(second);
  report.comparison = compareAccuracy(matrix, second);
  report.remarks.emplace_back(
      "matrices do not identify common check points: the kappas are compared as independent; "
      "compare "
      "lists of check points for McNemar's test");
  return report;
}

AccuracyReport ofSites(const std::string& input, const std::string& other) {
  const std::vector<CheckedSite> sites = readCheckedSites(input);
  CountedSites counted = countSites(sites, {});
  std::vector<CheckedPoint> second;
  if (!other.empty()) {
    CountedSites recounted =
        countSites(matchSites(other, sites, readCheckedSites(other)), counted.classes);
    counted.classes = recounted.classes;
    second = recounted.points;
  }
  AccuracyReport report{
      countPoints(counted.classes, counted.points), assessSites(counted), {}, {}, {}, {}, {}, {}};
  if (other.empty()) return report;
  report.other = assessSites({counted.classes, second});
  report.comparison = compareAccuracy(counted.classes, counted.points, second);
  return report;
}

int accuracy(int argc, char** argv) {
  CommandLine line("pcl_als_accuracy",
                   "computes the accuracy of a classification: overall, kappa, and by class",
                   "MATRIX.csv -output accuracy.json [-compare OTHER.csv]",
                   "pcl_als_accuracy corrected_checked.csv -compare raw_checked.csv -output "
                   "accuracy.json");
  line.addOptional("output", "accuracy figures as JSON (needed)");
  line.addOptional(
      "compare",
      "the other classification, of the same kind as the input: McNemar's test and the "
      "difference of the kappas");
  if (!line.parse(argc, argv)) return kDone;
  const std::string input = line.inputs(1, 1).front();
  if (!line.has("output")) throw UsageError("option -output is needed (see pcl_als_accuracy -h)");
  const std::string other = line.has("compare") ? line.text("compare") : "";
  const bool sites = holdsCheckedSites(input);
  if (!other.empty() && holdsCheckedSites(other) != sites)
    throw InputError(other + ": is not of the same kind (matrix or check points) as " + input);
  AccuracyReport report = sites ? ofSites(input, other) : ofMatrices(input, other);
  report.inputs = {input};
  if (!other.empty()) report.inputs.push_back(other);
  report.compared_with = other;
  if (!line.quiet()) std::cout << accuracyText(report);
  writeAccuracy(line.text("output"), report);
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_accuracy", [&] { return pcl_als::app::accuracy(argc, argv); });
}
