// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "field_differences.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <pcl_als/adjustment/clustered_regression.h>

#include "group_differences.h"

namespace pcl_als {
namespace {

std::string nameOf(PointField field, int value) {
  if (field == PointField::scan_direction) return value < 0 ? "to_the_right" : "to_the_left";
  return (field == PointField::user_data ? "user_data" : "channel") + std::to_string(value);
}

std::string titleOf(PointField field, int value) {
  if (field == PointField::scan_direction)
    return value < 0 ? "points scanned to the right" : "points scanned to the left";
  return (field == PointField::user_data ? "points with user data " : "channel ") +
         std::to_string(value);
}

std::string remedyOf(PointField field) {
  switch (field) {
    case PointField::scanner_channel:
      return "divide strips by the scanner channel and calibrate the channels as systems of their "
             "own";
    case PointField::user_data:
      return "divide strips by the user data and calibrate these parts as systems of their own";
    default:
      return "check how the scan angles of both directions were derived (lag of the mirror, time "
             "tags of the encoder)";
  }
}

/// The equations of one value, each divided by its standard deviation, with the prior of the
/// differences as further observations.
ClusteredRegression equationsOf(int value, const std::vector<DifferenceUnknown>& unknowns,
                                const std::vector<std::vector<FieldPair>>& pairs,
                                std::size_t& clusters) {
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  ClusteredRegression regression(static_cast<int>(n));
  Eigen::VectorXd row(n);
  std::int64_t cluster = -1;
  for (const std::vector<FieldPair>& area : pairs) {
    int strip = -1;
    for (const FieldPair& pair : area) {
      if (pair.value != value) continue;
      if (pair.strip != strip) ++cluster;
      strip = pair.strip;
      const double std = std::sqrt(pair.variance);
      for (Eigen::Index i = 0; i < n; ++i) {
        const DifferenceUnknown& u = unknowns[static_cast<std::size_t>(i)];
        row[i] = pair.row[u.index] * u.slab / std;
      }
      regression.add(cluster, row, pair.distance / std);
    }
  }
  clusters = static_cast<std::size_t>(cluster + 1);
  for (Eigen::Index i = 0; i < n; ++i) regression.add(++cluster, Eigen::VectorXd::Unit(n, i), 0.0);
  return regression;
}

}  // namespace

std::vector<int> ComparedValues::all() const {
  std::vector<int> values{reference};
  values.insert(values.end(), others.begin(), others.end());
  return values;
}

ComparedValues comparedValues(PointField field, const std::map<int, std::size_t>& counts) {
  constexpr std::size_t kMost = 16;  // parts of one instrument
  constexpr double kLeastShare = 0.02;
  double total = 0.0;
  for (const auto& [value, count] : counts) total += static_cast<double>(count);
  ComparedValues found;
  found.field = field;
  std::size_t most = 0;
  for (const auto& [value, count] : counts) {
    if (static_cast<double>(count) < kLeastShare * total) continue;
    found.others.push_back(value);
    if (count <= most) continue;
    most = count;
    found.reference = value;
  }
  if (found.others.size() < 2 || found.others.size() > kMost) {
    found.others.clear();
    return found;
  }
  found.others.erase(std::find(found.others.begin(), found.others.end(), found.reference));
  return found;
}

void addFieldPairs(const ComparedValues& values, int strip, const AreaObservations& observations,
                   const SystemVector& biases, const ErrorSourceVector& sources,
                   std::vector<FieldPair>& pairs) {
  for (const PairObservation& o : observations) {
    if ((o.a == 0) == (o.b == 0)) continue;  // strip 0 has the reference value
    const bool point = o.a != 0;
    FieldPair pair;
    pair.strip = strip;
    pair.value = values.others[static_cast<std::size_t>(std::max(o.a, o.b) - 1)];
    pair.row = point ? o.row_a : SystemRow(-o.row_b);
    pair.distance = o.misclosure - o.row() * biases - o.sources * sources;
    pair.variance = o.variance * o.sharing;
    pairs.push_back(pair);
  }
}

std::vector<ErrorFinding> fieldDifferences(const ComparedValues& values,
                                           const std::vector<std::vector<FieldPair>>& pairs,
                                           const ScanGeometry& edge) {
  const std::vector<DifferenceUnknown> unknowns = differenceUnknowns(false);
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  std::vector<ErrorFinding> findings;
  for (const int value : values.others) {
    std::size_t used = 0;
    const ClusteredRegression::Result found = equationsOf(value, unknowns, pairs, used).solve(true);
    if (!found.determined || used < unknowns.size() + 1) continue;
    Eigen::VectorXd slab(n);
    std::vector<SpikeAndSlab::Prior> priors;
    for (Eigen::Index i = 0; i < n; ++i) {
      slab[i] = unknowns[static_cast<std::size_t>(i)].slab;
      priors.push_back({kDifferenceAbsent, 0.0, slab[i] * slab[i]});
    }
    const SpikeAndSlab mixture(priors, slab.cwiseProduct(found.estimate),
                               slab.asDiagonal() * found.covariance * slab.asDiagonal(),
                               {1.0, static_cast<double>(used) - static_cast<double>(n)});
    for (Eigen::Index i = 0; i < n; ++i) {
      const DifferenceUnknown& u = unknowns[static_cast<std::size_t>(i)];
      ErrorFinding finding = differenceFinding(u, mixture, i, edge);
      finding.source = nameOf(values.field, value) + "_" + u.name;
      finding.title = u.title + " of " + titleOf(values.field, value) + " against " +
                      titleOf(values.field, values.reference);
      finding.remedy = remedyOf(values.field);
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace pcl_als
