// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// What it costs to eliminate the shared errors of many strips: parallel lines of 100 s, each
// overlapping the next in three areas of 100 pairs. See calibration.md.
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include <pcl_als/trajectory/scan_geometry.h>

#include "adjustment.h"

namespace {

using namespace pcl_als;

constexpr double kDuration = 100.0, kPause = 100.0;  // seconds
constexpr int kAreasPerPair = 3, kPairsPerArea = 100;

/// Every other line is flown the other way.
double timeIn(int strip, double place) {
  const double along = strip % 2 == 0 ? place : kDuration - place;
  return strip * (kDuration + kPause) + along;
}

SystemRow rowOf(int strip, double x, const Eigen::Vector3d& normal) {
  ScanGeometry geometry;
  const bool back = strip % 2 != 0;
  geometry.x = back ? -x : x;
  geometry.z = strip % 4 < 2 ? -1000.0 : -600.0;
  geometry.beta = -std::atan2(geometry.x, -geometry.z);
  if (back) geometry.rotation = Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  return normal.transpose() * designBlock(geometry);
}

std::vector<AreaObservations> block(int strips) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas;
  for (int i = 0; i < (strips - 1) * kAreasPerPair; ++i) {
    const int first = i / kAreasPerPair;
    const double place = (kDuration - 1.0) * uniform(random);
    AreaObservations& area = areas.emplace_back();
    for (int k = 0; k < kPairsPerArea; ++k) {
      PairObservation o;
      o.a = first + k % 2;
      o.b = first + 1 - k % 2;
      o.time_a = timeIn(o.a, place + 0.8 * uniform(random));
      o.time_b = timeIn(o.b, place + 0.8 * uniform(random));
      o.normal = Eigen::Vector3d(0.3 * normal(random), 0.3 * normal(random), 1.0).normalized();
      const double x = 150.0 + 50.0 * uniform(random);  // right of the first, left of the second
      o.row_a = rowOf(o.a, o.a == first ? x : -x, o.normal).cast<float>();
      o.row_b = rowOf(o.b, o.b == first ? x : -x, o.normal).cast<float>();
      o.variance = 4e-4;
      o.misclosure = 0.02 * normal(random);
      area.push_back(o);
    }
  }
  return areas;
}

void EliminateSharedErrors(benchmark::State& state) {
  const int strips = static_cast<int>(state.range(0));
  const std::vector<AreaObservations> areas = block(strips);
  std::vector<std::vector<double>> weights;
  for (const AreaObservations& area : areas) weights.emplace_back(area.size(), 1.0);
  std::vector<TimeSpan> spans;
  for (int i = 0; i < strips; ++i)
    spans.emplace_back(timeIn(i, i % 2 == 0 ? 0.0 : kDuration),
                       timeIn(i, i % 2 == 0 ? kDuration : 0.0));
  const SharedErrors errors(spans, SharedErrorModel(), observedTimes(areas, spans.size()));
  for (auto _ : state) {
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, weights);
    benchmark::DoNotOptimize(adjustment.normalOf({SystemParameter::boresight_roll}));
  }
  state.counters["knots"] = errors.knotCount();
}
BENCHMARK(EliminateSharedErrors)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
