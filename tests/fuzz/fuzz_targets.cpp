// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_targets.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/waveform/pulse_waves_reader.h>

#include "fuzz_seeds.h"
#include "laz_codec_target.h"

namespace pcl_als::fuzz {

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

namespace {

/// A small file may hold many equal points: some are enough.
void readLaz(const LasFile& file) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 22U;
  const LasHeader& header = file.header();
  const std::uint64_t count =
      std::min<std::uint64_t>(header.point_count, most_bytes / header.record_length);
  std::vector<std::byte> records(count * header.record_length);
  file.readRecords(count / 2, count - count / 2, records.data());
  for (std::uint64_t first = 0; first < count; first += 1000)
    file.readRecords(first, std::min<std::uint64_t>(1000, count - first), records.data());
}

/// What is intact of a damaged file; a small one may announce very many points.
void readIntact(const std::filesystem::path& path) {
  constexpr std::uint64_t most = std::uint64_t{1} << 20U;
  const LasFile file(path, kLazAllFields, LasDamage::keep_intact);
  if (file.header().point_count > most || file.header().record_length > 1000) return;
  std::vector<std::byte> records;
  for (const LasRecordRange& range : file.intact().records) {
    records.resize(range.count * file.header().record_length);
    file.readRanges({range}, records.data());
  }
}

void readLas(const std::filesystem::path& path) {
  const LasFile file(path);
  for (const LasVlrEntry& vlr : file.vlrs()) file.payload(vlr);
  file.info();
  const LasHeader& header = file.header();
  if (header.compressed) return readLaz(file);
  std::vector<std::byte> records(header.point_count * header.record_length);
  file.readRecords(0, header.point_count, records.data());
  std::vector<double> values;
  for (const LasExtraField& field : file.extraFields())
    decodeLasExtraField(records.data(), header.point_count, header.record_length, field, values);
  takeInventory({path});
}

/// Windows and levels of an octree. A small file may hold many equal points: some are enough.
void readCopc(const std::filesystem::path& path) {
  const LasFile file(path);
  LasWindow coarse;
  coarse.resolution = 10.0;
  file.recordsWithin(coarse);
  for (const double size : {20.0, 400.0, 1e9}) {
    PointWindow window;
    window.bounds.emplace(Eigen::Vector2d(-size, -size), Eigen::Vector2d(size, size));
    if (file.header().point_count > std::uint64_t{1} << 20U) {
      file.recordsWithin({window.bounds, 0.0});
      continue;
    }
    const auto reader = PointReader::open(path, window);
    PointChunk chunk;
    for (int i = 0; i < 4 && reader->read(chunk); ++i) {
    }
  }
}

void readPcd(const std::filesystem::path& path) {
  loadPcd(path);
  takeInventory({path});
}

/// Points of a text or packed format, and what is told of them.
void readPoints(const std::filesystem::path& path) {
  const auto reader = PointReader::open(path);
  PointChunk chunk;
  while (reader->read(chunk)) {
  }
  reader->remarks();
  takeInventory({path});
}

/// A trajectory without its projection to a map, and with the names of its columns given.
void readExport(const std::filesystem::path& path) {
  try {
    summarize(inspectTrajectory(path, {}).accuracy);
  } catch (const Error&) {
    TrajectoryReading reading;
    reading.columns = {"time", "latitude", "longitude", "height", "roll", "pitch", "heading"};
    reading.angles = AngleUnit::gon;
    reading.leap_seconds = 18.0;
    inspectTrajectory(path, reading);
  }
}

/// Each record of a .sol has a checksum of its header: with it the rest is reached.
std::string withChecksums(std::string bytes) {
  constexpr std::size_t record = 184, header = 35;
  for (std::size_t at = 0; at + header <= bytes.size(); at += record) {
    unsigned sum = 0;
    for (std::size_t i = 0; i + 1 < header; ++i) sum ^= static_cast<unsigned char>(bytes[at + i]);
    bytes[at + header - 1] = static_cast<char>(sum);
  }
  return bytes;
}

/// The file begins with the number of bytes of the Pulse file; those of the Waves file follow it.
void readPulseWaves(const std::filesystem::path& path, const std::filesystem::path& waves) {
  constexpr std::uint64_t most = 1000;
  const std::string bytes = readWholeFile(path, kBinaryLimits);
  std::uint32_t size = 0;
  if (bytes.size() < sizeof size) return;
  std::memcpy(&size, bytes.data(), sizeof size);
  std::ofstream(path, std::ios::binary) << bytes.substr(sizeof size, size);
  std::ofstream(waves, std::ios::binary)
      << (bytes.size() - sizeof size > size ? bytes.substr(sizeof size + size) : "");
  const PulseWavesFile file(path);
  describePulseWaves(file);
  const WavesFile all(file);
  PulseWavesReader reader(all);
  std::vector<PulseRecord> pulses;
  std::vector<PulseSegment> segments;
  file.read(0, std::min(file.header().pulse_count, most), pulses);
  for (std::size_t i = 0; i < pulses.size(); ++i) reader.read(pulses[i], i, segments);
}

bool las(const std::uint8_t* data, std::size_t size) {
  return readAs(".las", data, size, readLas);
}
bool laz(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readLas);
}
bool damagedLaz(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readIntact);
}
bool copc(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readCopc);
}
bool pcd(const std::uint8_t* data, std::size_t size) {
  return readAs(".pcd", data, size, readPcd);
}
bool ply(const std::uint8_t* data, std::size_t size) {
  return readAs(".ply", data, size, readPoints);
}
bool xyz(const std::uint8_t* data, std::size_t size) {
  return readAs(".xyz", data, size, readPoints);
}
bool pulseWaves(const std::uint8_t* data, std::size_t size) {
  std::filesystem::path waves;
  const bool accepted = readAs(".pls", data, size, [&waves](const std::filesystem::path& path) {
    waves = path;
    readPulseWaves(path, waves.replace_extension(".wvs"));
  });
  std::filesystem::remove(waves);
  return accepted;
}
bool trajectoryCsv(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readTrajectory(path); });
}
bool sbet(const std::uint8_t* data, std::size_t size) {
  return readAs(".sbet", data, size, [](const auto& path) { readTrajectory(path, "EPSG:32611"); });
}
bool trajectoryExport(const std::uint8_t* data, std::size_t size) {
  return readAs(".txt", data, size, readExport);
}
bool smrmsg(const std::uint8_t* data, std::size_t size) {
  return readAs(".out", data, size, [](const auto& path) { summarize(readAccuracies(path)); });
}
bool terrascan(const std::uint8_t* data, std::size_t size) {
  return readAs(".trj", data, size, [](const auto& path) { inspectTrajectory(path, {}); });
}
bool rieglTrajectory(const std::uint8_t* data, std::size_t size) {
  return readAs(".pof", data, size, [](const auto& path) { inspectTrajectory(path, {}); });
}
bool rieglAccuracies(const std::uint8_t* data, std::size_t size) {
  return readAs(".poq", data, size, [](const auto& path) { summarize(readAccuracies(path)); });
}
bool leicaTrajectory(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = withChecksums(std::string(reinterpret_cast<const char*>(data), size));
  return readAs(".sol", reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                [](const auto& path) { inspectTrajectory(path, {}); });
}
bool control(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readControl(path); });
}
bool calibration(const std::uint8_t* data, std::size_t size) {
  return readAs(".json", data, size, [](const auto& path) { readCalibration(path); });
}
bool camera(const std::uint8_t* data, std::size_t size) {
  return readAs(".json", data, size, [](const auto& path) { readCamera(path); });
}
bool images(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readImages(path); });
}
bool imageCoordinates(const std::uint8_t* data, std::size_t size) {
  FrameCamera camera;
  camera.focal_length = 100.0;
  camera.format = {54.0, 40.0};
  return readAs(".csv", data, size, [&](const auto& path) { readMeasurements(path, camera, 0.0); });
}
bool objectLines(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readLines(path); });
}
}  // namespace

