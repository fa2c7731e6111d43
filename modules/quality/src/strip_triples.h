// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pcl_als::detail {

/// A pair as the side of a triangle: -1 where its strips are in the opposite order.
struct TripleSide {
  std::size_t pair = 0;
  double sign = 1.0;
};

/// Triples of strips that overlap in pairs, in order of first appearance.
struct StripTriple {
  std::string a, b, c;
  TripleSide ab, bc, ac;
};

/// \param pairs elements with names a and b; of equal pairs the last is used
template <typename Pair>
std::vector<StripTriple> stripTriples(const std::vector<Pair>& pairs) {
  std::map<std::string, std::size_t> number;
  std::vector<std::string> names;
  const auto numberOf = [&](const std::string& name) {
    const auto [place, added] = number.try_emplace(name, names.size());
    if (added) names.push_back(name);
    return place->second;
  };
  std::vector<std::map<std::size_t, TripleSide>> sides;  // by the lower number, then the higher
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t a = numberOf(pairs[i].a), b = numberOf(pairs[i].b);
    sides.resize(names.size());
    sides[std::min(a, b)][std::max(a, b)] = {i, a < b ? 1.0 : -1.0};
  }
  std::vector<StripTriple> triples;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (const auto& [j, ij] : sides[i])
      for (const auto& [k, jk] : sides[j]) {
        const auto ik = sides[i].find(k);
        if (ik != sides[i].end())
          triples.push_back({names[i], names[j], names[k], ij, jk, ik->second});
      }
  return triples;
}

}  // namespace pcl_als::detail
