// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// waveform_echoes FOLDER: what the decomposition of waveforms adds to a detector of discrete
// returns, on simulated blocks with known truth; see waveform.md. Files are written to FOLDER.
#include <cmath>
#include <cstdio>
#include <vector>

#include <pcl_als/simulation/radiometry.h>

#include "waveform_truth.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::benchmark;
using simulation::Backscatter;
using simulation::LandCover;
using simulation::SimulationOptions;

constexpr double kNearGround = 0.45;  // m
constexpr double kVegetationShare = 0.05;
/// Ranges of the surfaces of a pulse that count as one surface, m.
constexpr double kOneSurface = 0.1;

struct Deviations {
  double sum = 0.0, square = 0.0;
  std::size_t count = 0;

  void add(double value) {
    sum += value;
    square += value * value;
    ++count;
  }
  double mean() const { return sum / static_cast<double>(count); }
  double rms() const { return std::sqrt(square / static_cast<double>(count)); }
  double std() const { return std::sqrt(std::max(0.0, rms() * rms() - mean() * mean())); }
};

struct Truth {
  double ground_range = 0.0;  ///< mean of the ground, weighted by signal
  double ground_share = 0.0, vegetation_share = 0.0, range = 0.0, tangent = 0.0;

  explicit Truth(const DecomposedPulse& p) {
    double ground = 0.0, all = 0.0;
    for (std::size_t i = p.pulse.part; i < p.pulse.part + p.pulse.parts; ++i) {
      const Backscatter& b = p.truth.backscatter[i];
      const bool leaves = b.cover == LandCover::tree;
      (leaves ? vegetation_share : ground_share) += b.share;
      all += b.signal;
      range += b.signal * b.range;
      tangent += b.signal * b.tangent;
      if (leaves) continue;
      ground += b.signal;
      ground_range += b.signal * b.range;
    }
    ground_range /= ground;
    range /= all;
    tangent /= all;
  }
};

/// Counts that the true surfaces give within half the width of an echo, over those of the echo.
double explainedShare(const DecomposedPulse& p, const FoundEcho& echo, double pulse_width_ns,
                      const std::function<double(const Backscatter&)>& countsOf) {
  const double reach = 0.25 * simulation::kLightSpeed * std::max(echo.width, pulse_width_ns);
  double counts = 0.0;
  for (std::size_t i = p.pulse.part; i < p.pulse.part + p.pulse.parts; ++i) {
    const Backscatter& b = p.truth.backscatter[i];
    if (std::abs(b.range - echo.range) <= reach) counts += countsOf(b);
  }
  return counts / (echo.amplitude * echo.width / pulse_width_ns);
}

/// Ground under vegetation by one method.
struct GroundFound {
  std::size_t found = 0;
  Deviations error;

  void add(double nearest) {
    if (!(std::abs(nearest) <= kNearGround)) return;
    ++found;
    error.add(nearest);
  }
  void print(const char* name, std::size_t pulses) const {
    std::printf(
        "  ground by %-10s found under %5.1f %% of %zu pulses; range error mean %+.3f m, "
        "RMS %.3f m\n",
        name, 100.0 * static_cast<double>(found) / static_cast<double>(pulses), pulses,
        error.mean(), error.rms());
  }
};

/// A pulse with a steep rise and a slow decay, 4 ns wide at half maximum.
void setSkewedPulse(simulation::WaveformOptions& waveform) {
  waveform.pulse_width = 4.0;
  for (double t = -10.0; t <= 30.0; t += 0.5) {
    const double sigma = t < 0.0 ? 1.2 : 2.2;
    waveform.pulse.push_back(std::exp(-0.5 * t * t / (sigma * sigma)));
  }
  waveform.pulse_spacing = 0.5;
}

SimulationOptions oneLine(double height, double length, double density) {
  auto options = SimulationOptions::preset("small");
  simulation::PlannedLine line = options.lines.front();
  line.start = {0.0, -0.5 * length};
  line.end = {0.0, 0.5 * length};
  line.height = height;
  line.density = density;
  options.lines = {line};
  options.pairs.clear();
  options.bias.setZero();
  options.control_points = 0;
  options.waveform.emplace();
  return options;
}

/// What is counted in a forest.
struct ForestCounts {
  std::size_t pulses = 0, returns = 0, echoes = 0, unexplained = 0, misplaced = 0;
  std::size_t under = 0, open = 0, open_false = 0;
  GroundFound discrete, decomposed;
  Deviations open_error, open_offset;  ///< of single echoes over their std; behind their return, m

