// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pcl_als/las/las_file.h>
#include <pcl_als/trajectory/trajectory.h>

#include "waveform_file.h"

namespace pcl_als::test {

/// The sensor of the points of a WaveformFile: 1000 m above the first sample along the pulse, on a
/// flight along y.
inline std::shared_ptr<const Trajectory> flightOfWaveforms() {
  const Eigen::Vector3d sensor =
      Eigen::Vector3d(0.0, 0.0, 500.0) + 1000.0 * Eigen::Vector3d(-0.3, 0.0, 1.0).normalized();
  std::vector<TrajectorySample> samples;
  for (int i = -100; i <= 100; ++i) {
    TrajectorySample sample;
    sample.time = LasBytes::time(0) + 0.1 * i;
    sample.position = sensor + Eigen::Vector3d(0.0, 6.0 * i, 0.0);
    samples.push_back(sample);
  }
  return std::make_shared<const Trajectory>(samples);
}

/// Range of a WaveformFile's echo from the sensor of flightOfWaveforms(), metres.
inline double rangeOfEcho(double time_samples) {
  return 1000.0 + time_samples * 1000.0 * static_cast<double>(kPulseSpeed);
}

/// All records of a file, with its extra bytes by name.
struct DecomposedFile {
  LasFile las;
  std::vector<std::byte> bytes;

  explicit DecomposedFile(const std::filesystem::path& path) : las(path) {
    bytes.resize(size() * las.header().record_length);
    las.readRecords(0, size(), bytes.data());
  }
  std::size_t size() const { return las.header().point_count; }
  const std::byte* record(std::size_t i) const { return &bytes[i * las.header().record_length]; }
  bool has(const std::string& name) const {
    return findLasExtraField(las.extraFields(), name, "output") != nullptr;
  }
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    decodeLasExtraField(bytes.data(), size(), las.header().record_length,
                        *findLasExtraField(las.extraFields(), name, "output"), values);
    return values;
  }
};

}  // namespace pcl_als::test
