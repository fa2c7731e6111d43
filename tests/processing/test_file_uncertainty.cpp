// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/file_correction.h>

#include "point_deviations.h"
#include "test_files.h"
#include "uncertainty_check.h"

namespace pcl_als {
namespace {

simulation::SimulationOptions realistic(std::uint64_t seed) {
  auto options = simulation::SimulationOptions::preset("small", 1.0, 0.15);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = seed;
  return options;
}

/// Two blocks, the smallest number whose means say something: errors of a trajectory are shared by
/// all points of a strip.
struct Blocks {
  test::UncertaintyTable plain, strips;
  test::NormalisedErrors path;
  DeviationSummary summary;

  Blocks() {
    for (const std::uint64_t seed : {1U, 2U}) {
      const test::UncertaintyBlock block(realistic(seed), test::scratch("point_uncertainty"));
      summary = block.add(false, ".las", plain).deviations;
      block.add(true, ".laz", strips);
      path.merge(block.trajectoryErrors());
    }
  }
};

const Blocks& blocks() {
  static const Blocks blocks;
  return blocks;
}

void expectUnity(const test::UncertaintyTable& table) {
  test::NormalisedErrors all;
  for (const auto& [key, errors] : table) all.merge(errors);
  ASSERT_GT(all.count, 10000.0);
  // The page of the benchmark has means over many blocks. Of two blocks with five strips the
  // trajectory errors leave some 15 % of chance.
  EXPECT_NEAR(all.rms(all.horizontal), 1.0, 0.35);
  EXPECT_NEAR(all.rms(all.vertical), 1.0, 0.35);
}

TEST(FileUncertainty, IsThatOfTheTrueErrors) {
  expectUnity(blocks().plain);
}

TEST(FileUncertainty, IsThatOfTheTrueErrorsWithStripCorrections) {
  expectUnity(blocks().strips);
}

TEST(FileUncertainty, OfTheCorrectedPath) {
  const test::NormalisedErrors& path = blocks().path;
  // Most of the horizontal error is that of the lever arm: two values for a block. The root mean
  // square of four normal values is within these limits in 97 % of all cases.
  EXPECT_GT(path.rms(path.horizontal), 0.3);
  EXPECT_LT(path.rms(path.horizontal), 1.7);
  EXPECT_NEAR(path.rms(path.vertical), 1.0, 0.35);
}

TEST(FileUncertainty, FindsTheSlopesOfMostPoints) {
  const DeviationSummary& summary = blocks().summary;
  EXPECT_GT(static_cast<double>(summary.on_surface), 0.7 * static_cast<double>(summary.points));
  EXPECT_EQ(summary.unknown, 0U);
  EXPECT_GT(summary.vertical, 0.01);
  EXPECT_LT(summary.vertical, 0.1);
}

/// A part of a strip of a noisy block as a file with a field of its own.
struct Part {
  std::filesystem::path folder = test::scratch("file_uncertainty");
  std::shared_ptr<const Trajectory> flight;
  CalibrationResult calibration;

  Part() {
    const simulation::Simulator simulator(realistic(3));
    flight = test::withAttitude(simulator.trajectory());
    calibration[SystemParameter::boresight_roll].bias = 1e-4;
    calibration.attitude = AttitudeSource::trajectory;
    calibration.converged = true;
    std::vector<double> own;
    PointChunk chunk;
    for (const simulation::SimulatedPoint& p : simulator.strip(0, 2)) {
      chunk.x.push_back(p.position.x());
      chunk.y.push_back(p.position.y());
      chunk.z.push_back(p.position.z());
      chunk.gps_time.push_back(p.time);
      own.push_back(static_cast<double>(own.size()));
    }
    chunk.resize(chunk.x.size());
    std::fill(chunk.return_number.begin(), chunk.return_number.end(), std::uint8_t{1});
    std::fill(chunk.number_of_returns.begin(), chunk.number_of_returns.end(), std::uint8_t{1});
    LasWriterOptions las;
    las.offset = simulator.options().origin.array().floor();
    las.time_kind = TimeKind::week_seconds;
    LasExtraField field;
    field.name = "number";
    las.extra_fields.push_back(field);
    for (const char* name : {"in.las", "in.laz"}) {
      LasWriter writer(folder / name, las);
      writer.append(chunk, {own});
      writer.finish();
    }
  }

