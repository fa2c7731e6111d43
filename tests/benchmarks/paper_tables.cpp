// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "paper_tables.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace pcl_als::bench {
namespace {

constexpr const char* kColumns[kSystemParameterCount] = {
    "dX m", "dY m", "dZ m", "pitch \"", "roll \"", "heading \"", "dr m", "dS 1e-6"};

// What the paper has: Tables 2, 3 and 4.
constexpr const char* kPaperParameters[kExperiments] = {
    "0.01 | 0.00 | -29.5 | -88.7 | 3.0 | - | 265.6",
    "0.00 | 0.00 | -29.0 | -91.0 | 3.6 | 0.118 | 103.8",
    "0.01 | 0.00 | -29.5 | -89.6 | 3.5 | 0.142 | 93.5",
    "0.02 | 0.05 | -38.8 | -90.7 | -32.1 | 0.115 | 36.1"};
constexpr double kPaperPairs6[kPaperPairs][kStates][6] = {
    {{1.1073, -0.2994, -0.0062, 0.0008, -0.0535, -0.0039},
     {0.1078, 0.0305, -0.0483, 0.0011, -0.0047, -0.0042},
     {0.0976, 0.0266, -0.0495, 0.0010, -0.0032, -0.0041},
     {0.1025, 0.0297, -0.0489, 0.0010, -0.0040, -0.0041},
     {0.0845, 0.0211, -0.0489, 0.0011, -0.0040, -0.0038}},
    {{-0.1734, -0.3710, -0.0195, -0.0414, -0.0003, 0.0005},
     {-0.0105, 0.0629, -0.0057, -0.0046, -0.0007, 0.0023},
     {-0.0098, 0.0467, -0.0042, -0.0003, -0.0008, 0.0022},
     {-0.0100, 0.0378, -0.0044, -0.0014, -0.0007, 0.0026},
     {0.0046, 0.0589, -0.0038, 0.0010, -0.0008, 0.0024}},
    {{0.1498, 0.5741, -0.0802, 0.0528, 0.0002, 0.0025},
     {-0.0116, 0.0145, -0.0229, -0.0064, 0.0009, 0.0025},
     {-0.0107, 0.0128, -0.0240, -0.0053, 0.0009, 0.0026},
     {-0.0106, 0.0024, -0.0244, -0.0049, 0.0009, 0.0026},
     {-0.1032, 0.0212, -0.0265, -0.0027, 0.0008, 0.0025}},
    {{0.0338, 0.1237, 0.0768, 0.0078, -0.0009, -0.0081},
     {0.0369, 0.0704, -0.0281, -0.0035, -0.0009, -0.0088},
     {0.0375, 0.0606, -0.0281, -0.0008, -0.0009, -0.0087},
     {0.0379, 0.0536, -0.0271, -0.0012, -0.0009, -0.0088},
     {-0.0020, 0.0702, -0.0248, 0.0011, -0.0009, -0.0087}}};
constexpr double kPaperPoints[kStates][4] = {{0.11, 0.23, 0.23, 0.34},
                                             {0.05, 0.07, 0.22, 0.23},
                                             {0.06, 0.07, 0.17, 0.20},
                                             {0.06, 0.06, 0.17, 0.19},
                                             {0.06, 0.07, 0.17, 0.19}};

/// A value in the column's unit.
double shown(int parameter, double value) {
  const SystemParameterInfo& info = systemParameters()[static_cast<std::size_t>(parameter)];
  return value / info.internal_per_unit *
         (info.parameter == SystemParameter::scan_angle_scale ? 1e6 : 1.0);
}

bool hasColumn(int parameter) {
  return parameter != indexOf(SystemParameter::lever_arm_z);
}

}  // namespace

void PaperTables::addResult(int experiment, const CalibrationResult& result) {
  Parameters& sums = parameters_[static_cast<std::size_t>(experiment)];
  sums.blocks += 1.0;
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const ParameterEstimate& estimate = result.parameters[static_cast<std::size_t>(i)];
    if (estimate.status != ParameterStatus::estimated) continue;
    sums.count[i] += 1.0;
    sums.bias[i] += estimate.bias;
    sums.variance[i] += estimate.std * estimate.std;
    sums.squares[i] += std::pow(estimate.bias - truth_[i], 2);
  }
  for (std::size_t r = 0; r < result.correlation_order.size(); ++r) {
    for (std::size_t c = 0; c < result.correlation_order.size(); ++c) {
      sums.correlation(indexOf(result.correlation_order[r]),
                       indexOf(result.correlation_order[c])) +=
          result.correlation(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    }
  }
  for (const PairFit& fit : result.pairs) addFit(fit, experiment);
}

void PaperTables::addFit(const PairFit& fit, int experiment) {
  for (std::size_t pair = 0; pair < kPaperPairs; ++pair) {
    if (fit.a != std::to_string(kPairs[pair].first) || fit.b != std::to_string(kPairs[pair].second))
      continue;
    Pair& after = pairs_[pair][static_cast<std::size_t>(experiment) + 1];
    after.mean += fit.mean_after * fit.mean_after;
    after.rms += fit.rms_after * fit.rms_after;
    after.fits += 1.0;
    if (experiment != 1) continue;  // before: of the experiment with all pairs and all control
    pairs_[pair][0].mean += fit.mean_before * fit.mean_before;
    pairs_[pair][0].rms += fit.rms_before * fit.rms_before;
    pairs_[pair][0].fits += 1.0;
  }
}

void PaperTables::addDiscrepancy(int pair, int state, const Discrepancy& found) {
  Pair& sums = pairs_[static_cast<std::size_t>(pair)][static_cast<std::size_t>(state)];
  sums.shift += found.shift.array().square();
  sums.rotation += (found.rotation / kRadiansPerDegree).array().square();
  sums.count += 1.0;
}

