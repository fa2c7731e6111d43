// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <benchmark/benchmark.h>

#include <pcl_als/simulation/simulator.h>

namespace pcl_als::simulation {
namespace {

SimulationOptions block(const char* noise) {
  auto options = SimulationOptions::preset("small");
  options.noise = NoiseOptions::named(noise);
  return options;
}

void buildScene(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(Scene({-500.0, -500.0}, {500.0, 500.0}, SceneOptions(), 1));
}
BENCHMARK(buildScene)->Unit(benchmark::kMillisecond);

/// Rays of a swath at 540 m, in order.
void traceRays(benchmark::State& state) {
  const Scene scene({-500.0, -500.0}, {500.0, 500.0}, SceneOptions(), 1);
  std::vector<SurfaceHit> hits;
  double place = 0.0;
  for (auto _ : state) {
    place = place > 400.0 ? -400.0 : place + 0.5;
    const Eigen::Vector3d direction(0.36 * place / 400.0, 0.02, -1.0);
    scene.trace({0.5 * place, 0.3 * place, 540.0}, direction.normalized(), hits);
    benchmark::DoNotOptimize(hits.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(traceRays);

/// Whole strips; items are pulses.
void simulateStrip(benchmark::State& state, const char* noise, int threads) {
  const Simulator simulator(block(noise));
  for (auto _ : state) {
    std::size_t points = 0;
    simulator.simulateStrip(
        3, threads, [&](const std::vector<SimulatedPoint>& chunk) { points += chunk.size(); });
    benchmark::DoNotOptimize(points);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(simulator.pulseCount(3)));
}
BENCHMARK_CAPTURE(simulateStrip, none_1, "none", 1)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulateStrip, none_2, "none", 2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulateStrip, realistic_1, "realistic", 1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulateStrip, realistic_2, "realistic", 2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pcl_als::simulation
