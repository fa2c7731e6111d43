// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {

struct SharedCell;

/// Terms of a RadiometricModel that overlaps can determine, besides the gains of the strips.
enum class RadiometricTerm : std::uint8_t { range_exponent, incidence_exponent, extinction };
inline constexpr std::size_t kRadiometricTermCount = 3;
const char* nameOf(RadiometricTerm term);  ///< "range_exponent", …
const char* unitOf(RadiometricTerm term);  ///< "1" or "1/km"
double valueOf(RadiometricTerm term, const RadiometricModel& model);

enum class TermStatus : std::uint8_t { fixed, estimated, not_estimable };
const char* nameOf(TermStatus status);

struct OverlapSettings {
  std::array<bool, kRadiometricTermCount> estimate{};  ///< by RadiometricTerm
  bool estimate_gains = false;
  /// A term whose standard deviation exceeds this is not estimable: it keeps the model's value.
  std::array<double, kRadiometricTermCount> largest_std = {0.2, 0.2, 0.05};
  double largest_gain_std = 0.05;  ///< relative
  double cluster_size = 40.0;      ///< metres: cells nearer than this share errors
  std::size_t least_cells = 50;
};

/// A parameter with its standard deviation.
struct EstimatedTerm {
  double value = 0.0, std = 0.0;
  double std_formal = 0.0;  ///< with independent cells
  TermStatus status = TermStatus::fixed;
  std::string reason;  ///< why it is not estimable
};

/// Differences between strips in common cells: coefficient of variation (standard deviation over
/// mean of the means of the strips) of each cell.
struct CellVariation {
  std::size_t cells = 0;
  double median = 0.0, rms = 0.0, p90 = 0.0;
};

struct OverlapResult {
  RadiometricModel model;  ///< the given model with the estimated terms
  std::array<EstimatedTerm, kRadiometricTermCount> terms;
  /// By strip: factor of the received intensity, with a geometric mean of 1 over each group of
  /// overlapping strips; std is relative.
  std::vector<EstimatedTerm> gains;
  std::vector<double> gainFactors() const;  ///< 1 where not estimated

  std::vector<std::string> order;  ///< of the correlation: terms, then "gain NAME"
  Eigen::MatrixXd correlation;
  double sigma0 = 0.0;  ///< relative standard deviation of a cell's mean of five points
  std::size_t cells = 0, observations = 0, clusters = 0;
  int iterations = 0;
  bool converged = false;  ///< true where there was nothing to estimate
  std::vector<std::string> warnings;
  /// without correction; with the given model; with this result
  CellVariation before, physics, after;
  bool reliable() const;  ///< converged, and every requested term is estimated
};

/// Calls each(name, term) with the terms of the model, then with the gains of the strips.
template <typename Function>
void forEachTerm(const OverlapResult& overlaps, const std::vector<std::string>& strips,
                 const Function& each) {
  for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
    each(std::string(nameOf(static_cast<RadiometricTerm>(t))), overlaps.terms[t]);
  }
  for (std::size_t i = 0; i < strips.size(); ++i) {
    each("gain of strip " + strips[i], overlaps.gains[i]);
  }
}

/// Requested terms that are not estimable, or that the adjustment did not converge.
std::string notEstimable(const OverlapResult& overlaps, const std::vector<std::string>& strips);

/** \brief Estimates radiometric parameters from the intensities of overlapping strips in common
 * cells.
 *
 * ln I_cs = ln rho_c + ln g_s - m ln(r / r0) + k ln cos(theta) - 2 a (r - r0) + e: the reflectances
 * of the cells are eliminated, and the other parameters are estimated by least squares with Huber's
 * weights. The covariance is a jackknife over clusters of cells (Bell and McCaffrey 2002, CR3),
 * because cells of one roof or field share errors, and it includes the uncertainty of the scatter
 * of few clusters. Effects common to all cells (a receiver that is not linear, a wrong trajectory)
 * are not visible in residuals.
 *
 * Observability: strips of one height differ little in range, so that m and a can be separated in
 * blocks of two heights only, and only where gains are fixed or known; on level ground cos(theta)
 * and r are functions of one another, so that m and k need slopes. A term whose standard deviation
 * exceeds its limit keeps the value of the given model, worst first, and the result names the term
 * from which it cannot be separated.
 */
OverlapResult adjustOverlaps(const std::vector<SharedCell>& cells, double cell_size,
                             const std::vector<std::string>& strips, const RadiometricModel& model,
                             const OverlapSettings& settings);

}  // namespace pcl_als