  void add(const DecomposedPulse& p, double width,
           const std::function<double(const Backscatter&)>& countsOf);
  void addOpen(const DecomposedPulse& p, const Truth& truth);
  void print(const char* name) const;
};

void ForestCounts::addOpen(const DecomposedPulse& p, const Truth& truth) {
  const auto& parts = p.truth.backscatter;
  if (parts[p.pulse.part + p.pulse.parts - 1].range - parts[p.pulse.part].range > kOneSurface)
    return;
  ++open;
  open_false += p.echoes.size() - 1;
  if (p.echoes.size() != 1 || p.returns.size() != 1 || std::isnan(p.echoes[0].amplitude)) return;
  open_error.add((p.echoes[0].range - truth.range) / p.echoes[0].range_std);
  open_offset.add(p.echoes[0].range - p.returns[0]);
}

void ForestCounts::add(const DecomposedPulse& p, double width,
                       const std::function<double(const Backscatter&)>& countsOf) {
  const Truth truth(p);
  if (truth.vegetation_share == 0.0) addOpen(p, truth);
  if (truth.vegetation_share < kVegetationShare) return;
  ++pulses;
  returns += p.returns.size();
  double nearest_return = 1e9, nearest_echo = 1e9;
  for (const double range : p.returns)
    if (std::abs(range - truth.ground_range) < std::abs(nearest_return))
      nearest_return = range - truth.ground_range;
  for (const FoundEcho& echo : p.echoes) {
    if (std::isnan(echo.amplitude)) continue;  // a return without an echo
    ++echoes;
    const double share = explainedShare(p, echo, width, countsOf);
    unexplained += share < 0.5 ? 1 : 0;
    misplaced += share == 0.0 ? 1 : 0;
    if (std::abs(echo.range - truth.ground_range) < std::abs(nearest_echo))
      nearest_echo = echo.range - truth.ground_range;
  }
  if (truth.ground_share <= 0.0) return;
  ++under;
  discrete.add(nearest_return);
  decomposed.add(nearest_echo);
}

void ForestCounts::print(const char* name) const {
  const auto share = [](std::size_t part, std::size_t of) {
    return static_cast<double>(part) / static_cast<double>(of);
  };
  std::printf(
      "%s: %zu pulses in vegetation, %.2f returns and %.2f echoes each (%+.1f %%); %.2f %% "
      "of the echoes are twice what the surfaces there return, %.3f %% have none within "
      "half their width; %zu pulses on one surface with %zu false echoes\n",
      name, pulses, share(returns, pulses), share(echoes, pulses),
      100.0 * (share(echoes, returns) - 1.0), 100.0 * share(unexplained, echoes),
      100.0 * share(misplaced, echoes), open, open_false);
  discrete.print("returns", under);
  decomposed.print("echoes", under);
  std::printf(
      "  single echoes: error over standard deviation, mean %+.3f, RMS %.3f; %+.2f mm behind the "
      "return\n",
      open_error.mean(), open_error.rms(), 1e3 * open_offset.mean());
  std::fflush(stdout);
}

void forest(const char* name, const SimulationOptions& options, const std::filesystem::path& folder,
            const WaveformSettings& settings = {}) {
  const double counts_per_number = options.waveform->largestCount() / options.waveform->full_scale;
  const double gain = options.scanner.gain * options.lines.front().gain;
  const double extinction = simulation::extinctionPerKilometre(options.atmosphere);
  const auto countsOf = [&](const Backscatter& b) {
    return counts_per_number * simulation::digitalNumber(gain, b.signal, b.range, extinction);
  };
  ForestCounts counts;
  const DecomposedStrip strip = decomposeSimulated(
      options, folder, settings,
      [&](const DecomposedPulse& p) { counts.add(p, options.waveform->pulse_width, countsOf); });
  std::printf("%s: pulse of %.2f ns, %s\n", name, strip.result.pulses.front().width_ns,
              strip.result.pulses.front().origin.c_str());
  counts.print(name);
}