void PaperTables::addPoints(int state, const PointErrors& errors) {
  points_[static_cast<std::size_t>(state)].push_back((errors.squares / errors.count).sqrt());
}

void PaperTables::print() const {
  printParameters();
  printCorrelations();
  printPairs();
  printPoints();
}

void PaperTables::printParameters() const {
  std::printf("\n## Parameters\n\n| |");
  for (int i = 0; i < kSystemParameterCount; ++i)
    if (hasColumn(i)) std::printf(" %s |", kColumns[i]);
  std::printf("\n|---|---|---|---|---|---|---|---|\n| truth |");
  for (int i = 0; i < kSystemParameterCount; ++i)
    if (hasColumn(i)) std::printf(" %.4g |", shown(i, truth_[i]));
  std::printf("\n");
  for (std::size_t e = 0; e < kExperiments; ++e) {
    const Parameters& sums = parameters_[e];
    std::printf("| %s |", kStateNames[e + 1]);
    std::string errors = std::string("| ") + kStateNames[e + 1] + ", RMS error |";
    for (int i = 0; i < kSystemParameterCount; ++i) {
      if (!hasColumn(i)) continue;
      const double n = sums.count[i];
      char text[80];
      std::snprintf(text, sizeof text, " %.3g (%.0f of %.0f) |",
                    shown(i, std::sqrt(sums.squares[i] / n)), n, sums.blocks);
      errors += n > 0.0 ? text : " - |";
      std::snprintf(text, sizeof text, " %.3g ± %.2g |", shown(i, sums.bias[i] / n),
                    shown(i, std::sqrt(sums.variance[i] / n)));
      std::printf("%s", n > 0.0 ? text : " - |");
    }
    std::printf("\n%s\n| %s, paper | %s |\n", errors.c_str(), kStateNames[e + 1],
                kPaperParameters[e]);
  }
}

void PaperTables::printCorrelations() const {
  std::printf("\n## Correlations above 0.5, mean\n\n| | |\n|---|---|\n");
  for (std::size_t e = 0; e < kExperiments; ++e) {
    std::string text;
    for (int i = 0; i < kSystemParameterCount; ++i) {
      for (int j = i + 1; j < kSystemParameterCount; ++j) {
        const double value = parameters_[e].correlation(i, j) / parameters_[e].blocks;
        if (std::abs(value) <= 0.5) continue;
        char entry[120];
        std::snprintf(entry, sizeof entry, "%s%s and %s %.2f", text.empty() ? "" : ", ",
                      systemParameters()[static_cast<std::size_t>(i)].name.data(),
                      systemParameters()[static_cast<std::size_t>(j)].name.data(), value);
        text += entry;
      }
    }
    std::printf("| %s | %s |\n", kStateNames[e + 1], text.empty() ? "none" : text.c_str());
  }
}

void PaperTables::printPairs() const {
  std::printf(
      "\n## Discrepancies between strips, RMS over the seeds (paper, one block)\n\n"
      "| pair | | XT m | YT m | ZT m | w 0.001 deg | f 0.001 deg | k 0.001 deg | normal distance: "
      "mean, RMS mm |\n|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t p = 0; p < kPaperPairs; ++p) {
    for (std::size_t state = 0; state < kStates; ++state) {
      const Pair& sums = pairs_[p][state];
      std::printf("| %d&%d | %s |", kPairs[p].first, kPairs[p].second, kStateNames[state]);
      for (int i = 0; i < 3; ++i) {
        std::printf(" %.3f (%.3f) |", std::sqrt(sums.shift[i] / sums.count),
                    kPaperPairs6[p][state][i]);
      }
      for (int i = 0; i < 3; ++i) {
        std::printf(" %.1f (%.1f) |", 1e3 * std::sqrt(sums.rotation[i] / sums.count),
                    1e3 * kPaperPairs6[p][state][i + 3]);
      }
      if (sums.fits > 0.0) {
        std::printf(" %.0f, %.0f |\n", 1e3 * std::sqrt(sums.mean / sums.fits),
                    1e3 * std::sqrt(sums.rms / sums.fits));
      } else {
        std::printf(" not used |\n");
      }
    }
  }
}

void PaperTables::printPoints() const {
  std::printf(
      "\n## Check points, RMSE (paper), m\n\n| | east | north | height | plan | total |\n"
      "|---|---|---|---|---|---|\n");
  for (std::size_t state = 0; state <= kStates; ++state) {
    Eigen::Array3d squares = Eigen::Array3d::Zero();
    for (const Eigen::Array3d& rmse : points_[state]) squares += rmse.square();
    squares /= static_cast<double>(points_[state].size());
    const double plan = std::sqrt(squares[0] + squares[1]);
    const double total = std::sqrt(squares.sum());
    if (state == kStates) {
      std::printf("| true parameters | %.3f | %.3f | %.3f | %.3f | %.3f |\n", std::sqrt(squares[0]),
                  std::sqrt(squares[1]), std::sqrt(squares[2]), plan, total);
      continue;
    }
    const double* paper = kPaperPoints[state];
    std::printf("| %s | %.3f (%.2f) | %.3f (%.2f) | %.3f (%.2f) | %.3f (%.2f) | %.3f (%.2f) |\n",
                kStateNames[state], std::sqrt(squares[0]), paper[0], std::sqrt(squares[1]),
                paper[1], std::sqrt(squares[2]), paper[2], plan, std::hypot(paper[0], paper[1]),
                total, paper[3]);
  }
}

}  // namespace pcl_als::bench
