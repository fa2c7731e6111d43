// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// What normals cost: our local planes against PCL's, of the same strip with the same neighbourhood;
// and the radar equation per point.
#include <benchmark/benchmark.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <pcl_als/common/point_types.h>
#include <pcl_als/radiometry/radiometric_model.h>

#include "simulated_strips.h"

namespace {

using namespace pcl_als;

const test::SimulatedStrip& strip() {
  static const test::SimulatedStrip made = [] {
    auto options = simulation::SimulationOptions::preset("small", 1.0, 1.0);
    options.noise = simulation::NoiseOptions::named("range");
    return test::SimulatedStrips(options).strips[2];
  }();
  return made;
}

std::vector<Eigen::Vector3f> points() {
  std::vector<Eigen::Vector3f> all;
  for (const PointLidar& p : *strip().strip.cloud) all.emplace_back(p.getVector3fMap());
  return all;
}

void perPoint(benchmark::State& state, std::size_t count) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void LocalSurfacesOfAStrip(benchmark::State& state) {
  const std::vector<Eigen::Vector3f> all = points();
  std::size_t found = 0;
  for (auto _ : state) {
    const LocalSurfaces surfaces(all, LocalSurfaceSettings());
    found = 0;
    for (const Eigen::Vector3f& point : all) found += surfaces.at(point).found();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(all.size());
  perPoint(state, all.size());
}
BENCHMARK(LocalSurfacesOfAStrip)->Unit(benchmark::kMillisecond);

/// The same radius or the same mean number of neighbours; one thread.
template <bool kByRadius>
void PclNormalEstimationOmp(benchmark::State& state) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3f& p : points()) cloud->emplace_back(p.x(), p.y(), p.z());
  const double radius = LocalSurfaces::radiusFor(points());
  for (auto _ : state) {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(1);
    estimation.setInputCloud(cloud);
    if (kByRadius)
      estimation.setRadiusSearch(radius);
    else
      estimation.setKSearch(16);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    benchmark::DoNotOptimize(normals.points.data());
  }
  perPoint(state, cloud->size());
}
BENCHMARK(PclNormalEstimationOmp<true>)->Unit(benchmark::kMillisecond);
BENCHMARK(PclNormalEstimationOmp<false>)->Unit(benchmark::kMillisecond);

void RadarEquation(benchmark::State& state) {
  const RadiometricModel model = [] {
    RadiometricModel hazy;
    hazy.extinction_per_km = 0.1;
    return hazy;
  }();
  auto options = simulation::SimulationOptions::preset("small", 0.3, 0.3);
  const test::SimulatedStrips block(options);
  const RadiometricEvaluator evaluator(block.flight, model);
  LocalSurface level;
  level.normal = Eigen::Vector3f::UnitZ();
  level.support = 10;
  const Strip<PointLidar>& flown = block.strips[0].strip;
  for (auto _ : state) {
    RadiometryCursor cursor;
    double sum = 0.0;
    for (const PointLidar& p : *flown.cloud) {
      LidarReturn point;
      point.position = flown.frame.toGround(p.getVector3fMap());
      point.time = p.gps_time;
      sum += evaluator.evaluate(point, level, cursor).factor;
    }
    benchmark::DoNotOptimize(sum);
  }
  perPoint(state, flown.cloud->size());
}
BENCHMARK(RadarEquation)->Unit(benchmark::kMillisecond);

}  // namespace
