// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {
namespace {

/// 200 Hz along a wavy line at large coordinates.
std::vector<TrajectorySample> flight(double hours) {
  std::vector<TrajectorySample> samples(static_cast<std::size_t>(hours * 3600.0 * 200.0));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = 0.005 * static_cast<double>(i);
    samples[i].time = 4e5 + t;
    samples[i].position = {583394.0 + 60.0 * t, 5283100.0 + 20.0 * std::sin(t / 30.0), 1500.0};
  }
  return samples;
}

const Trajectory& oneHour() {
  static const Trajectory trajectory(flight(1.0));
  return trajectory;
}

void makeTrajectory(benchmark::State& state) {
  const auto samples = flight(static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(Trajectory(samples));
  state.SetItemsProcessed(state.iterations() * static_cast<long>(samples.size()));
}
BENCHMARK(makeTrajectory)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

void lookUp(benchmark::State& state, bool random, bool with_cursor) {
  constexpr std::size_t kPoints = 1 << 20;
  const Trajectory& trajectory = oneHour();
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> within(trajectory.startTime(), trajectory.endTime());
  std::vector<double> times(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    times[i] = random ? within(generator)
                      : trajectory.startTime() + 5e-6 * static_cast<double>(i);  // 200 kHz
  }
  SensorPose pose;
  for (auto _ : state) {
    std::size_t cursor = 0;
    for (const double time : times) {
      if (!with_cursor) cursor = 0;
      trajectory.poseAt(time, pose, cursor);
      benchmark::DoNotOptimize(pose);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPoints));
}
BENCHMARK_CAPTURE(lookUp, sequential, false, true);
BENCHMARK_CAPTURE(lookUp, sequential_without_cursor, false, false);
BENCHMARK_CAPTURE(lookUp, random, true, true);

}  // namespace
}  // namespace pcl_als
