// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_run.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/simulation/radiometry.h>

namespace pcl_als::simulation {

namespace {

/// Share of an echo's spread in range that appears as timing noise.
constexpr double kSpreadNoise = 0.1;

/// Error of the refractive index in a session.
double refractionOf(const SimulationOptions& options, int session) {
  Random random(keyOf({options.seed, 0xA1F, static_cast<std::uint64_t>(session)}));
  return options.noise.refraction * random.normal();
}

}  // namespace

BeamAngles Channel::reported(const ScanPattern::Reading& reading) const {
  BeamAngles beam = reading.beam;
  const double deflection = error(ErrorSource::deflection_scale);
  if (deflection != 0.0) beam = deflectedMore(beam, 1.0 + deflection);
  const double b = beam.across, torsion = error(ErrorSource::mirror_torsion);
  beam.across +=
      (reading.to_right ? torsion : -torsion) +
      b * b * (error(ErrorSource::encoder_quadratic) + b * error(ErrorSource::encoder_cubic)) +
      error(ErrorSource::encoder_sine) * std::sin(36.0 * b);  // a period of 10 degrees
  return beam;
}

PulseRun::PulseRun(const SimulationOptions& options, double extinction, const FlownLine& line)
    : options_(options),
      extinction_(extinction),
      line_(line),
      refraction_(refractionOf(options, line.plan().session)) {
  for (int i = 0; i < options.scanner.channels; ++i)
    channels_.emplace_back(options, line.plan(), i);
}

Shot PulseRun::aim(const ScanPattern::Reading& reading) const {
  Shot shot{channels_[static_cast<std::size_t>(reading.channel)],
            line_.firstPulseTime() + reading.time};
  const Pose pose = line_.truePose(shot.time);
  const Eigen::Matrix3d rotation = groundFromBody(pose.roll, pose.pitch, pose.heading);
  shot.true_origin = shot.channel.true_system.firingPoint(pose.position, rotation);
  shot.true_direction = shot.channel.true_system.direction(rotation, reading.beam);
  return shot;
}

void PulseRun::report(const ScanPattern::Reading& reading, Random& random, Shot& shot) const {
  const Channel& channel = shot.channel;
  BeamAngles beam = reading.beam, assumed = channel.reported(reading);
  if (options_.noise.scan_angle > 0.0) {
    const double noise = options_.noise.scan_angle * random.normal();
    beam.across += noise;
    assumed.across += noise;
  }
  const Pose pose = poseAt(shot.time);
  const Eigen::Matrix3d rotation = groundFromBody(pose.roll, pose.pitch, pose.heading);
  shot.unbiased_origin = channel.true_system.firingPoint(pose.position, rotation);
  shot.unbiased_direction = channel.true_system.direction(rotation, beam);
  const double tag = shot.time + channel.error(ErrorSource::time_offset);
  const Pose written = tag == shot.time ? pose : poseAt(tag);
  const Eigen::Matrix3d turned =
      tag == shot.time ? rotation : groundFromBody(written.roll, written.pitch, written.heading);
  shot.assumed_origin =
      channel.assumed_system.firingPoint(written.position + line_.shiftAt(tag), turned);
  shot.assumed_direction = channel.assumed_system.direction(turned, assumed);
  shot.assumed_heading = written.heading;
}

SimulatedPoint PulseRun::startPoint(const ScanPattern::Reading& reading, const Shot& shot) const {
  const Eigen::Vector3d& beam = shot.assumed_direction;
  const double to_right =
      beam.x() * std::cos(shot.assumed_heading) - beam.y() * std::sin(shot.assumed_heading);
  SimulatedPoint point;
  point.time = shot.time + shot.channel.error(ErrorSource::time_offset);
  point.scan_angle = static_cast<float>(std::atan2(to_right, -beam.z()) / kRadiansPerDegree);
  point.strip = line_.plan().id;
  point.channel = static_cast<std::uint8_t>(reading.channel);
  point.flags = static_cast<std::uint8_t>((reading.to_right ? kScanDirection : 0) |
                                          (reading.last ? kEdgeOfFlightLine : 0));
  return point;
}

double PulseRun::numberOf(double signal, double range) const {
  return digitalNumber(options_.scanner.gain * line_.plan().gain, signal, range, extinction_,
                       options_.scanner.range_exponent);
}

double PulseRun::withDetectionError(double range, const Shot& shot, const Echo& echo,
                                    double intensity) const {
  const double stretch = echo.range * options_.scanner.divergence * echo.tangent;
  return range + shot.channel.error(ErrorSource::range_incidence) * stretch +
         shot.channel.error(ErrorSource::range_walk) *
             std::log10(options_.rangeWalkReference() / std::max(1.0, intensity));
}

void PulseRun::place(const Shot& shot, const Echo& echo, double measurement_error, double number,
                     SimulatedPoint& point) const {
  const Channel& channel = shot.channel;
  double measured = channel.true_system.measuredRange(echo.range) + refraction_ * echo.range;
  measured += measurement_error;
  point.intensity = static_cast<std::uint16_t>(std::clamp(std::round(number), 0.0, 65535.0));
  point.surface = options_.origin + shot.true_origin + echo.range * shot.true_direction;
  point.unbiased = options_.origin + shot.unbiased_origin +
                   channel.true_system.distance(measured) * shot.unbiased_direction;
  const double error = withDetectionError(channel.error(ErrorSource::range_scale) * echo.range,
                                          shot, echo, point.intensity);
  const double assumed = channel.assumed_system.distance(measured) + error;
  point.position = options_.origin + shot.assumed_origin + assumed * shot.assumed_direction;
  point.reflectance = static_cast<float>(echo.reflectance);
  point.classification = asprsClassOf(echo.cover);
}

void DiscreteRun::fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points) {
  const ScanPattern::Reading reading = run_.line().pattern().at(pulse);
  Shot shot = run_.aim(reading);
  const std::vector<Echo>& echoes = tracer_.trace(shot.true_origin, shot.true_direction);
  if (echoes.empty()) return;

  Random random = run_.randomOf(pulse);
  run_.report(reading, random, shot);
  SimulatedPoint point = run_.startPoint(reading, shot);
  point.number_of_returns = static_cast<std::uint8_t>(echoes.size());
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    point.return_number = static_cast<std::uint8_t>(i + 1);
    record(shot, echoes[i], random, point);
    points.push_back(point);
  }
}

void DiscreteRun::record(const Shot& shot, const Echo& echo, Random& random,
                         SimulatedPoint& point) const {
  const NoiseOptions& noise = run_.options().noise;
  double error = 0.0;
  if (noise.range > 0.0) {
    const double timing = noise.footprint ? kSpreadNoise * echo.spread : 0.0;
    error = std::hypot(noise.range, timing) * random.normal();
  }
  double number = run_.numberOf(echo.signal, echo.range);
  if (noise.intensity > 0.0) number *= 1.0 + noise.intensity * random.normal();
  run_.place(shot, echo, error, number, point);
}

}  // namespace pcl_als::simulation
