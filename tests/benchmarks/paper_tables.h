// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>

#include "strip_coregistration.h"

namespace pcl_als::bench {

inline constexpr int kExperiments = 4, kStates = kExperiments + 1, kPaperPairs = 4;
inline constexpr const char* kStateNames[kStates] = {"before", "I", "II", "III", "IV"};
inline constexpr std::pair<int, int> kPairs[kPaperPairs] = {{1, 2}, {3, 4}, {4, 5}, {5, 6}};

/// Squares of point errors, east, north, up.
struct PointErrors {
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  double count = 0.0;
  void add(const Eigen::Vector3d& error) {
    squares += error.array().square();
    count += 1.0;
  }
};

/// Results of the experiments of Habib et al. 2011 over several seeds, and the paper's own, as
/// Markdown tables. States: before, and after each experiment.
class PaperTables {
 public:
  explicit PaperTables(const SystemVector& truth) : truth_(truth) {}

  void addResult(int experiment, const CalibrationResult& result);
  void addDiscrepancy(int pair, int state, const Discrepancy& found);
  /// RMSE of the points of one block; state kStates: without any bias, noise alone.
  void addPoints(int state, const PointErrors& errors);
  void print() const;

 private:
  struct Parameters {
    SystemVector count = SystemVector::Zero(), bias = SystemVector::Zero(),
                 variance = SystemVector::Zero(), squares = SystemVector::Zero();
    SystemMatrix correlation = SystemMatrix::Zero();
    double blocks = 0.0;
  };
  /// Sums over seeds.
  struct Pair {
    Eigen::Array3d shift = Eigen::Array3d::Zero(), rotation = Eigen::Array3d::Zero();  ///< squares
    double mean = 0.0, rms = 0.0;  ///< squares, of normal distances
    double count = 0.0, fits = 0.0;
  };

  void addFit(const PairFit& fit, int experiment);
  void printParameters() const;
  void printCorrelations() const;
  void printPairs() const;
  void printPoints() const;

  SystemVector truth_;
  std::array<Parameters, kExperiments> parameters_;
  std::array<std::array<Pair, kStates>, kPaperPairs> pairs_;
  std::array<std::vector<Eigen::Array3d>, kStates + 1> points_;  ///< RMSE by seed
};

}  // namespace pcl_als::bench
