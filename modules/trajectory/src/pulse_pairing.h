// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include <pcl_als/common/lidar_return.h>

namespace pcl_als::detail {

/** \brief Finds first and last return of pulses in a stream of points.
 *
 * Consecutive points of one time are divided into pulses: returns with increasing numbers of one
 * channel and number of returns, of several candidates (channels that fire at one time) the nearest
 * in plan. Points without return numbers (1 of 1) that share a time are one pulse where one lies
 * below the other. First and last returns that are not consecutive (files sorted by place) are
 * matched by time while at most kMostOpen of them wait; beyond that a sample by time is kept, which
 * holds both returns of a pulse or none.
 */
class PulsePairing {
 public:
  static constexpr std::size_t kMostOpen = std::size_t{1} << 14U;
  /// The lower and the upper of two returns of one pulse.
  using Sink = std::function<void(const LidarReturn& lower, const LidarReturn& upper)>;

  void add(const LidarReturn& point, const Sink& sink);
  /// Ends the group of points of one time.
  void finish(const Sink& sink);

  std::uint64_t ambiguous() const { return ambiguous_; }  ///< returns with several candidates
  std::uint64_t duplicates() const { return duplicates_; }
  /// Pairs that were recognised by equal times alone, because returns have no numbers.
  std::uint64_t byTime() const { return by_time_; }

 private:
  struct Chain {
    LidarReturn first, last;
    std::size_t length = 1;
  };
  void place(const LidarReturn& point);
  Chain* chainFor(const LidarReturn& point);
  void emit(const LidarReturn& a, const LidarReturn& b, const Sink& sink);
  void wait(const LidarReturn& point, const Sink& sink);
  void thinOut();
  bool pairUnnumbered(const Sink& sink);

  std::vector<Chain> chains_;  ///< of the current time
  std::unordered_map<std::uint64_t, LidarReturn> open_;
  std::uint64_t sample_ = ~std::uint64_t{0};  ///< largest hash of a time that may wait
  std::uint64_t ambiguous_ = 0, duplicates_ = 0, by_time_ = 0;
};

}  // namespace pcl_als::detail
