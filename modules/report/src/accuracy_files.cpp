// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/report/accuracy_report.h>

namespace pcl_als {
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

}  // namespace

AccuracyReport accuracyOfFiles(const std::string& input, const std::string& other) {
  const bool sites = holdsCheckedSites(input);
  if (!other.empty() && holdsCheckedSites(other) != sites)
    throw InputError(other + ": is not of the same kind (matrix or check points) as " + input);
  AccuracyReport report = sites ? ofSites(input, other) : ofMatrices(input, other);
  report.inputs = {input};
  if (!other.empty()) report.inputs.push_back(other);
  report.compared_with = other;
  return report;
}

}  // namespace pcl_als