  FileCorrectionOptions options(bool uncertainty, int threads = 2) const {
    FileCorrectionOptions how;
    how.uncertainty = uncertainty;
    how.threads = threads;
    return how;
  }
  std::vector<std::byte> corrected(const char* input, const char* output,
                                   const FileCorrectionOptions& how) const {
    correctPointFile(folder / input, folder / output, calibration, flight, how);
    return records(output);
  }
  std::vector<std::byte> records(const char* name) const {
    const LasFile file(folder / name);
    std::vector<std::byte> bytes(file.header().point_count * file.header().record_length);
    file.readRecords(0, file.header().point_count, bytes.data());
    return bytes;
  }
};

TEST(FileUncertainty, ChangesNothingElse) {
  const Part part;
  const auto plain = part.corrected("in.las", "plain.las", part.options(false));
  const auto with = part.corrected("in.las", "with.las", part.options(true));
  const LasFile a(part.folder / "plain.las"), b(part.folder / "with.las");
  const std::size_t length = a.header().record_length;
  ASSERT_EQ(b.header().record_length, length + 8);
  ASSERT_EQ(b.extraFields().size(), 3U);
  EXPECT_EQ(b.extraFields()[1].name, "sigma_horizontal");
  EXPECT_EQ(b.extraFields()[2].name, "sigma_vertical");
  EXPECT_EQ(a.header().maximum, b.header().maximum);
  for (std::size_t i = 0; i < a.header().point_count; ++i)
    ASSERT_EQ(std::memcmp(&plain[i * length], &with[i * (length + 8)], length), 0) << i;
}

TEST(FileUncertainty, IsTheSameInLazForAnyThreadsAndTwice) {
  const Part part;
  const auto with = part.corrected("in.las", "with.las", part.options(true, 1));
  EXPECT_EQ(with, part.corrected("in.laz", "with.laz", part.options(true, 4)));
  // A file that has the fields keeps its length: they are overwritten.
  FileCorrectionOptions again = part.options(true);
  again.force = true;  // the biases are removed twice
  part.corrected("with.las", "again.las", again);
  EXPECT_EQ(part.records("again.las").size(), with.size());
}

TEST(FileUncertainty, CellsHoldRootMeanSquares) {
  DeviationCells cells({0.0, 0.0}, {10.0, 10.0}, 5.0);
  cells.add({{1.0, 1.0, 0.03F, 0.01F}, {2.0, 2.0, 0.04F, 0.01F}, {8.0, 9.0, 0.05F, 0.02F}});
  const Raster raster = cells.raster();
  ASSERT_EQ(raster.grid.columns, 2);
  ASSERT_EQ(raster.grid.rows, 2);
  EXPECT_DOUBLE_EQ(raster.grid.west, 0.0);
  EXPECT_DOUBLE_EQ(raster.grid.north, 10.0);
  const RasterBand& horizontal = raster.band("sigma_horizontal");
  EXPECT_NEAR(horizontal.values[raster.grid.index(0, 1)], std::sqrt(0.00125), 1e-6);
  EXPECT_NEAR(horizontal.values[raster.grid.index(1, 0)], 0.05, 1e-6);
  EXPECT_TRUE(std::isnan(horizontal.values[raster.grid.index(0, 0)]));
  EXPECT_NEAR(raster.band("sigma_vertical").values[raster.grid.index(1, 0)], 0.02, 1e-6);
}

TEST(FileUncertainty, RefusesWhatHasNone) {
  const Part part;
  FileCorrectionOptions how = part.options(true);
  how.invert = true;
  EXPECT_THROW(part.corrected("in.las", "out.las", how), UsageError);
  EXPECT_THROW(correctPointFile(part.folder / "in.pcd", part.folder / "out.pcd", part.calibration,
                                part.flight, part.options(true)),
               UsageError);
  EXPECT_FALSE(std::filesystem::exists(part.folder / "out.las"));
}

}  // namespace
}  // namespace pcl_als
