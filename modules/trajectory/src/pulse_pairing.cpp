// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_pairing.h"

#include <cmath>
#include <cstring>

namespace pcl_als::detail {
namespace {

constexpr double kLargestSlope = 2.0;       // tangent of a pulse's angle from the vertical
constexpr std::size_t kMostOfOneTime = 64;  // points of one time of which each is compared

/// A number that looks random, the same for all returns of a pulse (splitmix64).
std::uint64_t hashOf(const LidarReturn& point) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &point.time, sizeof bits);
  bits += 0x9e3779b97f4a7c15ULL * (1ULL + point.number_of_returns + 256ULL * point.channel);
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31U);
}

bool numbered(const LidarReturn& point) {
  return point.number_of_returns > 1 || point.return_number > 1;
}

double planDistance(const LidarReturn& a, const LidarReturn& b) {
  return (a.position - b.position).head<2>().squaredNorm();
}

}  // namespace

void PulsePairing::add(const LidarReturn& point, const Sink& sink) {
  if (!chains_.empty() && chains_.front().first.time != point.time) finish(sink);
  place(point);
}

/// The chain that the point continues: nearest in plan; of many points of one time, the last one.
PulsePairing::Chain* PulsePairing::chainFor(const LidarReturn& point) {
  Chain* best = nullptr;
  double nearest = 0.0;
  std::size_t candidates = 0;
  for (std::size_t i = chains_.size(); i-- > 0;) {
    Chain& chain = chains_[i];
    const bool fits = chain.last.channel == point.channel &&
                      chain.last.number_of_returns == point.number_of_returns &&
                      chain.last.return_number < point.return_number;
    if (!fits) continue;
    const double distance = planDistance(chain.last, point);
    ++candidates;
    if (best == nullptr || distance < nearest) {
      best = &chain;
      nearest = distance;
    }
    if (chains_.size() > kMostOfOneTime) break;
  }
  if (candidates > 1) ++ambiguous_;
  return best;
}

void PulsePairing::place(const LidarReturn& point) {
  if (chains_.size() <= kMostOfOneTime) {
    for (const Chain& chain : chains_) {
      if (chain.last.position == point.position &&
          chain.last.return_number == point.return_number) {
        ++duplicates_;
        return;
      }
    }
  }
  Chain* chain = numbered(point) ? chainFor(point) : nullptr;
  if (chain == nullptr) {
    chains_.push_back({point, point, 1});
    return;
  }
  chain->last = point;
  ++chain->length;
}

void PulsePairing::emit(const LidarReturn& a, const LidarReturn& b, const Sink& sink) {
  const bool a_lower = a.position.z() < b.position.z();
  const LidarReturn &lower = a_lower ? a : b, &upper = a_lower ? b : a;
  const double rise = upper.position.z() - lower.position.z();
  if (!(rise > 0.0) || planDistance(a, b) > kLargestSlope * kLargestSlope * rise * rise) return;
  sink(lower, upper);
}

/// Two or more returns of one time that have no numbers.
bool PulsePairing::pairUnnumbered(const Sink& sink) {
  if (chains_.size() < 2 || chains_.size() > kMostOfOneTime) return false;
  const Chain *lowest = &chains_.front(), *highest = lowest;
  for (const Chain& chain : chains_) {
    if (numbered(chain.first)) return false;
    if (chain.first.position.z() < lowest->first.position.z()) lowest = &chain;
    if (chain.first.position.z() > highest->first.position.z()) highest = &chain;
  }
  ++by_time_;
  emit(lowest->first, highest->first, sink);
  return true;
}

void PulsePairing::finish(const Sink& sink) {
  if (!pairUnnumbered(sink)) {
    for (const Chain& chain : chains_) {
      if (chain.length > 1) {
        emit(chain.first, chain.last, sink);
      } else if (numbered(chain.first)) {
        wait(chain.first, sink);
      }
    }
  }
  chains_.clear();
}

void PulsePairing::wait(const LidarReturn& point, const Sink& sink) {
  const bool first = point.return_number == 1, last = point.isLast();
  const std::uint64_t hash = hashOf(point);
  if (first == last || hash > sample_) return;
  const auto [known, added] = open_.try_emplace(hash, point);
  if (added) {
    if (open_.size() > kMostOpen) thinOut();
    return;
  }
  if (known->second.time != point.time || known->second.return_number == point.return_number)
    return;
  emit(known->second, point, sink);
  open_.erase(known);
}

void PulsePairing::thinOut() {
  sample_ /= 2;
  for (auto it = open_.begin(); it != open_.end();) {
    it = it->first > sample_ ? open_.erase(it) : std::next(it);
  }
}

}  // namespace pcl_als::detail
