// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Triangulation and patch search per point, against Boost.Polygon's Voronoi diagram in the same
// run. With PCL_ALS_TEST_DATA set, on a real tile too (needs xz). Results: tin.md.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <random>
#include <string>

#include <benchmark/benchmark.h>
#include <boost/polygon/voronoi.hpp>
#include <malloc.h>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/tin/patch_surface.h>

namespace {

std::atomic<std::size_t> g_held{0}, g_peak{0};

void count(void* block) {
  const std::size_t held = g_held += malloc_usable_size(block);
  if (held > g_peak) g_peak = held;
}

}  // namespace

// Every allocation of the program is counted, for the memory per point.
void* operator new(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  count(block);
  return block;
}
void operator delete(void* block) noexcept {
  if (block != nullptr) g_held -= malloc_usable_size(block);
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  operator delete(block);
}

namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

double rounded(double metres) {
  return std::round(metres * 1000.0) / 1000.0;
}

double height(double x, double y) {
  const bool roof = std::fmod(std::abs(x), 40.0) < 12.0 && std::fmod(std::abs(y), 30.0) < 10.0;
  return 3.0 * std::sin(x / 50.0) + 2.0 * std::cos(y / 40.0) +
         (roof ? 8.0 - 0.5 * std::abs(std::fmod(std::abs(x), 40.0) - 6.0) : 0.0);
}

/// \a count points of density 4 / m2 on a square, in random order.
Points uniform(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> plan(0.0, std::sqrt(static_cast<double>(count) / 4.0));
  std::normal_distribution<double> noise(0.0, 0.02);
  Points points(count);
  for (Vector3d& p : points) {
    const double x = rounded(plan(random)), y = rounded(plan(random));
    p = {x, y, height(x, y) + noise(random)};
  }
  return points;
}

/// \a count points of an oscillating mirror 540 m up, in time order: 45 kHz, 40 Hz, +-20 degrees,
/// 60 m/s; 1.9 points / m2 on average, lines almost collinear and dense at the turns of the mirror.
Points scanLines(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.02);
  Points points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / 45000.0 + 1e-5 * seed;
    const double angle = 0.35 * std::sin(2.0 * 3.14159265358979 * 40.0 * t);
    const double x = rounded(300.0 + 540.0 * std::tan(angle) + noise(random));
    const double y = rounded(60.0 * t + noise(random));
    points[i] = {x, y, height(x, y) + noise(random)};
  }
  return points;
}

/// The main strip of a tile of AHN3 over Delft, in file order; empty where it is absent.
Points delft() {
  const char* folder = std::getenv("PCL_ALS_TEST_DATA");
  if (folder == nullptr) return {};
  Points points;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(folder) / "delft_ahn3")) {
    if (entry.path().extension() != ".xz") continue;
    const auto las = std::filesystem::temp_directory_path() / entry.path().stem();
    const std::string command = "xz -dc '" + entry.path().string() + "' > '" + las.string() + "'";
    if (std::system(command.c_str()) != 0) return {};
    const auto reader = pcl_als::PointReader::open(las);
    pcl_als::PointChunk chunk;
    while (reader->read(chunk))
      for (std::size_t i = 0; i < chunk.size(); ++i)
        if (chunk.point_source_id[i] == 57139)
          points.emplace_back(chunk.x[i], chunk.y[i], chunk.z[i]);
    std::filesystem::remove(las);
  }
  return points;
}

