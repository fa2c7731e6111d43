// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/simulation/scene.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

/// One return with its truth. Positions in metres, ground frame.
struct SimulatedPoint {
  Eigen::Vector3d position;  ///< as written: measurements, assumed parameters, written trajectory
  /// The same, with the same random errors, without biases and error sources.
  Eigen::Vector3d unbiased;
  Eigen::Vector3d surface;   ///< position on the surface: no noise, no bias
  double time = 0.0;         ///< GPS seconds of week
  float scan_angle = 0.0F;   ///< degrees from the vertical, right of flight positive (as LAS)
  float reflectance = 0.0F;  ///< truth, 0 … 1
  std::uint16_t intensity = 0;
  std::uint16_t strip = 0;
  std::uint8_t return_number = 1, number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS: 2 ground, 5 vegetation, 6 building, 11 road
  std::uint8_t flags = 0;           ///< PointFlag: scan direction, edge of flight line
  std::uint8_t channel = 0;         ///< of the scanner
};

/// A place of known land cover, ground frame.
struct LandCoverSite {
  double x = 0.0, y = 0.0;
  LandCover cover = LandCover::grass;
};

/** \brief Flies a block over a scene and computes the points as a survey would deliver them.
 *
 * Rays are traced exactly in the true geometry. Coordinates are then computed from the measured
 * range, encoder angle and trajectory (with noise) and the assumed system parameters by the full
 * chain of rotations of Habib et al. 2011, Eq. (1), see LidarSystem. No linearised equation is
 * used.
 *
 * \code
 * auto options = SimulationOptions::preset("small");
 * options.noise = NoiseOptions::named("range");
 * const Simulator simulator(options);
 * for (std::size_t i = 0; i < simulator.stripCount(); ++i)
 *   simulator.simulateStrip(i, threads, [&](const std::vector<SimulatedPoint>& points) { … });
 * \endcode
 */
class Simulator {
 public:
  using Sink = std::function<void(const std::vector<SimulatedPoint>& points)>;

  /// Builds the scene and simulates the flight. UsageError for impossible options.
  explicit Simulator(const SimulationOptions& options);
  ~Simulator();

  const SimulationOptions& options() const;
  const Scene& scene() const;
  std::size_t stripCount() const;
  std::uint64_t pulseCount(std::size_t strip) const;

  /// Points of one line in order of time, chunk by chunk, on the calling thread. Memory: a few
  /// chunks of 16384 pulses.
  void simulateStrip(std::size_t strip, int threads, const Sink& sink) const;
  std::vector<SimulatedPoint> strip(std::size_t strip, int threads = 0) const;

  /// All lines in order of time, with the GNSS/INS errors as delivered, or without.
  std::vector<TrajectorySample> trajectory() const;
  std::vector<TrajectorySample> trueTrajectory() const;

  /// Points on bare ground, clear of objects, where several strips overlap, then the targets.
  std::vector<ControlPoint> controlPoints() const;
  /// \a per_class places for each of tree, grass, soil and built_up, away from borders; \a set
  /// gives independent sets (0: training, 1: check).
  std::vector<LandCoverSite> landCoverSites(int per_class, int set) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace pcl_als::simulation
