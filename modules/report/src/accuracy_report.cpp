// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/report/accuracy_report.h>

#include "formatted.h"

namespace pcl_als {
namespace {

std::string fixed(double value, int digits) {
  return std::isfinite(value) ? formatted("%.*f", digits, value) : "-";
}

std::string shown(const std::string& name) {
  return name.size() > 14 ? name.substr(0, 13) + "~" : name;
}

std::string matrixText(const ConfusionMatrix& matrix) {
  std::string text = "Check points (rows: classified as, columns: reference)\n                ";
  for (const std::string& name : matrix.classes) text += formatted(" %14s", shown(name).c_str());
  text += "\n";
  for (Eigen::Index i = 0; i < matrix.counts.rows(); ++i) {
    text += formatted("  %-14s", shown(matrix.classes[static_cast<std::size_t>(i)]).c_str());
    for (Eigen::Index j = 0; j < matrix.counts.cols(); ++j)
      text += formatted(" %14lld", static_cast<long long>(matrix.counts(i, j)));
    text += "\n";
  }
  return text;
}

std::string probability(double p) {
  if (!std::isfinite(p)) return "not defined";
  return p < 1e-4 ? "< 0.0001" : fixed(p, 4);
}

std::string comparisonText(const AccuracyReport& report) {
  const AccuracyComparison& c = *report.comparison;
  std::string text = "\nAgainst " + report.compared_with + ": overall accuracy " +
                     fixed(100.0 * report.other->overall.value, 1) + " %, kappa " +
                     fixed(report.other->kappa, 3) + "\n";
  text += formatted("  overall accuracy %+.1f points, kappa %+.3f +- %s (z %s, p %s)\n",
                    100.0 * c.overall_difference, c.kappa_difference,
                    fixed(c.kappa_difference_std, 3).c_str(), fixed(c.kappa_z, 1).c_str(),
                    probability(c.kappa_p).c_str());
  if (c.same_points)
    text +=
        formatted("  McNemar: %lld points right only here, %lld only there, p %s\n",
                  static_cast<long long>(c.only_first_right),
                  static_cast<long long>(c.only_second_right), probability(c.mcnemar_p).c_str());
  return text;
}

int indexOf(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    names.push_back(name);
    return static_cast<int>(names.size()) - 1;
  }
  return static_cast<int>(found - names.begin());
}

/// Places to the millimetre, as they are written.
using Key = std::pair<long long, long long>;
Key keyOf(const CheckedSite& site) {
  return {std::llround(site.place.x() * 1e3), std::llround(site.place.y() * 1e3)};
}

}  // namespace

std::string accuracyText(const AccuracyReport& report) {
  const AccuracyResult& r = report.result;
  std::string text = matrixText(report.matrix);
  text += "\n  class             user's %  producer's %   kappa    +-\n";
  for (const ClassAccuracy& c : r.classes)
    text += formatted("  %-14s %11s %13s %7s %5s\n", shown(c.name).c_str(),
                      fixed(100.0 * c.users.value, 1).c_str(),
                      fixed(100.0 * c.producers.value, 1).c_str(), fixed(c.kappa, 3).c_str(),
                      fixed(c.kappa_std, 3).c_str());
  text += formatted(
      "\nOverall accuracy %.1f %% (95 %%: %.1f to %.1f) of %lld points, kappa %s +- %s\n",
      100.0 * r.overall.value, 100.0 * r.overall.low, 100.0 * r.overall.high,
      static_cast<long long>(r.points), fixed(r.kappa, 3).c_str(), fixed(r.kappa_std, 3).c_str());
  for (const std::string& remark : r.remarks) text += "  note: " + remark + "\n";
  for (const std::string& remark : report.remarks) text += "  note: " + remark + "\n";
  if (report.comparison) text += comparisonText(report);
  return text;
}

ConfusionMatrix matrixOf(const CountTable& table) {
  ConfusionMatrix matrix(table.classes);
  for (std::size_t i = 0; i < table.classes.size(); ++i)
    for (std::size_t j = 0; j < table.classes.size(); ++j)
      matrix.counts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          table.counts[i][j];
  return matrix;
}

CountedSites countSites(const std::vector<CheckedSite>& sites, std::vector<std::string> classes) {
  CountedSites counted{std::move(classes), {}};
  for (const CheckedSite& site : sites)
    counted.points.push_back(
        {indexOf(counted.classes, site.classified.empty() ? kUnclassified : site.classified),
         indexOf(counted.classes, site.reference)});
  return counted;
}

AccuracyResult assessSites(const CountedSites& sites) {
  AccuracyResult result = assessAccuracy(countPoints(sites.classes, sites.points));
  const auto about_none = [](const std::string& remark) {
    const std::string name = kUnclassified;
    return remark.size() >= name.size() &&
           remark.compare(remark.size() - name.size(), name.size(), name) == 0;
  };
  result.remarks.erase(std::remove_if(result.remarks.begin(), result.remarks.end(), about_none),
                       result.remarks.end());
  return result;
}

std::vector<CheckedSite> matchSites(const std::string& file, const std::vector<CheckedSite>& wanted,
                                    const std::vector<CheckedSite>& sites) {
  std::multimap<Key, const CheckedSite*> places;
  for (const CheckedSite& site : sites) places.emplace(keyOf(site), &site);
  std::vector<CheckedSite> matched;
  for (const CheckedSite& site : wanted) {
    const auto found = places.find(keyOf(site));
    if (found == places.end() || found->second->reference != site.reference)
      throw InputError(file + ": lacks the check point " + fixed(site.place.x(), 3) + ", " +
                       fixed(site.place.y(), 3) + " (" + site.reference +
                       "); both need the same points");
    matched.push_back(*found->second);
    places.erase(found);
  }
  if (!places.empty())
    throw InputError(file + ": has " + std::to_string(places.size()) +
                     " more check points; both need the same points");
  return matched;
}

}  // namespace pcl_als
