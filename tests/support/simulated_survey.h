// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/simulation/simulator.h>

#include "block_calibration.h"

namespace pcl_als::test {

/// A simulated block as a user would get it: coordinates on whole millimetres, no truth.
struct SimulatedSurvey {
  std::vector<std::vector<LidarReturn>> strips;
  std::vector<TrajectorySample> trajectory;
  std::vector<ControlPoint> control;
  SystemVector bias;  ///< truth, internal units

  explicit SimulatedSurvey(const simulation::SimulationOptions& options) : bias(options.bias) {
    const simulation::Simulator simulator(options);
    trajectory = simulator.trajectory();
    control = simulator.controlPoints();
    for (std::size_t i = 0; i < simulator.stripCount(); ++i) {
      auto& points = strips.emplace_back();
      simulator.simulateStrip(i, 2, [&points](const std::vector<simulation::SimulatedPoint>& part) {
        for (const simulation::SimulatedPoint& p : part) points.push_back(pointOf(p));
      });
    }
  }

  static LidarReturn pointOf(const simulation::SimulatedPoint& p) {
    LidarReturn point;
    point.position = (p.position * 1000.0).array().round() / 1000.0;
    point.time = p.time;
    point.scan_angle = p.scan_angle;
    point.intensity = static_cast<float>(p.intensity);
    point.flags = p.flags;
    point.channel = p.channel;
    point.return_number = p.return_number;
    point.number_of_returns = p.number_of_returns;
    return point;
  }

  void move(const Eigen::Vector3d& shift) {
    for (auto& strip : strips) {
      for (LidarReturn& point : strip) point.position += shift;
    }
    for (TrajectorySample& sample : trajectory) sample.position += shift;
    for (ControlPoint& point : control) point.position += shift;
  }

  std::shared_ptr<const Trajectory> flight(bool rigorous) const {
    Trajectory::Options options;
    options.use_attitude = rigorous;
    return std::make_shared<const Trajectory>(trajectory, options);
  }

  /// What a calibration is given besides the points.
  struct Request {
    CalibrationSettings settings;
    std::vector<ControlPoint> control;
    bool rigorous = false;                                   ///< attitude of the trajectory
    std::vector<std::pair<std::string, std::string>> pairs;  ///< empty: all that overlap
  };

  /// South-west corner of all points.
  Eigen::Vector2d corner() const {
    Eigen::Vector2d corner = Eigen::Vector2d::Constant(1e18);
    for (const auto& strip : strips) {
      for (const LidarReturn& point : strip) corner = corner.cwiseMin(point.position.head<2>());
    }
    return corner;
  }

  /// The block of these strips, named "1", "2" …
  SurveyBlock block(const Request& request) const {
    BlockIndex index(flight(request.rigorous), corner());
    for (std::size_t i = 0; i < strips.size(); ++i)
      index.add(index.addStrip(std::to_string(i + 1)), strips[i].data(), strips[i].size());
    return chooseAreas(std::move(index), {request.settings, request.control, request.pairs});
  }

  BlockCalibration calibrate(const SurveyBlock& chosen) const {
    AreaSample sample(chosen);
    for (std::size_t i = 0; i < strips.size(); ++i)
      sample.add(static_cast<int>(i), strips[i].data(), strips[i].size());
    return pcl_als::calibrate(sample);
  }

  BlockCalibration calibrate(const Request& request) const { return calibrate(block(request)); }

  CalibrationResult calibrate(const CalibrationSettings& settings = CalibrationSettings(),
                              bool with_control = true, bool rigorous = false) const {
    Request request;
    request.settings = settings;
    request.rigorous = rigorous;
    if (with_control) request.control = control;
    return calibrate(request).result;
  }
};

}  // namespace pcl_als::test
