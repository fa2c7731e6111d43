// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <benchmark/benchmark.h>

#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

constexpr std::size_t kPoints = 1 << 18;

std::shared_ptr<const Trajectory> flight() {
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= 4000; ++i) {
    TrajectorySample sample;
    sample.time = 0.005 * i;
    sample.position = {60.0 * sample.time, 20.0 * std::sin(sample.time / 3.0), 1000.0};
    samples.push_back(sample);
  }
  return std::make_shared<Trajectory>(samples);
}

/// Which biases are not zero: what the kernel has to compute depends on it.
SystemVector biases(int kind) {
  SystemVector biases;
  biases << 0.05, 0.02, 0.0, 1e-4, 4e-4, -2e-4, kind > 0 ? -0.12 : 0.0, kind > 1 ? 1e-4 : 0.0;
  return biases;
}

struct Columns {
  std::vector<double> time, x, y, z, effect_x, effect_y, effect_z;
};

/// A swath of 2 s at 131 kHz, in order of time or shuffled.
Columns swath(bool shuffled) {
  Columns points;
  std::vector<double> times(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) times[i] = 2.0 * static_cast<double>(i) / kPoints;
  if (shuffled) std::shuffle(times.begin(), times.end(), std::mt19937_64(3));
  for (std::size_t i = 0; i < kPoints; ++i) {
    points.time.push_back(times[i]);
    points.x.push_back(60.0 * times[i]);
    points.y.push_back(400.0 * std::sin(0.1 * static_cast<double>(i)));
    points.z.push_back(10.0 * std::cos(0.01 * static_cast<double>(i)));
  }
  points.effect_x = points.effect_y = points.effect_z = points.x;
  return points;
}

void count(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPoints));
}

/// The way a reader of Eq. (8) would write it: look-up, scanGeometry, designBlock, product.
void designBlockPerPoint(benchmark::State& state) {
  const auto trajectory = flight();
  const Columns points = swath(false);
  const SystemVector delta = biases(2);
  SensorPose pose;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (auto _ : state) {
    std::size_t cursor = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      trajectory->poseAt(points.time[i], pose, cursor);
      const Eigen::Vector3d ground(points.x[i], points.y[i], points.z[i]);
      sum += designBlock(scanGeometry(pose, ground)) * delta;
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(designBlockPerPoint);

void evaluator(benchmark::State& state, bool shuffled, bool inverse) {
  Columns points = swath(shuffled);
  const BiasEvaluator evaluator(flight(), biases(static_cast<int>(state.range(0))));
  const PointColumns columns{points.time.data(), points.x.data(), points.y.data(), points.z.data()};
  const EffectColumns effect{points.effect_x.data(), points.effect_y.data(),
                             points.effect_z.data()};
  for (auto _ : state) {
    CoverageCount coverage;
    if (inverse) {
      evaluator.inverseEffect(columns, kPoints, effect, coverage);
    } else {
      evaluator.effect(columns, kPoints, effect, coverage);
    }
    benchmark::ClobberMemory();
  }
  count(state);
}
// 0: lever arm and boresight; 1: and range; 2: and scan angle scale
BENCHMARK_CAPTURE(evaluator, in_order, false, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(evaluator, shuffled, true, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(evaluator, inverse, false, true)->Arg(2);

void integerRecords(benchmark::State& state) {
  const Columns points = swath(false);
  constexpr std::size_t kLength = 30;  // LAS point format 6
  std::vector<std::byte> records(kPoints * kLength);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const std::int32_t raw[3] = {static_cast<std::int32_t>(points.x[i] * 1e3),
                                 static_cast<std::int32_t>(points.y[i] * 1e3),
                                 static_cast<std::int32_t>(points.z[i] * 1e3)};
    std::memcpy(&records[i * kLength], raw, sizeof raw);
    std::memcpy(&records[i * kLength + 22], &points.time[i], sizeof(double));
  }
  IntegerBiasCorrection::Layout layout;
  layout.record_length = kLength;
  layout.fields = LasRecordLayout::of(6);
  layout.metres.scale = Eigen::Vector3d::Constant(1e-3);
  layout.metres.offset = Eigen::Vector3d::Zero();
  const IntegerBiasCorrection correction(
      "bench", SystemCorrection(biases(static_cast<int>(state.range(0))), flight()), layout);
  const std::vector<std::byte> original = records;
  for (auto _ : state) {
    records = original;  // as reading a block would
    benchmark::DoNotOptimize(correction.apply(records.data(), kPoints, 0));
  }
  count(state);
}
BENCHMARK(integerRecords)->DenseRange(0, 2);

void filterCloud(benchmark::State& state) {
  const Columns points = swath(false);
  pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>);
  for (std::size_t i = 0; i < kPoints; ++i) {
    PointLidar point(static_cast<float>(points.x[i]), static_cast<float>(points.y[i]),
                     static_cast<float>(points.z[i]));
    point.gps_time = points.time[i];
    cloud->push_back(point);
  }
  SystemBiasCorrection<PointLidar> filter;
  filter.setTrajectory(flight());
  filter.setBiases(biases(2));
  filter.setNumberOfThreads(static_cast<int>(state.range(0)));
  filter.setInputCloud(cloud);
  pcl::PointCloud<PointLidar> corrected;
  for (auto _ : state) filter.filter(corrected);
  count(state);
}
BENCHMARK(filterCloud)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace pcl_als