const std::vector<Target>& readerTargets() {
  static const std::vector<Target> all = {
      {"las", las, lasSeeds},
      {"laz", laz, lazSeeds},
      {"damaged_laz", damagedLaz, lazSeeds},
      {"laz_codec", lazCodec, lazChunkSeeds},
      {"copc", copc, copcSeeds},
      {"pcd", pcd, pcdSeeds},
      {"ply", ply, plySeeds},
      {"xyz", xyz, xyzSeeds},
      {"pulse_waves", pulseWaves, pulseWavesSeeds},
      {"trajectory_csv", trajectoryCsv, trajectorySeeds},
      {"trajectory_export", trajectoryExport, exportSeeds},
      {"sbet", sbet, sbetSeeds},
      {"smrmsg", smrmsg, smrmsgSeeds},
      {"terrascan", terrascan, terrascanSeeds},
      {"riegl_pof", rieglTrajectory, pofSeeds},
      {"riegl_poq", rieglAccuracies, poqSeeds},
      {"leica_sol", leicaTrajectory, solSeeds},
      {"control", control, controlSeeds},
      {"calibration", calibration, calibrationSeeds},
      {"camera", camera, cameraSeeds},
      {"images", images, imageSeeds},
      {"image_coordinates", imageCoordinates, imageCoordinateSeeds},
      {"object_lines", objectLines, objectLineSeeds},
  };
  return all;
}

}  // namespace pcl_als::fuzz
