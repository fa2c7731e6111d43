// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "scan_pattern.h"

#include <cmath>

namespace pcl_als::simulation {

namespace {

/// Rate of the second prism of a rosette over that of the first: no simple fraction, so that the
/// petals do not repeat.
constexpr double kPrismRatio = -0.6394;

double sweepRateOf(const PlannedLine& line, const ScannerOptions& scanner) {
  const double density = line.density / scanner.channels;
  if (scanner.type == ScannerType::conical) return line.speed * std::sqrt(density / (2.0 * kPi));
  return line.speed * std::sqrt(density);
}

}  // namespace

BeamAngles anglesOf(const Eigen::Vector3d& beam) {
  return {std::atan2(-beam.x(), -beam.z()), std::asin(beam.y())};
}

BeamAngles deflectedMore(const BeamAngles& beam, double factor) {
  const Eigen::Vector3d u = LidarSystem::laserDirection(beam);
  const double aside = std::hypot(u.x(), u.y());
  if (aside == 0.0) return beam;
  const double angle = factor * std::atan2(aside, -u.z());
  return anglesOf(
      {u.x() / aside * std::sin(angle), u.y() / aside * std::sin(angle), -std::cos(angle)});
}

ScanPattern::ScanPattern(const PlannedLine& line, const ScannerOptions& scanner)
    : scanner_(scanner),
      half_(0.5 * scanner.field_of_view),
      pulse_rate_(line.density * (2.0 * line.height * std::tan(half_)) * line.speed),
      sweep_rate_(sweepRateOf(line, scanner)),
      pulse_count_(
          static_cast<std::uint64_t>((line.end - line.start).norm() / line.speed * pulse_rate_)) {}

ScanPattern::Reading ScanPattern::at(std::uint64_t pulse) const {
  const auto channels = static_cast<std::uint64_t>(scanner_.channels);
  Reading reading{};
  reading.time = static_cast<double>(pulse) / pulse_rate_;
  reading.channel = static_cast<int>(pulse % channels);
  if (scanner_.hasMirrorAngle())
    readSweep(pulse, reading);
  else
    readRound(pulse, reading);
  return reading;
}

void ScanPattern::readSweep(std::uint64_t pulse, Reading& reading) const {
  const double phase = phaseOf(pulse), sweep = std::floor(phase), part = phase - sweep;
  const double angle = half_ * (1.0 - 2.0 * part);
  reading.to_right = scanner_.type != ScannerType::oscillating || std::fmod(sweep, 2.0) == 0.0;
  reading.beam.across = reading.to_right ? angle : -angle;
  reading.last =
      std::floor(phaseOf(pulse + static_cast<std::uint64_t>(scanner_.channels))) != sweep;
  if (scanner_.type != ScannerType::multi) return;
  reading.beam.along =
      scanner_.channel_angle * (2.0 * reading.channel / (scanner_.channels - 1.0) - 1.0);
  // The rest of the revolution is above the horizon or outside the field of view.
  reading.time = (sweep + part * half_ / kPi) / sweep_rate_;
}

Eigen::Vector3d ScanPattern::roundBeam(double phase) const {
  if (scanner_.type == ScannerType::conical) {
    const double turn = 2.0 * kPi * phase;
    return {std::sin(half_) * std::sin(turn), std::sin(half_) * std::cos(turn), -std::cos(half_)};
  }
  // First order in the deflection of a prism; the difference of both rates is that of the petals.
  const double first = 2.0 * kPi * phase / (1.0 - kPrismRatio), second = kPrismRatio * first;
  const double right = 0.5 * half_ * (std::sin(first) + std::sin(second));
  const double forward = 0.5 * half_ * (std::cos(first) + std::cos(second));
  const double angle = std::hypot(right, forward);
  const double share = angle > 0.0 ? std::sin(angle) / angle : 1.0;
  return {share * right, share * forward, -std::cos(angle)};
}

void ScanPattern::readRound(std::uint64_t pulse, Reading& reading) const {
  const Eigen::Vector3d beam = roundBeam(phaseOf(pulse));
  const double next = roundBeam(phaseOf(pulse + 1)).x();
  reading.beam = anglesOf(beam);
  reading.to_right = next > beam.x();
  reading.last = (roundBeam(phaseOf(pulse + 2)).x() > next) != reading.to_right;
}

}  // namespace pcl_als::simulation
