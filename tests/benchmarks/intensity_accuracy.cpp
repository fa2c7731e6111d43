// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// intensity_accuracy [SEEDS [FIRST]]: what the radiometric correction is worth on simulated blocks
// whose reflectance is known. First one block through calibration and correction; then the
// parameters that overlaps give over many blocks, against their standard deviations; with a first
// seed only that.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <pcl_als/common/statistics.h>
#include <pcl_als/filters/intensity_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/radiometry/atmosphere.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>

#include "simulated_strips.h"
#include "simulated_survey.h"

namespace {

using namespace pcl_als;
using simulation::NoiseOptions;
using simulation::SimulationOptions;

constexpr std::array<double, 7> kIncidence = {0, 10, 20, 30, 40, 50, 60};

/// Corrected over true reflectance, up to one constant for all strips.
struct Ratios {
  std::vector<double> all;
  std::vector<std::vector<std::vector<double>>> by_strip;  ///< then by incidence
};

RadiometricModel modelOf(const SimulationOptions& options) {
  Atmosphere air;
  air.visibility_km = options.atmosphere.visibility_km;
  air.temperature_c = options.atmosphere.temperature_c;
  air.pressure_kpa = options.atmosphere.pressure_kpa;
  air.relative_humidity = 0.0;  // the simulated air has no vapour
  RadiometricModel model;
  model.extinction_per_km = extinctionOf(air).total();
  return model;
}

Ratios ratiosOf(const test::SimulatedStrips& block, const RadiometricModel& model, bool correct) {
  Ratios ratios;
  for (const test::SimulatedStrip& simulated : block.strips) {
    auto& bins = ratios.by_strip.emplace_back(kIncidence.size() - 1);
    IntensityCorrection<PointLidar> filter;
    filter.setTrajectory(block.flight);
    filter.setModel(model);
    filter.setLocalFrame(simulated.strip.frame);
    filter.setInputCloud(simulated.strip.cloud);
    filter.setNumberOfThreads(0);
    pcl::PointCloud<PointLidar> corrected;
    filter.filter(corrected);
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      const PointRadiometry& found = filter.getRadiometry()[i];
      const PointLidar& given = (*simulated.strip.cloud)[i];
      if (found.status != RadiometryStatus::surface || given.number_of_returns > 1) continue;
      if (given.classification == 5) continue;  // leaves are no surface, whatever plane they formed
      const double degrees = static_cast<double>(found.incidence) / kRadiansPerDegree;
      if (degrees >= kIncidence.back()) continue;
      const auto bin = static_cast<std::size_t>(
          std::upper_bound(kIncidence.begin(), kIncidence.end(), degrees) - kIncidence.begin() - 1);
      const double value = static_cast<double>(correct ? corrected[i].intensity : given.intensity) /
                           static_cast<double>(simulated.reflectance[i]);
      ratios.all.push_back(value);
      bins[bin].push_back(value);
    }
  }
  return ratios;
}

double meanOf(const std::vector<double>& values) {
  RunningStatistics sum;
  for (const double value : values) sum.add(value);
  return sum.mean();
}

void printRatios(const char* title, const Ratios& ratios) {
  std::vector<double> all = ratios.all;
  const double constant = medianInPlace(all);
  std::printf("\n%s: %zu points, (intensity / reflectance) / constant, mean by incidence\nstrip",
              title, all.size());
  for (std::size_t b = 0; b + 1 < kIncidence.size(); ++b)
    std::printf("  %4.0f-%-2.0f", kIncidence[b], kIncidence[b + 1]);
  double worst = 0.0;
  for (std::size_t strip = 0; strip < ratios.by_strip.size(); ++strip) {
    std::printf("\n%5zu", strip + 1);
    for (const std::vector<double>& bin : ratios.by_strip[strip]) {
      if (bin.size() < 100) {
        std::printf("        -");
        continue;
      }
      const double mean = meanOf(bin) / constant;
      worst = std::max(worst, std::abs(mean - 1.0));
      std::printf("  %7.4f", mean);
    }
  }
  RunningStatistics spread;
  std::size_t within = 0;
  for (const double value : all) {
    spread.add(value / constant);
    within += std::abs(value / constant - 1.0) <= 0.02 ? 1 : 0;
  }
  std::printf(
      "\nworst mean of 100 points or more: %.2f %%; all points: sd %.2f %%, within 2 %%: %.1f %%\n",
      100.0 * worst, 100.0 * spread.standardDeviation(),
      100.0 * static_cast<double>(within) / static_cast<double>(all.size()));
}

/// The strips with the biases taken out that a calibration finds.
void calibrate(const SimulationOptions& options, test::SimulatedStrips& block) {
  const CalibrationResult result =
      test::SimulatedSurvey(options).calibrate(CalibrationSettings(), true, true);
  const SystemCorrection correct(result, simulation::Simulator(options).trajectory());
  for (test::SimulatedStrip& simulated : block.strips) {
    SystemBiasCorrection<PointLidar> correction;
    correction.setCorrection(correct);
    correction.setLocalFrame(simulated.strip.frame);
    correction.setInputCloud(simulated.strip.cloud);
    pcl::PointCloud<PointLidar>::Ptr corrected(new pcl::PointCloud<PointLidar>);
    correction.filter(*corrected);
    simulated.strip.cloud = corrected;
  }
}

