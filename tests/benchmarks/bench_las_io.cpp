// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_writer.h>

namespace pcl_als {
namespace {

constexpr std::size_t kPoints = PointReader::kChunk;

PointChunk swath() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0.0, 1000.0);
  PointChunk p;
  p.resize(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    p.x[i] = 583000.0 + place(random);
    p.y[i] = 5283000.0 + place(random);
    p.z[i] = 0.1 * place(random);
    p.gps_time[i] = 3e8 + 1e-5 * static_cast<double>(i);
    p.intensity[i] = static_cast<float>(i % 4096);
    p.point_source_id[i] = 1;
    p.return_number[i] = p.number_of_returns[i] = 1;
  }
  return p;
}

LasWriterOptions optionsFor(int format) {
  LasWriterOptions options;
  options.version_minor = format >= 6 ? 4 : 3;
  options.point_format = format;
  options.offset = {583000.0, 5283000.0, 0.0};
  return options;
}

std::filesystem::path scratch(const char* name) {
  return std::filesystem::temp_directory_path() / name;
}

/// A file of about a gigabyte, format 6; written once, removed at the end.
const std::filesystem::path& largeFile() {
  static const struct File {
    std::filesystem::path path = scratch("pcl_als_bench_large.las");
    File() {
      LasWriter writer(path, optionsFor(6));
      const PointChunk p = swath();
      for (int i = 0; i < 250; ++i) writer.append(p);
      writer.finish();
    }
    ~File() { std::filesystem::remove(path); }
  } file;
  return file.path;
}

void decode(benchmark::State& state) {
  const int format = static_cast<int>(state.range(0));
  const LasRecordLayout layout = LasRecordLayout::of(format);
  const LasWriterOptions options = optionsFor(format);
  std::vector<std::byte> records(kPoints * layout.length);
  encodeLasRecords(swath(), layout.length, layout, options.scale, options.offset, 0, "",
                   records.data());
  PointChunk p;
  for (auto _ : state) {
    decodeLasRecords(records.data(), kPoints, layout.length, layout, options.scale, options.offset,
                     p);
    benchmark::DoNotOptimize(p.x.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPoints));
}
BENCHMARK(decode)->Arg(1)->Arg(3)->Arg(6)->Arg(10);

void encode(benchmark::State& state) {
  const int format = static_cast<int>(state.range(0));
  const LasRecordLayout layout = LasRecordLayout::of(format);
  const LasWriterOptions options = optionsFor(format);
  const PointChunk p = swath();
  std::vector<std::byte> records(kPoints * layout.length);
  for (auto _ : state)
    encodeLasRecords(p, layout.length, layout, options.scale, options.offset, 0, "",
                     records.data());
  state.SetItemsProcessed(state.iterations() * static_cast<long>(kPoints));
}
BENCHMARK(encode)->Arg(1)->Arg(6);

void readPoints(benchmark::State& state) {
  const auto& path = largeFile();
  std::size_t points = 0;
  for (auto _ : state) {
    const auto reader = PointReader::open(path);
    PointChunk p;
    while (reader->read(p)) points += p.size();
  }
  state.SetItemsProcessed(static_cast<long>(points));
}
BENCHMARK(readPoints)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What any program has to do: read and write the bytes, 1 MiB at a time, one thread.
void copyPlain(benchmark::State& state) {
  const auto& path = largeFile();
  const auto copy = scratch("pcl_als_bench_copy.las");
  std::vector<char> buffer(1 << 20);
  for (auto _ : state) {
    std::filesystem::remove(copy);
    const int in = open(path.c_str(), O_RDONLY);
    const int out = open(copy.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    for (ssize_t n = 0; (n = read(in, buffer.data(), buffer.size())) > 0;)
      if (write(out, buffer.data(), static_cast<std::size_t>(n)) != n) state.SkipWithError("full");
    close(in);
    close(out);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<long>(std::filesystem::file_size(path)));
  std::filesystem::remove(copy);
}
BENCHMARK(copyPlain)->Unit(benchmark::kMillisecond)->UseRealTime();

/// An edit that does nothing (0) or moves every point (1), with so many threads.
void rewrite(benchmark::State& state) {
  const auto& path = largeFile();
  const auto copy = scratch("pcl_als_bench_rewrite.las");
  const bool moves = state.range(0) != 0;
  const LasEdit edit = [moves](const LasRecordBlock& block) {
    for (std::size_t i = 0; moves && i < block.count; ++i) {
      std::byte* z = block.records + i * block.record_length + 8;
      storeLas(z, loadLas<std::int32_t>(z) + 1);
    }
  };
  for (auto _ : state) {
    std::filesystem::remove(copy);
    rewriteLas(path, copy, edit, static_cast<int>(state.range(1)));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<long>(std::filesystem::file_size(path)));
  std::filesystem::remove(copy);
}
BENCHMARK(rewrite)
    ->ArgNames({"moves", "threads"})
    ->Args({0, 1})
    ->Args({0, 2})
    ->Args({1, 1})
    ->Args({1, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace pcl_als
