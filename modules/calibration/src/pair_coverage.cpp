// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_coverage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/number_text.h>

namespace pcl_als {
namespace {

constexpr double kScattered = 0.25;  // RMS of distances over their limit: of different objects

bool isCompared(const OverlappingPair& pair, double limit, const CalibrationResult& result) {
  const bool far = std::abs(pair.height.offset) > limit;
  return std::any_of(result.pairs.begin(), result.pairs.end(), [&](const PairFit& fit) {
    const bool same = (fit.a == pair.a && fit.b == pair.b) || (fit.a == pair.b && fit.b == pair.a);
    return same && fit.correspondences > 0 && !(far && fit.rms_before > kScattered * limit);
  });
}

/// The strips that compared pairs join, directly or over others.
class Parts {
 public:
  void join(const std::string& a, const std::string& b) {
    parent_[root(a)] = root(b);
    compared_.insert({a, b});
  }
  bool areJoined(const std::string& a, const std::string& b) { return root(a) == root(b); }
  bool hasPairs(const std::string& strip) const { return compared_.count(strip) > 0; }

 private:
  std::string root(const std::string& strip) {
    std::string& parent = parent_.emplace(strip, strip).first->second;
    if (parent != strip) parent = root(parent);
    return parent;
  }
  std::map<std::string, std::string> parent_;
  std::set<std::string> compared_;
};

using Pairs = std::vector<const OverlappingPair*>;

/// "1 of 6 overlapping pairs"
std::string share(const Pairs& some, std::size_t all) {
  return std::to_string(some.size()) + " of " + counted(all, "overlapping pair");
}

void judgeFarPairs(const Pairs& far, std::size_t all, Parts& parts, CalibrationResult& result) {
  if (far.empty()) return;
  std::vector<std::string> distances;
  bool divided = false;
  for (const OverlappingPair* pair : far) {
    distances.push_back(describe(pair->height, pair->a, pair->b));
    divided = divided || !parts.areJoined(pair->a, pair->b);
  }
  const std::string text = share(far, all) + (far.size() == 1 ? " lies" : " lie") +
                           " too far apart in height to be compared: " + listedNames(distances);
  result.warnings.push_back(
      {text + "; check the heights of these strips (unit, height reference, trajectory)",
       Hint::strips});
  if (divided) result.verdict.downgrade(CalibrationStatus::parameters_affected, text);
}

void judgePairsWithoutSurface(const Pairs& without, std::size_t all, const Parts& parts,
                              CalibrationResult& result) {
  if (without.empty()) return;
  std::vector<std::string> names;
  std::set<std::string> alone;
  for (const OverlappingPair* pair : without) {
    names.push_back(pair->a + " and " + pair->b);
    for (const std::string& strip : {pair->a, pair->b})
      if (!parts.hasPairs(strip)) alone.insert(strip);
  }
  for (const std::string& strip : alone)
    result.warnings.push_back({"strip " + strip +
                                   " has no pairs with any strip although it overlaps others: no "
                                   "smooth surface in common was found",
                               Hint::strips});
  std::string& reason = result.verdict.reason;
  reason += (reason.empty() ? "" : "; ") + share(without, all) +
            (without.size() == 1 ? " was" : " were") +
            " not compared, because no smooth surface in common was found: strips " +
            listedNames(names);
}

}  // namespace

void judgePairCoverage(const std::vector<OverlappingPair>& pairs, double limit,
                       CalibrationResult& result) {
  Parts parts;
  Pairs far, without;
  for (const OverlappingPair& pair : pairs) {
    if (isCompared(pair, limit, result))
      parts.join(pair.a, pair.b);
    else
      (std::abs(pair.height.offset) > limit ? far : without).push_back(&pair);
  }
  judgeFarPairs(far, pairs.size(), parts, result);
  judgePairsWithoutSurface(without, pairs.size(), parts, result);
}

}  // namespace pcl_als
