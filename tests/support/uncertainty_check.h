// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
/** True errors of corrected points over their standard deviations, by flying height and slope, for
 * the test and the benchmark. The truth is the simulator's: the place on the surface that the pulse
 * met, which no equation of the correction or of its uncertainty takes part in. */
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/simulation/simulator.h>
#include <pcl_als/trajectory/trajectory_correction.h>

#include "simulated_survey.h"

namespace pcl_als::test {

/// Sums of squares of true errors over their standard deviations, and of standard deviations.
struct NormalisedErrors {
  double horizontal = 0.0, vertical = 0.0, count = 0.0;
  double sigma_horizontal = 0.0, sigma_vertical = 0.0;  ///< sums of variances
  double error_horizontal = 0.0, error_vertical = 0.0;  ///< sums of squares

  void add(const Eigen::Vector3d& error, double sigma_h, double sigma_v) {
    const double h = error.head<2>().squaredNorm(), v = error.z() * error.z();
    horizontal += h / (sigma_h * sigma_h);
    vertical += v / (sigma_v * sigma_v);
    sigma_horizontal += sigma_h * sigma_h;
    sigma_vertical += sigma_v * sigma_v;
    error_horizontal += h;
    error_vertical += v;
    count += 1.0;
  }
  void merge(const NormalisedErrors& other) {
    horizontal += other.horizontal, vertical += other.vertical, count += other.count;
    sigma_horizontal += other.sigma_horizontal, sigma_vertical += other.sigma_vertical;
    error_horizontal += other.error_horizontal, error_vertical += other.error_vertical;
  }
  double rms(double sum) const { return std::sqrt(sum / count); }
};

/// Flying height (m) and the upper limit of a class of slope (degrees; 90: the rest).
using UncertaintyClass = std::pair<int, int>;
using UncertaintyTable = std::map<UncertaintyClass, NormalisedErrors>;

inline std::shared_ptr<const Trajectory> withAttitude(std::vector<TrajectorySample> samples) {
  Trajectory::Options options;
  options.use_attitude = true;
  return std::make_shared<const Trajectory>(std::move(samples), options);
}

/// One simulated block, its rigorous calibration, and the corrected points of its strips.
class UncertaintyBlock {
 public:
  UncertaintyBlock(const simulation::SimulationOptions& options, std::filesystem::path folder,
                   const CalibrationSettings& settings = CalibrationSettings())
      : options_(options),
        simulator_(options),
        folder_(std::move(folder)),
        flight_(withAttitude(simulator_.trajectory())),
        calibration(SimulatedSurvey(options).calibrate(settings, true, true)) {}

  /// Corrects all strips through files, and adds the errors of their points.
  FileCorrectionResult add(bool strip_corrections, const std::string& extension,
                           UncertaintyTable& table) const {
    FileCorrectionResult result;
    for (std::size_t strip = 0; strip < simulator_.stripCount(); ++strip) {
      const std::vector<simulation::SimulatedPoint> points = simulator_.strip(strip, 2);
      const auto input = folder_ / ("strip" + extension), output = folder_ / ("out" + extension);
      write(points, input);
      FileCorrectionOptions how;
      how.strip_corrections = strip_corrections;
      how.uncertainty = true;
      how.force = true;
      how.threads = 2;
      result = correctPointFile(input, output, calibration, flight_, how);
      compare(points, output, static_cast<int>(std::lround(options_.lines[strip].height)), table);
    }
    return result;
  }

  /// Errors of the positions of the corrected trajectory, of every tenth sample.
  NormalisedErrors trajectoryErrors() const {
    SystemCorrection::Options how;
    how.strip_corrections = how.force = true;
    const CorrectedTrajectory corrected =
        correctTrajectory(simulator_.trajectory(), calibration, flight_, how);
    const std::vector<TrajectorySample> truth = simulator_.trueTrajectory();
    NormalisedErrors errors;
    for (std::size_t i = 0; i < corrected.samples.size(); i += 10) {
      const Eigen::Vector3d& std = corrected.position_std[i];
      if (!std.allFinite()) continue;
      // The true path of the reference point of which the assumed lever arm counts.
      const Eigen::Vector3d error = corrected.samples[i].position - shifted(truth[i]);
      errors.add(error, std.head<2>().norm(), std.z());
    }
    return errors;
  }

