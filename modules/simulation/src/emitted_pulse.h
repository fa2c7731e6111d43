// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <pcl_als/simulation/waveform_options.h>

namespace pcl_als::simulation {

/** \brief The emitted pulse as the receiver records it from a point target: power over time.
 *
 * The largest value is 1, at the time 0. A skewed pulse is a Gaussian convolved with an exponential
 * decay, with the third standardised moment of WaveformOptions; a pulse by samples is interpolated
 * by cubic polynomials (Catmull and Rom).
 */
class EmittedPulse {
 public:
  explicit EmittedPulse(const WaveformOptions& options);

  /// Power at a time, nanoseconds; zero outside [-before(), after()].
  double at(double time) const {
    const double place = (time - start_) / step_;
    if (!(place >= 0.0) || place >= static_cast<double>(table_.size() - 1)) return 0.0;
    const auto i = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(i);
    return table_[i] + share * (table_[i + 1] - table_[i]);
  }
  double before() const { return -start_; }
  double after() const { return start_ + step_ * static_cast<double>(table_.size() - 1); }
  /// Full width at half maximum, nanoseconds.
  double width() const { return trailing(0.5) - leading(0.5); }
  /// Times at which the edges have a share of the maximum, nanoseconds.
  double leading(double share) const;
  double trailing(double share) const;
  double area() const;  ///< integral over time, nanoseconds

 private:
  void normalise();

  std::vector<double> table_;
  double start_ = 0.0, step_ = 1.0;
};

}  // namespace pcl_als::simulation