/// Range errors on open ground by the incidence of the beam.
void slopes(const char* name, const SimulationOptions& options, const std::filesystem::path& folder,
            const WaveformSettings& settings = {}) {
  struct Class {
    double from, to;  ///< degrees
    Deviations discrete, decomposed;
  };
  std::vector<Class> classes{{0.0, 5.0, {}, {}}, {13.0, 17.0, {}, {}}, {28.0, 32.0, {}, {}}};
  decomposeSimulated(options, folder, settings, [&](const DecomposedPulse& p) {
    const Truth truth(p);
    if (p.returns.size() != 1 || p.echoes.size() != 1 || truth.vegetation_share > 0.0) return;
    if (std::isnan(p.echoes[0].amplitude)) return;
    const double degrees = std::atan(truth.tangent) / kRadiansPerDegree;
    for (Class& c : classes) {
      if (degrees < c.from || degrees >= c.to) continue;
      c.discrete.add(p.returns[0] - truth.range);
      c.decomposed.add(p.echoes[0].range - truth.range);
    }
  });
  std::printf("%s\n", name);
  for (const Class& c : classes) {
    std::printf(
        "  incidence %2.0f to %2.0f degrees, %7zu pulses: range error of the return %+6.2f "
        "± %.2f mm, RMS %.2f mm; of the echo %+6.2f ± %.2f mm, RMS %.2f mm\n",
        c.from, c.to, c.discrete.count, 1e3 * c.discrete.mean(), 1e3 * c.discrete.std(),
        1e3 * c.discrete.rms(), 1e3 * c.decomposed.mean(), 1e3 * c.decomposed.std(),
        1e3 * c.decomposed.rms());
  }
}

SimulationOptions forestOptions() {
  SimulationOptions options = oneLine(540.0, 300.0, 1.0);
  options.scene.trees = 4.0;
  options.scene.buildings = 0.0;
  return options;
}

void runForests(const std::filesystem::path& folder) {
  SimulationOptions options = forestOptions();
  forest("forest, 540 m, pulse of 4 ns", options, folder);
  options.waveform->bits = 8;
  forest("the same with 8 bits", options, folder);
  options.waveform->bits = 12;
  options.waveform->noise = 0.004;
  forest("the same with four times the noise", options, folder);
  options.waveform->noise = 0.001;
  options.waveform->pulse_width = 8.0;
  forest("the same with a pulse of 8 ns", options, folder);
  setSkewedPulse(*options.waveform);
  WaveformSettings sampled;
  sampled.pulse = options.waveform->pulse;
  sampled.pulse_spacing_ns = options.waveform->pulse_spacing;
  forest("skewed pulse, which the decomposition knows", options, folder, sampled);
  forest("skewed pulse, estimated", options, folder);
  WaveformSettings gaussian;
  gaussian.pulse_width_ns = options.waveform->pulse_width;
  forest("skewed pulse, taken for a Gaussian", options, folder, gaussian);
}

/// Estimated responses of pulses of several shapes, digitizers and seeds.
void runShapes(const std::filesystem::path& folder) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulationOptions options = forestOptions();
    options.seed = seed;
    std::printf("seed %d\n", static_cast<int>(seed));
    forest("Gaussian pulse", options, folder);
    options.waveform->pulse_skewness = 0.6;
    forest("skewness of 0.6", options, folder);
    options.waveform->bits = 8;
    forest("skewness of 0.6, 8 bits", options, folder);
    options.waveform->bits = 12;
    options.waveform->noise = 0.004;
    forest("skewness of 0.6, four times the noise", options, folder);
    options.waveform->noise = 0.001;
    options.waveform->pulse_width = 2.0;
    forest("skewness of 0.6, pulse of 2 ns", options, folder);
  }
}

void runSlopes(const std::filesystem::path& folder) {
  SimulationOptions options = oneLine(1000.0, 1500.0, 0.2);
  options.scene.mountains = 400.0;
  options.scene.relief = 1.5;
  options.scene.trees = options.scene.buildings = 0.0;
  options.lines.front().height = 1300.0;
  slopes("slopes, divergence of 0.33 mrad", options, folder);
  options.waveform->rings = 8;
  options.scanner.divergence = 0.5e-3;
  slopes("divergence of 0.5 mrad", options, folder);
  options.scanner.divergence = 1e-3;
  slopes("divergence of 1 mrad", options, folder);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("waveform_echoes FOLDER [forest|slopes|shapes]\n", stderr);
    return 1;
  }
  const std::string part = argc > 2 ? argv[2] : "";
  if (part.empty() || part == "forest") runForests(argv[1]);
  if (part.empty() || part == "slopes") runSlopes(argv[1]);
  if (part.empty() || part == "shapes") runShapes(argv[1]);
  return 0;
}