void setPerPoint(benchmark::State& state, std::size_t points) {
  using benchmark::Counter;
  state.counters["per_point"] =
      Counter(static_cast<double>(points), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void triangulate(benchmark::State& state, const Points& points) {
  if (points.empty()) return state.SkipWithError("data absent");
  double held = 0.0, peak = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::size_t before = g_held;
    Points copy = points;
    g_peak = before;
    state.ResumeTiming();
    const pcl_als::Tin tin(std::move(copy), 0.001);
    benchmark::DoNotOptimize(tin.triangles().data());
    state.PauseTiming();
    held = static_cast<double>(g_held - before);
    peak = static_cast<double>(g_peak - before);
    state.ResumeTiming();
  }
  setPerPoint(state, points.size());
  state.counters["bytes_held"] = held / static_cast<double>(points.size());
  state.counters["bytes_peak"] = peak / static_cast<double>(points.size());
}

void voronoi(benchmark::State& state, const Points& points) {
  if (points.empty()) return state.SkipWithError("data absent");
  std::vector<boost::polygon::point_data<int>> lattice;
  for (const Vector3d& p : points)
    lattice.emplace_back(std::lround((p.x() - points[0].x()) * 1000.0),
                         std::lround((p.y() - points[0].y()) * 1000.0));
  for (auto _ : state) {
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(lattice.begin(), lattice.end(), &diagram);
    benchmark::DoNotOptimize(diagram.num_edges());
  }
  setPerPoint(state, points.size());
}

/// \param hinted: with the hint of the point before.
void closest(benchmark::State& state, const Points& points, const Points& queries, bool hinted) {
  const pcl_als::PatchSurface surface(pcl_als::Tin(points, 0.001));
  std::size_t found = 0;
  for (auto _ : state) {
    std::int32_t hint = pcl_als::Tin::kNone;
    found = 0;
    for (const Vector3d& q : queries)
      found +=
          hinted ? surface.closest(q, 0.5, hint).has_value() : surface.closest(q, 0.5).has_value();
    benchmark::DoNotOptimize(found);
  }
  setPerPoint(state, queries.size());
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(queries.size());
}

void locate(benchmark::State& state, const Points& points, const Points& queries) {
  const pcl_als::Tin tin(points, 0.001);
  for (auto _ : state)
    for (const Vector3d& q : queries) benchmark::DoNotOptimize(tin.locate(q.x(), q.y()));
  setPerPoint(state, queries.size());
}

void quality(benchmark::State& state, const Points& points) {
  const pcl_als::PatchSurface surface(pcl_als::Tin(points, 0.001));
  const std::size_t triangles = surface.tin().triangles().size();
  for (auto _ : state)
    for (std::size_t t = 0; t < triangles; ++t)
      benchmark::DoNotOptimize(surface.quality(static_cast<std::int32_t>(t)));
  setPerPoint(state, triangles);
}

void raise(Points& points, double metres) {
  for (Vector3d& p : points) p.z() += metres;
}

void registerAll() {
  constexpr std::size_t kMillion = 1000000;
  const auto add = [](const char* name, auto&& body) {
    benchmark::RegisterBenchmark(name, body)->Unit(benchmark::kMillisecond);
  };
  const auto tin = [&](const std::string& set, auto make) {
    add(("triangulate/" + set).c_str(), [=](benchmark::State& s) { triangulate(s, make()); });
    add(("voronoi_boost/" + set).c_str(), [=](benchmark::State& s) { voronoi(s, make()); });
  };
  tin("uniform_100k", [] { return uniform(kMillion / 10, 1); });
  tin("uniform_1M", [] { return uniform(kMillion, 1); });
  tin("scan_lines_100k", [] { return scanLines(kMillion / 10, 1); });
  tin("scan_lines_1M", [] { return scanLines(kMillion, 1); });
  tin("delft_593k", [] { return delft(); });
  const auto strip = [](unsigned seed) { return scanLines(kMillion, seed); };
  add("closest/scan_lines_hinted",
      [=](benchmark::State& s) { closest(s, strip(1), strip(2), true); });
  add("closest/scan_lines", [=](benchmark::State& s) { closest(s, strip(1), strip(2), false); });
  add("closest/uniform_random_order",
      [=](benchmark::State& s) { closest(s, uniform(kMillion, 1), uniform(kMillion, 2), false); });
  add("closest/scan_lines_5m_above", [=](benchmark::State& s) {
    Points queries = strip(2);
    raise(queries, 5.0);
    closest(s, strip(1), queries, true);
  });
  add("locate/scan_lines", [=](benchmark::State& s) { locate(s, strip(1), strip(2)); });
  add("quality/scan_lines", [=](benchmark::State& s) { quality(s, strip(1)); });
}

const bool g_registered = (registerAll(), true);

}  // namespace
