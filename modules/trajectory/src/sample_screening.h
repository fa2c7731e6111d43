// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/trajectory/trajectory_screening.h>

#include "sample_window.h"

namespace pcl_als::detail {

/// Speeds and residuals of most samples of a flight.
struct FlightScale {
  double speed = 0.0;        ///< metres per second
  double turn_rate = 0.0;    ///< radians per second, of any of the angles
  ChannelValues residual{};  ///< of a sample from the polynomial through its neighbours
  ChannelValues rounding{};  ///< step of rounded values; zero where none is found
};

/** \brief One screening: samples in order of time, divided at gaps into pieces. */
class SampleScreening {
 public:
  explicit SampleScreening(const std::vector<TrajectorySample>& samples);

  TrajectoryScreening result();

 private:
  /// Samples [first, last) without a gap between them, by rank in time.
  struct Piece {
    std::size_t first, last;
  };
  /// A hypothesis: samples [first, last] of a piece are wrong, with the good ones beside them.
  struct Hypothesis {
    std::size_t first, last;
    const Piece& piece;
  };

  const TrajectorySample& at(std::size_t rank) const { return samples_[indexOf(rank)]; }
  std::size_t indexOf(std::size_t rank) const { return order_.empty() ? rank : order_[rank]; }
  void sort();
  void divide();
  void findScale();
  void findRounding();
  void findBreaks();
  /// Deviations of a sample from the line through the samples beside it.
  ChannelValues bend(std::size_t rank, const Piece& piece) const;
  /// What an aircraft can move or turn within steps of such a duration and back.
  ChannelValues floors(double step, double speed) const;
  bool breaksAfter(std::size_t rank) const {
    return breaks_[rank] || (rank + 1 < breaks_.size() && breaks_[rank + 1]);
  }

  /// The good sample before or behind, or npos.
  std::size_t before(std::size_t rank, const Piece& piece) const;
  std::size_t behind(std::size_t rank, const Piece& piece) const;
  std::vector<const TrajectorySample*> anchors(const Hypothesis& h, std::size_t& count_before,
                                               std::size_t& count_behind) const;
  /// Whether the samples are wrong, with their deviations in \a run.
  bool isOutlier(const Hypothesis& h, OutlierRun& run) const;
  bool headingFollowsCourse(const Hypothesis& h, double turn) const;

  void searchPiece(const Piece& piece);
  bool tryRun(const Hypothesis& h);

  /// Two successive good samples with a large distance (m) or turn (rad) between them; zero: none.
  struct Step {
    std::size_t from, to;
    double distance, turn;
  };
  std::vector<Step> largeSteps(const Piece& piece) const;
  Eigen::Vector3d velocityBeside(std::size_t rank, bool earlier, const Piece& piece) const;
  bool returns(const Step& away, const Step& back, const Piece& piece, OutlierRun& run) const;
  void findLongRuns(const Piece& piece);
  void findJumps();

  const std::vector<TrajectorySample>& samples_;
  std::vector<std::uint32_t> order_;  ///< empty where the samples are in order of time
  std::vector<Piece> pieces_;
  std::vector<char> breaks_;  ///< by rank: whether the path or attitude bends there suddenly
  std::vector<char> excluded_;
  double gap_threshold_ = 0.0;
  FlightScale scale_;
  TrajectoryScreening screening_;
};

}  // namespace pcl_als::detail
