// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <pcl_als/waveform/pulse_response.h>
#include <pcl_als/waveform/waveform_decomposer.h>

namespace pcl_als::detail {

/// Parameters: the baseline, then amplitude, time and width of each echo.
inline constexpr int kMostParameters = 1 + 3 * kMostEchoes;

struct EchoParameters {
  double amplitude = 0.0, time = 0.0, width = 0.0;
  bool free_width = true;
  double width_prior =
      0.0;  ///< standard deviation of the width about that of the response; 0: none
};

struct EchoModel {
  int count = 0;
  double baseline = 0.0;
  std::array<EchoParameters, kMostEchoes> echo;

  int freeWidths() const {
    int n = 0;
    for (int j = 0; j < count; ++j) n += echo[static_cast<std::size_t>(j)].free_width ? 1 : 0;
    return n;
  }
  int parameters() const { return 1 + 2 * count + freeWidths(); }
};

/// Result of an adjustment.
struct FitResult {
  double sum = 0.0;  ///< of squared residuals
  int used = 0;      ///< samples with a residual
  int iterations = 0;
  bool converged = false;
};

/** \brief Adjusts a model to the samples of a waveform (Levenberg-Marquardt).
 *
 * Saturated samples count as residuals only if the model is below them, clipped ones only if it is
 * above. Allocates only if a waveform has more samples than any before.
 */
class EchoFit {
 public:
  explicit EchoFit(const PulseResponse& response) : response_(response) {}

  /// \param bound per sample: 0 measured, 1 saturated, -1 clipped; null if all are measured
  void setSamples(const double* counts, const signed char* bound, int samples);

  /// Adjusts the model; the normal equations and residuals are those of the result. \a noise is the
  /// standard deviation of a sample by which priors of widths are weighted.
  FitResult fit(EchoModel& model, double noise = 0.0);

  /// Samples minus model; zero for samples that are not used.
  const double* residuals() const { return residual_.data(); }
  /// Inverse of the normal matrix: cofactors of all parameters that were adjusted.
  /// \return false if it is singular
  bool invert();
  double cofactor(int a, int b) const { return inverse_[static_cast<std::size_t>(a * size_ + b)]; }
  /// Number of a parameter in the normal equations: of echo j its amplitude, time, width (0, 1, 2).
  int index(int echo, int part) const { return first_[static_cast<std::size_t>(echo)] + part; }
  int size() const { return size_; }

  /// Derivatives of the model by a parameter of an echo (0, 1, 2), at the samples of its range.
  const double* column(int echo, int part) const {
    return columns_.data() + static_cast<std::size_t>(3 * echo + part) * stride_;
  }
  int rangeFirst(int echo) const { return low_[static_cast<std::size_t>(echo)]; }
  int rangeLast(int echo) const { return high_[static_cast<std::size_t>(echo)]; }

  /// Square of what remains of the values at the samples of an echo's range if what the parameters
  /// can represent is taken out. Needs invert().
  double projectedSquare(int echo, const double* values) const;

  /// The sum of squares of the residuals, and the normal equations at a model.
  double evaluate(const EchoModel& model, double noise = 0.0);
  double normal(int a, int b) const { return normal_[static_cast<std::size_t>(a * size_ + b)]; }
  double gradient(int a) const { return gradient_[static_cast<std::size_t>(a)]; }

 private:
  void evaluateEchoes(const EchoModel& model);
  void applyBounds();
  void accumulate(const EchoModel& model);
  void addBlock(const EchoModel& model, int a, int b);
  void addPriors(const EchoModel& model, double noise);
  double priorSum(const EchoModel& model, double noise) const;
  bool step(const EchoModel& from, double damping, EchoModel& to);

  const PulseResponse& response_;
  const double* counts_ = nullptr;
  const signed char* bound_ = nullptr;
  int samples_ = 0, size_ = 0, used_ = 0;
  std::size_t stride_ = 0;
  double predicted_ = 0.0;  ///< decrease of the sum of squares by the last step
  std::array<int, kMostEchoes> low_{}, high_{}, first_{};
  std::vector<double> residual_, columns_;
  std::array<double, kMostParameters> gradient_{};
  std::array<double, kMostParameters * kMostParameters> normal_{}, inverse_{}, factor_{};
};

}  // namespace pcl_als::detail
