// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/common/time_resolution.h>

namespace pcl_als {

/// The ray of a pulse through two of its returns, on which the sensor was at that time.
struct PulseRay {
  double time = 0.0;                                ///< seconds
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  ///< metres, ground frame
  Eigen::Vector3f span = Eigen::Vector3f::UnitZ();  ///< from the lower to the upper return, m
  bool by_time = false;  ///< of returns without numbers that share a time
  double separation() const { return static_cast<double>(span.norm()); }
};

/// Sums over points of a short time whose recorded scan angles are in one class of three degrees.
struct ScanAngleSums {
  int index = 0;  ///< of the class: its middle over its width
  double n = 0.0, time = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, from PathEvidence::origin()
  Eigen::Vector2d plan_z = Eigen::Vector2d::Zero();    ///< east and north times the height, m^2
  double tangent = 0.0, tangent_z = 0.0;               ///< of the recorded angle; times the height
};

/** \brief What the points of a strip show of the path that they were measured from, in memory that
 * depends on the duration of the strip and not on its number of points.
 *
 * For every quarter of a second: the rays through first and last returns with the largest
 * separations (at most kRays), and sums over the points by classes of the recorded scan angle.
 * Neither depends on the order of the points; rays of pulses whose returns are far apart in a file
 * are a sample (PulsePairing). Where some returns have numbers, those without are pulses of their
 * own, even if they share a time. About 3 kB for a quarter of a second.
 */
class PathEvidence {
 public:
  static constexpr double kBin = 0.25;        ///< seconds
  static constexpr std::size_t kRays = 32;    ///< in a bin
  static constexpr double kClassWidth = 3.0;  ///< degrees

  PathEvidence();
  ~PathEvidence();
  PathEvidence(PathEvidence&&) noexcept;
  PathEvidence& operator=(PathEvidence&&) noexcept;

  /// Times that are zero or not finite, and points that are withheld or noise, are counted and not
  /// used.
  void add(const LidarReturn& point);
  /// To be called after the last point.
  void finish();
  /// Adds that of other points of the same flight; both finished.
  void merge(const PathEvidence& other);

  struct Bin {
    std::vector<PulseRay> rays;
    std::vector<ScanAngleSums> angles;  ///< in order of their index
    double first = 0.0, last = 0.0;     ///< times of its points, seconds
    double points = 0.0;
  };
  const std::map<std::int64_t, Bin>& bins() const { return bins_; }
  /// The times between gaps of more than \a gap seconds, in order.
  std::vector<TimeRange> passes(double gap) const;
  /// A place near the points, to which sums are relative; zero without points.
  const Eigen::Vector3d& origin() const { return origin_; }

  struct Counts {
    std::uint64_t points = 0, timeless = 0, excluded = 0;
    std::uint64_t rays = 0;      ///< pulses with two returns in use
    std::uint64_t multiple = 0;  ///< points of pulses with several returns
    std::uint64_t ambiguous = 0, duplicates = 0, by_time = 0;  ///< PulsePairing
    std::uint64_t angles = 0;        ///< points with a recorded angle that is not zero
    bool whole_degrees = true;       ///< all recorded angles are
    double first = 0.0, last = 0.0;  ///< times, seconds
    void merge(const Counts& other);
  };
  const Counts& counts() const { return counts_; }
  const TimeResolution& times() const { return times_; }

 private:
  class State;
  void dropRaysByTime();
  void addRay(const LidarReturn& lower, const LidarReturn& upper);
  void addAngle(Bin& bin, const LidarReturn& point);
  static ScanAngleSums& classOf(Bin& bin, int index);
  static void mergeAngles(Bin& bin, const ScanAngleSums& sums, const Eigen::Vector3d& shift);
  Bin& binOf(double time);

  std::map<std::int64_t, Bin> bins_;
  std::int64_t current_ = 0;
  Bin* current_bin_ = nullptr;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Counts counts_;
  TimeResolution times_;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
