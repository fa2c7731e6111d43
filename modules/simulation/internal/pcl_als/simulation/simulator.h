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
#include <pcl_als/simulation/simulated_point.h>
#include <pcl_als/simulation/simulated_waveforms.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

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
  using WaveformSink = std::function<void(const SimulatedWaveforms& waveforms)>;

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

  /** \brief Points of one line with their waveforms, if options().waveform is set (UsageError
   * otherwise).
   *
   * The returns are those that the detector of discrete returns finds in the waveforms. A pulse
   * without any is excluded. Errors of the range that the detector makes (range walk, incidence)
   * are in the locations of the points, so that they do not move the waveform. The range noise of
   * NoiseOptions is one value for each pulse, the intensity noise is that of its energy.
   * \param truth with the backscatter of every pulse, which needs some 10 kB for each
   * Memory: a few chunks of 1024 pulses.
   */
  void simulateWaveforms(std::size_t strip, int threads, const WaveformSink& sink,
                         bool truth = false) const;

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
