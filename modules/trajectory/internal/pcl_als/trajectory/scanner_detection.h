// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Pattern of the pulses of a laser scanner.
enum class ScannerPattern {
  undetermined,   ///< too few pulses
  oscillating,    ///< in a plane, in both directions
  polygon,        ///< in a plane, always in the same direction
  linear,         ///< in a plane; the order of the pulses is not that of time
  conical,        ///< on a cone about the vertical (Palmer scanner)
  rosette,        ///< over a disc, most of them at its centre and edge (Risley prisms)
  dual_look,      ///< two channels, recorded or not, in planes that look ahead and back
  crossed,        ///< the same, in planes that are turned about the vertical
  multi_channel,  ///< several channels, on cones about the flight direction
  irregular,      ///< none of these: more than two channels that are not recorded, or another
                  ///< flight's trajectory
};

std::string_view nameOf(ScannerPattern pattern);

struct DetectedScanner {
  ScannerPattern pattern = ScannerPattern::undetermined;
  int channels = 1;  ///< that are recorded
  /// Radians: conical: half the angle of the cone; rosette: from the axis to the edge; dual_look,
  /// crossed: half the angle between the planes; multi_channel: between the outermost beams.
  double angle = 0.0;

  /// "conical, 20.0 degrees from the vertical"
  std::string text() const;
};

/** \brief Finds the type of a scanner from the points of a strip and the trajectory.
 *
 * With attitude, the directions of the pulses in the body frame are known. Those of one channel
 * of a mirror or of a spinning scanner lie on a circular cone about some axis, that is, their unit
 * vectors in a plane: through the origin for a mirror (a cone of 90 degrees), at a distance cos(g)
 * from it for a cone of half angle g. Those of two channels that are not recorded lie in two
 * planes. Without attitude, planes and cones are those of AttitudeRecovery. A mirror that
 * oscillates moves in both directions, a polygon in one. The pulses of a rosette fill a disc.
 * Memory: as AttitudeRecovery, and 2 kB for each channel.
 */
class ScannerDetection {
 public:
  explicit ScannerDetection(std::shared_ptr<const Trajectory> flight);

  /// Points of one strip in the order of the file.
  void add(const LidarReturn& point);
  DetectedScanner assess() const;
  /// What scanPlanes() and the recognition of cones and rosettes need, for another process; get()
  /// replaces it.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);

  /// The fits of one channel.
  struct Channel {
    double pulses = 0.0, steps = 0.0, steps_to_right = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    /// Sums of products of xx yy zz xy xz yz, with attitude.
    Eigen::Matrix<double, 6, 6> quadratics = Eigen::Matrix<double, 6, 6>::Zero();
    std::array<double, 180> from_axis{};  ///< pulses by angle from the vertical, half degrees
    double last_time = 0.0, last_across = 0.0;
  };

  /// The channels by their number.
  const std::map<std::uint8_t, Channel>& channels() const { return channels_; }

 private:
  ScannerPattern patternOfOne(const Channel& channel, double& angle) const;

  std::shared_ptr<const Trajectory> flight_;
  std::size_t cursor_ = 0;
  std::map<std::uint8_t, Channel> channels_;
  std::optional<AttitudeRecovery> recovery_;  ///< without attitude
  std::uint64_t added_ = 0;
};

/** \brief The scan planes of a scanner whose channels, recorded or not, or strips have different
 * ones; empty where they have one in common or other pulses than in planes.
 *
 * The planes of channels and strips that differ by less than two degrees are taken as one.
 * \param strips with attitude; some hundred points of each channel suffice
 */
ScanPlanes scanPlanes(const std::vector<const ScannerDetection*>& strips);

}  // namespace pcl_als