 private:
  /// A corrected sample is moved by the bias of the lever arm.
  Eigen::Vector3d shifted(const TrajectorySample& sample) const {
    return sample.position -
           groundFromBody(sample.roll, sample.pitch, sample.heading).toRotationMatrix() *
               options_.bias.head<3>();
  }

  void write(const std::vector<simulation::SimulatedPoint>& points,
             const std::filesystem::path& path) const {
    PointChunk chunk;
    chunk.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const simulation::SimulatedPoint& p = points[i];
      chunk.x[i] = p.position.x(), chunk.y[i] = p.position.y(), chunk.z[i] = p.position.z();
      chunk.gps_time[i] = p.time;
      chunk.intensity[i] = p.intensity;
      chunk.point_source_id[i] = p.strip;
      chunk.return_number[i] = p.return_number;
      chunk.number_of_returns[i] = p.number_of_returns;
      chunk.flags[i] = p.flags;
    }
    LasWriterOptions las;
    las.offset = options_.origin.array().floor();
    las.time_kind = TimeKind::week_seconds;
    LasWriter writer(path, las);
    writer.append(chunk);
    writer.finish();
  }

  /// Upper limits of the classes of slope of the true surface, degrees; 0: no plane.
  static std::vector<int> slopesOf(const std::vector<simulation::SimulatedPoint>& points) {
    const Eigen::Vector3d origin = points.front().surface;
    std::vector<Eigen::Vector3f> places;
    for (const auto& p : points) {
      if (p.return_number == p.number_of_returns)
        places.push_back((p.surface - origin).cast<float>());
    }
    LocalSurfaceSettings settings;
    settings.radius = LocalSurfaces::radiusFor(places);
    const LocalSurfaces surfaces(places, settings);
    std::vector<int> slopes;
    for (const auto& p : points) {
      slopes.push_back(0);
      if (p.return_number != p.number_of_returns) continue;
      const LocalSurface surface = surfaces.at((p.surface - origin).cast<float>());
      if (!surface.found()) continue;
      const double slope = std::acos(std::min(1.0F, surface.normal.z())) / kRadiansPerDegree;
      slopes.back() = slope < 10.0 ? 10 : slope < 25.0 ? 25 : 90;
    }
    return slopes;
  }

  void compare(const std::vector<simulation::SimulatedPoint>& points,
               const std::filesystem::path& path, int height, UncertaintyTable& table) const {
    const LasFile file(path);
    const std::size_t length = file.header().record_length, count = file.header().point_count;
    std::vector<std::byte> records(count * length);
    file.readRecords(0, count, records.data());
    std::array<std::vector<double>, 2> sigma;
    for (std::size_t k = 0; k < 2; ++k)
      decodeLasExtraField(records.data(), count, length, file.extraFields().at(k), sigma[k]);
    const LasScaling metres = file.toMetres();
    const std::vector<int> slopes = slopesOf(points);
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Matrix<std::int32_t, 3, 1> raw;
      std::memcpy(raw.data(), &records[i * length], 12);
      const Eigen::Vector3d position =
          raw.cast<double>().cwiseProduct(metres.scale) + metres.offset;
      if (slopes[i] == 0 || !std::isfinite(sigma[0][i])) continue;
      table[{height, slopes[i]}].add(position - points[i].surface, sigma[0][i], sigma[1][i]);
    }
  }

  simulation::SimulationOptions options_;
  simulation::Simulator simulator_;
  std::filesystem::path folder_;
  std::shared_ptr<const Trajectory> flight_;

 public:
  const CalibrationResult calibration;
};

}  // namespace pcl_als::test
