// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
/** Observations of simulated pairs for the tests of the adjustment: rows of the sizes that real
 * ones have, two strips of 25 s, no geometry behind them. */
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "adjustment.h"

namespace pcl_als {

using P = SystemParameter;
inline const std::vector<P> kSix{P::lever_arm_x,    P::lever_arm_y,       P::boresight_pitch,
                                 P::boresight_roll, P::boresight_heading, P::scan_angle_scale};

inline SharedErrorModel model(double correlation_time = 30.0) {
  SharedErrorModel errors;
  errors.correlation_time = correlation_time;
  errors.knot_spacing = 10.0;
  errors.local = 1e-7;
  return errors;
}

/// Rows with the sizes that real ones have, two strips of 25 s, misclosures of given biases plus
/// noise.
inline std::vector<AreaObservations> simulated(const SystemVector& biases, double noise,
                                               unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas(20);
  for (AreaObservations& area : areas) {
    for (int i = 0; i < 50; ++i) {
      PairObservation o;
      o.a = i % 2, o.b = 1 - o.a;
      o.time_a = 25.0 * uniform(random), o.time_b = 100.0 + 25.0 * uniform(random);
      if (o.a == 1) std::swap(o.time_a, o.time_b);
      o.normal = Eigen::Vector3d(0.3 * normal(random), 0.3 * normal(random), 1.0).normalized();
      for (int p = 0; p < kSystemParameterCount; ++p) {
        const bool angle = p >= 3 && p <= 5;
        o.row_a[p] = static_cast<float>((angle || p == 7 ? 300.0 : 0.3) * normal(random));
        o.row_b[p] = static_cast<float>((angle || p == 7 ? 300.0 : 0.3) * normal(random));
      }
      o.row_a[indexOf(P::lever_arm_z)] = o.row_b[indexOf(P::lever_arm_z)] =
          static_cast<float>(o.normal.z());
      o.variance = 0.0004F;
      o.misclosure = o.row() * biases + noise * normal(random);
      area.push_back(o);
    }
  }
  return areas;
}

inline std::vector<std::vector<double>> unitWeights(const std::vector<AreaObservations>& areas) {
  std::vector<std::vector<double>> weights;
  for (const AreaObservations& area : areas) weights.emplace_back(area.size(), 1.0);
  return weights;
}

inline SystemVector someBiases() {
  SystemVector biases;
  biases << 0.03, -0.05, 0.0, -1.4e-4, 4.3e-4, 2e-5, 0.0, 1e-4;
  return biases;
}

}  // namespace pcl_als