RadiometricCells cellsOf(const test::SimulatedStrips& block, const RadiometricModel& model) {
  RadiometricCells cells(3.0);
  for (std::size_t s = 0; s < block.strips.size(); ++s) {
    const Strip<PointLidar>& strip = block.strips[s].strip;
    std::vector<Eigen::Vector3f> last;
    for (const PointLidar& p : *strip.cloud)
      if (p.return_number >= p.number_of_returns) last.emplace_back(p.getVector3fMap());
    const LocalSurfaces surfaces(last, LocalSurfaceSettings());
    const RadiometricEvaluator evaluator(block.flight, model);
    RadiometryCursor cursor;
    for (const PointLidar& p : *strip.cloud) {
      const Eigen::Vector3d place = strip.frame.toGround(p.getVector3fMap());
      LidarReturn point;
      point.position = place;
      point.time = p.gps_time;
      point.return_number = p.return_number;
      point.number_of_returns = p.number_of_returns;
      LocalSurface surface;
      if (p.return_number >= p.number_of_returns) surface = surfaces.at(p.getVector3fMap());
      cells.add(static_cast<int>(s), place.x(), place.y(), static_cast<double>(p.intensity),
                p.intensity > 0.0F && p.intensity < 65535.0F && p.number_of_returns == 1,
                evaluator.evaluate(point, surface, cursor), surface);
    }
  }
  return cells;
}

/// Sums of (estimate - truth) / std, by parameter.
struct Coverage {
  std::vector<double> z, error, std;
  void add(double estimate, double truth, double sigma) {
    z.push_back((estimate - truth) / sigma);
    error.push_back(estimate - truth);
    std.push_back(sigma);
  }
  void print(const char* name) const {
    double z_sq = 0, e_sq = 0, mean_std = 0, bias = 0, worst = 0;
    int inside1 = 0, inside2 = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      z_sq += z[i] * z[i], e_sq += error[i] * error[i], mean_std += std[i], bias += error[i];
      inside1 += std::abs(z[i]) <= 1.0, inside2 += std::abs(z[i]) <= 2.0;
      worst = std::max(worst, std::abs(z[i]));
    }
    const auto n = static_cast<double>(z.size());
    if (z.empty()) return;
    std::printf(
        "%-20s n %3zu  RMS error %.5f  mean error %+.5f  mean std %.5f  RMS z %.2f  within 1: "
        "%3.0f %%  2: %3.0f %%  worst %.1f\n",
        name, z.size(), std::sqrt(e_sq / n), bias / n, mean_std / n, std::sqrt(z_sq / n),
        100.0 * inside1 / n, 100.0 * inside2 / n, worst);
  }
};

/// Case 1: exponents and gains unknown. Case 2: one gain for all strips, extinction unknown.
void coverage(int first, int seeds, bool gains, const char* noise) {
  Coverage range, incidence, extinction, gain;
  int lost = 0;
  for (int seed = first; seed < first + seeds; ++seed) {
    SimulationOptions options = SimulationOptions::preset("small", 0.6, 0.6);
    options.seed = static_cast<std::uint64_t>(seed);
    options.noise = NoiseOptions::named(noise);
    options.bias.setZero();
    options.scanner.range_exponent = gains ? 1.8 : 2.0;
    options.scanner.incidence_exponent = 0.8;
    const std::array<double, 5> factors = {1.15, 0.9, 1.05, 0.8, 1.1};
    for (std::size_t i = 0; gains && i < options.lines.size(); ++i)
      options.lines[i].gain = factors[i];
    if (!gains) options.atmosphere.visibility_km = 8.0;
    const test::SimulatedStrips block(options);
    RadiometricModel model = modelOf(options);
    const double truth = model.extinction_per_km;
    if (!gains) model.extinction_per_km = 0.02;
    OverlapSettings settings;
    settings.estimate = {gains, true, !gains};
    settings.estimate_gains = gains;
    const OverlapResult result =
        adjustOverlaps(cellsOf(block, model).shared(), 3.0, block.names, model, settings);
    if (!result.reliable()) {
      ++lost;
      continue;
    }
    if (gains)
      range.add(result.terms[0].value, options.scanner.range_exponent, result.terms[0].std);
    incidence.add(result.terms[1].value, 0.8, result.terms[1].std);
    if (!gains) extinction.add(result.terms[2].value, truth, result.terms[2].std);
    double mean = 0.0;
    for (const double factor : factors) mean += std::log(factor) / 5.0;
    for (std::size_t i = 0; gains && i < factors.size(); ++i)
      gain.add(std::log(result.gains[i].value), std::log(factors[i]) - mean, result.gains[i].std);
    if (seed == first)
      std::printf("  cells %zu, clusters %zu, sigma0 %.4f, median variation %.3f -> %.3f -> %.3f\n",
                  result.cells, result.clusters, result.sigma0, result.before.median,
                  result.physics.median, result.after.median);
    std::fflush(stdout);
  }
  std::printf("%d blocks, noise %s, %s; not reliable: %d\n", seeds, noise,
              gains ? "exponents and gains unknown" : "extinction and incidence exponent unknown",
              lost);
  range.print("range_exponent");
  incidence.print("incidence_exponent");
  extinction.print("extinction");
  gain.print("ln gain");
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  for (const char* noise : {"range", "realistic"}) {
    if (argc > 2) break;
    SimulationOptions options = SimulationOptions::preset("small");
    options.noise = NoiseOptions::named(noise);
    test::SimulatedStrips block(options);
    const RadiometricModel model = modelOf(options);
    std::printf("\n== block with the preset's biases, noise %s\n", noise);
    printRatios("as received", ratiosOf(block, model, false));
    calibrate(options, block);
    printRatios("corrected after calibration", ratiosOf(block, model, true));
  }
  std::printf("\n== overlap-driven parameters\n");
  for (const char* noise : {"range", "realistic"}) {
    coverage(first, seeds, true, noise);
    coverage(first, seeds, false, noise);
  }
  return 0;
}
