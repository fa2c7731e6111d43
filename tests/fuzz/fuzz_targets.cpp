// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_targets.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/las_file.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/survey_census.h>
#include <pcl_als/io/survey_io.h>

#include "fuzz_seeds.h"

namespace pcl_als::fuzz {
namespace {

/// The bytes as a file that reader is called with; only the library's own errors are swallowed.
bool readAs(const char* extension, const std::uint8_t* data, std::size_t size,
            const std::function<void(const std::filesystem::path&)>& reader) {
  static const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const auto path = folder / ("pcl_als_fuzz." + std::to_string(getpid()) + extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  bool accepted = true;
  try {
    reader(path);
  } catch (const Error&) {
    accepted = false;
  }
  std::filesystem::remove(path);
  return accepted;
}

void readLas(const std::filesystem::path& path) {
  const LasFile file(path);
  for (const LasVlrEntry& vlr : file.vlrs()) file.payload(vlr);
  file.info();
  const LasHeader& header = file.header();
  std::vector<std::byte> records(header.point_count * header.record_length);
  file.readRecords(0, header.point_count, records.data());
  std::vector<double> values;
  for (const LasExtraField& field : file.extraFields())
    decodeLasExtraField(records.data(), header.point_count, header.record_length, field, values);
  takeCensus({path});
}

void readPcd(const std::filesystem::path& path) {
  loadPcd(path);
  takeCensus({path});
}

bool las(const std::uint8_t* data, std::size_t size) {
  return readAs(".las", data, size, readLas);
}
bool pcd(const std::uint8_t* data, std::size_t size) {
  return readAs(".pcd", data, size, readPcd);
}
bool trajectoryCsv(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readTrajectory(path); });
}
bool sbet(const std::uint8_t* data, std::size_t size) {
  return readAs(".sbet", data, size, [](const auto& path) { readTrajectory(path, "EPSG:32611"); });
}
bool control(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readControl(path); });
}
bool calibration(const std::uint8_t* data, std::size_t size) {
  return readAs(".json", data, size, [](const auto& path) { readCalibration(path); });
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"las", las, lasSeeds},
      {"pcd", pcd, pcdSeeds},
      {"trajectory_csv", trajectoryCsv, trajectorySeeds},
      {"sbet", sbet, sbetSeeds},
      {"control", control, controlSeeds},
      {"calibration", calibration, calibrationSeeds},
  };
  return all;
}

const Target& targetNamed(const std::string& name) {
  for (const Target& target : targets())
    if (name == target.name) return target;
  std::abort();
}

}  // namespace pcl_als::fuzz
