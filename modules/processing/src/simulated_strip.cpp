// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "simulated_strip.h"

#include <algorithm>

#include <pcl_als/crs/crs.h>

#include "simulated_waveform_file.h"

namespace pcl_als {
namespace detail {

using simulation::SimulatedPoint;
using simulation::SimulationOptions;

double timeShiftOf(const StripFileOptions& files) {
  return files.adjusted_time ? kSimulatedWeek * 604800.0 - 1e9 : 0.0;
}

LasWriterOptions stripFormat(const SimulationOptions& options, std::uint16_t strip,
                             const StripFileOptions& files) {
  LasWriterOptions las;
  las.crs = options.crs;
  las.offset = options.origin.cwiseQuotient(unitsOfCrs(las.crs).metres()).array().floor();
  las.time_kind = files.adjusted_time ? TimeKind::adjusted_standard : TimeKind::week_seconds;
  las.file_source_id = strip;
  las.system_id = "SIMULATION";
  las.generating_software = "pcl_als_simulate";
  LasExtraField reflectance;
  reflectance.name = "reflectance";
  reflectance.description = "true, diffuse, at 1064 nm";
  las.extra_fields.push_back(reflectance);
  const auto add = [&las](const char* prefix, const char* description) {
    for (const char* axis : {"x", "y", "z"}) {
      LasExtraField field;
      field.name = std::string(prefix) + axis;
      field.description = description;
      field.type = LasExtraType::i32;
      field.scale = 1e-4;
      las.extra_fields.push_back(field);
    }
  };
  if (files.bias_columns) add("bias_", "written - without systematic errors");
  if (files.error_columns) add("error_", "written - true, noise included");
  return las;
}

void fillChunk(const std::vector<SimulatedPoint>& points, double time_shift, bool few_channels,
               PointChunk& chunk) {
  chunk.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SimulatedPoint& p = points[i];
    chunk.x[i] = p.position.x();
    chunk.y[i] = p.position.y();
    chunk.z[i] = p.position.z();
    chunk.gps_time[i] = p.time + time_shift;
    chunk.intensity[i] = p.intensity;
    chunk.scan_angle[i] = p.scan_angle;
    chunk.point_source_id[i] = p.strip;
    chunk.return_number[i] = p.return_number;
    chunk.number_of_returns[i] = p.number_of_returns;
    chunk.classification[i] = p.classification;
    chunk.flags[i] = static_cast<std::uint8_t>(p.flags | (few_channels ? p.channel << 6U : 0U));
    // The scanner channel of LAS has two bits.
    chunk.user_data[i] = few_channels ? std::uint8_t{0} : p.channel;
    chunk.channel[i] = p.channel;
  }
}

std::vector<std::vector<double>> stripColumns(const std::vector<SimulatedPoint>& points,
                                              const StripFileOptions& files) {
  std::vector<std::vector<double>> columns(1);
  for (const SimulatedPoint& p : points) columns[0].push_back(p.reflectance);
  const auto add = [&](const auto& difference) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      columns.emplace_back();
      for (const SimulatedPoint& p : points) columns.back().push_back(difference(p)[axis]);
    }
  };
  using Vector = Eigen::Vector3d;
  if (files.bias_columns)
    add([](const SimulatedPoint& p) -> Vector { return p.position - p.unbiased; });
  if (files.error_columns)
    add([](const SimulatedPoint& p) -> Vector { return p.position - p.surface; });
  return columns;
}

}  // namespace detail

StripSummary writeStrip(const simulation::Simulator& simulator, std::size_t strip,
                        const StripFileOptions& options, int threads,
                        const std::function<void(double share)>& progress) {
  if (simulator.options().waveform)
    return detail::writeWaveformStrip(simulator, strip, options, threads, progress);
  const std::uint16_t id = simulator.options().lines[strip].id;
  StripSummary summary{options.nameOf(id), simulator.pulseCount(strip), 0};
  LasWriter writer(options.folder / summary.file,
                   detail::stripFormat(simulator.options(), id, options));
  const double shift = detail::timeShiftOf(options);
  PointChunk chunk;
  const double expected = static_cast<double>(summary.pulses) * 1.03;
  simulator.simulateStrip(
      strip, threads, [&](const std::vector<simulation::SimulatedPoint>& points) {
        detail::fillChunk(points, shift, simulator.options().scanner.channels <= 4, chunk);
        writer.append(chunk, detail::stripColumns(points, options));
        summary.points += points.size();
        progress(std::min(1.0, static_cast<double>(summary.points) / expected));
      });
  writer.finish();
  return summary;
}

}  // namespace pcl_als
