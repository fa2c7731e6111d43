// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/crs/map_projection.h>
#include <pcl_als/io/trajectory_writer.h>

namespace pcl_als {
namespace {

template <std::size_t N>
void appendRecord(std::string& bytes, const std::array<double, N>& record) {
  bytes.append(reinterpret_cast<const char*>(record.data()), N * sizeof(double));
}

void appendField(std::string& line, double value, const char* format) {
  line += ',';
  if (!std::isfinite(value)) return;
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  line += text;
}

/// The velocity at a sample from its neighbours, m/s; zero across a gap.
Eigen::Vector3d velocityAt(const std::vector<TrajectorySample>& samples, std::size_t i) {
  constexpr double kLongestStep = 2.0;  // seconds
  const TrajectorySample& before = samples[i > 0 ? i - 1 : i];
  const TrajectorySample& after = samples[std::min(i + 1, samples.size() - 1)];
  const double step = after.time - before.time;
  if (!(step > 0.0) || step > kLongestStep) return Eigen::Vector3d::Zero();
  return (after.position - before.position) / step;
}

}  // namespace

void writeTrajectoryCsv(const std::filesystem::path& path,
                        const std::vector<TrajectorySample>& samples,
                        const std::vector<TrajectoryAccuracy>& accuracy, bool reconstructed) {
  const bool attitude = std::all_of(samples.begin(), samples.end(),
                                    [](const TrajectorySample& s) { return s.hasAttitude(); });
  const bool stated = !samples.empty() && accuracy.size() == samples.size();
  std::string text = "time,x,y,z";
  if (attitude) text += ",roll,pitch,heading";
  if (stated) text += ",sd_east,sd_north,sd_up";
  if (stated && attitude) text += ",sd_roll,sd_pitch,sd_heading";
  if (reconstructed) text += ",reconstructed";
  text += '\n';
  AtomicFile file(path);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TrajectorySample& sample = samples[i];
    char time[40];
    std::snprintf(time, sizeof time, "%.6f", sample.time);
    text += time;
    for (const double value : sample.position) appendField(text, value, "%.5f");
    if (attitude) {
      for (const double angle : {sample.roll, sample.pitch, sample.heading})
        appendField(text, angle / kRadiansPerDegree, "%.8f");
    }
    if (stated) {
      for (const double value : accuracy[i].position) appendField(text, value, "%.5f");
    }
    if (stated && attitude) {
      for (const double angle : accuracy[i].angles)
        appendField(text, angle / kRadiansPerDegree, "%.8f");
    }
    if (reconstructed) text += ",1";
    text += '\n';
    if (text.size() < (std::size_t{1} << 20)) continue;
    file.write(text);
    text.clear();
  }
  file.write(text);
  file.commit();
}

void writeSbet(const std::filesystem::path& path, const std::vector<TrajectorySample>& samples,
               const std::string& crs) {
  const MapProjection projection(crs);
  AtomicFile file(path);
  std::string bytes;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TrajectorySample& sample = samples[i];
    if (!sample.hasAttitude()) {
      throw InputError(path.string() +
                       ": an SBET needs roll, pitch and heading of every sample; write a CSV");
    }
    const Eigen::Vector3d geodetic = projection.unproject(sample.position);
    if (!geodetic.allFinite()) {
      throw InputError(path.string() + ": sample " + std::to_string(i + 1) +
                       " is outside the area of the CRS");
    }
    const double north = projection.project(geodetic).north_azimuth;
    const Eigen::Vector3d v = velocityAt(samples, i);
    // East and north of the grid turned to true east and north.
    const double velocity_north = v.x() * std::sin(north) + v.y() * std::cos(north);
    const double velocity_east = v.x() * std::cos(north) - v.y() * std::sin(north);
    const double heading = std::remainder(sample.heading - north, 2.0 * kPi);
    appendRecord(bytes, std::array<double, 17>{sample.time, geodetic.x(), geodetic.y(),
                                               geodetic.z(), velocity_north, -velocity_east, v.z(),
                                               sample.roll, sample.pitch, heading});
    if (bytes.size() < (std::size_t{1} << 20)) continue;
    file.write(bytes);
    bytes.clear();
  }
  file.write(bytes);
  file.commit();
}

}  // namespace pcl_als
