// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::simulation {

/** \brief Errors beyond the eight system parameters, each with its sign: assumed - true.
 *
 * b is the angle of the mirror (radians, positive to the left of flight), r the range (metres).
 * d_b is added to the angle of the mirror and d_r to the range with which points are computed.
 */
enum class ErrorSource {
  time_offset,        ///< s: time tag of the points minus true time
  mirror_torsion,     ///< rad: d_b = +torsion in sweeps to the right (scan direction flag 1),
                      ///< -torsion in sweeps to the left; oscillating mirrors only
  encoder_quadratic,  ///< 1/rad: d_b = value b^2; scanners with a mirror angle
  encoder_cubic,      ///< 1/rad^2: d_b = value b^3; scanners with a mirror angle
  encoder_sine,       ///< rad: d_b = value sin(2 pi b / 10 degrees); scanners with a mirror angle
  deflection_scale,   ///< 1: angle from the axis times 1 + value; conical and rosette scanners
  range_scale,        ///< 1: d_r = value r
  range_walk,         ///< metres a decade: d_r = value log10(reference / intensity)
  range_incidence,    ///< 1: d_r = value r divergence tan(incidence), share of the stretched pulse
  offset_x,           ///< metres east: shift of trajectory and points (base station, datum)
  offset_y,           ///< metres north
  offset_z,           ///< metres up (geoid, antenna height)
  jump_x,             ///< metres east: shift of trajectory and points from the middle of a strip
  jump_y,             ///< metres north
  jump_z,             ///< metres up
};
inline constexpr int kErrorSourceCount = 15;

struct ErrorSourceInfo {
  ErrorSource source;
  std::string_view name;  ///< as in truth.json
  std::string_view unit;
  double internal_per_unit;
  double largest;  ///< in this unit
};
const std::array<ErrorSourceInfo, kErrorSourceCount>& errorSources();

/// Sums of the errors that concern a pulse, internal units (m, rad, s, 1).
struct ErrorValues {
  SystemVector system = SystemVector::Zero();
  std::array<double, kErrorSourceCount> sources{};

  double of(ErrorSource source) const { return sources[static_cast<std::size_t>(source)]; }
  Eigen::Vector3d offset() const {
    return {of(ErrorSource::offset_x), of(ErrorSource::offset_y), of(ErrorSource::offset_z)};
  }
  Eigen::Vector3d jump() const {
    return {of(ErrorSource::jump_x), of(ErrorSource::jump_y), of(ErrorSource::jump_z)};
  }
};

/// What an error concerns: everything, or one scanner channel (from 0), session or strip (from 1).
enum class ErrorScope { block, channel, session, strip };

/** \brief The error sources that are present.
 *
 * \code
 * ErrorSources errors;
 * errors.add("time_offset=1,session2:offset_z=0.08,channel1:boresight_roll=60,strip3:jump_z=0.1");
 * \endcode
 */
class ErrorSources {
 public:
  struct Entry {
    ErrorScope scope = ErrorScope::block;
    int number = 0;    ///< of the channel, session or strip
    std::string name;  ///< of an error source or system parameter
    std::string unit;
    double value = 0.0;     ///< in that unit
    double internal = 0.0;  ///< in internal units
    int index = 0;          ///< of the system parameter, or kSystemParameterCount and the source
    std::string scopeName() const;  ///< "block", "channel 1", …
  };

  /// Adds "[channelN:|sessionN:|stripN:]NAME=VALUE,…": an error source or, of a channel, session
  /// or strip, a system parameter, in the units of errorSources() and systemParameters().
  /// UsageError for an unknown name, a wrong number or a value out of range.
  void add(std::string_view list);

  /// The errors of the pulses of one channel in one strip of one session.
  ErrorValues of(int session, int strip, int channel) const;
  const std::vector<Entry>& entries() const { return entries_; }
  bool any(ErrorSource source) const;

 private:
  std::vector<Entry> entries_;
};

}  // namespace pcl_als::simulation
