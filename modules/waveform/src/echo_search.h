// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/waveform/pulse_response.h>
#include <pcl_als/waveform/waveform_decomposer.h>

#include "echo_fit.h"

namespace pcl_als::detail {

/// The likelihood's penalties for one more echo and for a width of its own.
struct Penalties {
  double echo = 0.0, width = 0.0;
  double split() const { return echo - width; }  ///< two echoes instead of a wide one
};

/// Penalties for a number of samples, so that about this many false echoes are found.
Penalties penaltiesFor(double false_echoes, int samples);

/** \brief Finds the model of a waveform: echoes are added where the residuals show one, and wide
 * echoes are split, as long as the penalised likelihood improves.
 */
class EchoSearch {
 public:
  EchoSearch(const PulseResponse& response, const DecompositionSettings& settings);

  /// \param bound as EchoFit::setSamples() \return the chosen model with its adjustment in fit()
  const EchoModel& search(const double* counts, const signed char* bound, int samples);
  EchoFit& fit() { return fit_; }
  double noise() const { return noise_; }
  int used() const { return result_.used; }  ///< samples with a residual
  int iterations() const { return iterations_; }

 private:
  struct Candidate {
    int sample = -1;
    double amplitude = 0.0;
    double significance = 0.0;  ///< amplitude over standard deviation, squared
  };

  bool firstEcho(const double* counts, int samples);
  bool addEcho();
  bool splitEcho();
  void freeWidths();
  bool mergeEchoes();
  void adjustFinally();
  bool overlaps(int echo) const;

  Candidate largestResidual(double variance) const;
  void matchedFilter(const double* residual, int samples);
  bool isRinging(const EchoModel& model, double time, double amplitude) const;
  double startWidth(const Candidate& candidate, const double* counts, int samples) const;
  bool splitIsIndicated(int echo, double variance);
  bool splitModel(int echo, EchoModel& split);
  FitResult adjust(EchoModel& model, double noise = 0.0);
  double criterion(const EchoModel& model, const FitResult& result) const;
  double variance() const;
  bool accept(const EchoModel& model, const FitResult& result);
  void restore();

  const PulseResponse& response_;
  const DecompositionSettings& settings_;
  EchoFit fit_;
  EchoModel model_;
  FitResult result_;
  Penalties penalties_;
  double criterion_ = 0.0, noise_ = 0.0;
  double least_variance_ = 0.0;  ///< of a sample
  int samples_ = 0, penalties_of_ = 0, iterations_ = 0;
  std::vector<double> kernel_;  ///< of the matched filter
  int kernel_first_ = 0;        ///< sample of its first value, from the time of the echo
  double kernel_square_ = 0.0;
  std::vector<double> filtered_, direction_;
  double skewness_ = 0.0;  ///< of the residuals, from splitIsIndicated()
};

}  // namespace pcl_als::detail
