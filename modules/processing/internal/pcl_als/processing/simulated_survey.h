// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/simulation/simulator.h>

namespace pcl_als {

/// Format of the strips.
struct StripFileOptions {
  std::filesystem::path folder;
  bool adjusted_time = false;  ///< adjusted standard GPS time, else seconds of the week
  bool compressed = false;     ///< .laz
  bool bias_columns = false;   ///< extra bytes with the effect of the biases
  bool error_columns = false;  ///< extra bytes with the whole error, noise included
  bool images = false;         ///< images of the block, in the folder images
  int waveform_format = 9;     ///< point format of strips with waveforms: 4, 5, 9 or 10

  std::string nameOf(std::uint16_t strip) const {
    return "strip" + std::to_string(strip) + (compressed ? ".laz" : ".las");
  }
  /// The waveforms of a strip.
  std::string packetsOf(std::uint16_t strip) const {
    return "strip" + std::to_string(strip) + ".wdp";
  }
};

/// Summary of the points that were written of one strip.
struct StripSummary {
  std::string file;
  std::uint64_t pulses = 0, points = 0;
};

/// GPS week of the simulated mission (July 2009, as the paper's).
inline constexpr int kSimulatedWeek = 1540;

/// Simulates one strip straight into its file (LAS 1.4, point format 6, 1 mm), and its waveforms
/// into the file of StripFileOptions::packetsOf() if the simulator has them.
StripSummary writeStrip(const simulation::Simulator& simulator, std::size_t strip,
                        const StripFileOptions& options, int threads,
                        const std::function<void(double share)>& progress);

/// trajectory.csv, control.csv, training.csv, checkpoints.csv; returns their counts as text.
std::string writeSurveyFiles(const simulation::Simulator& simulator,
                             const std::filesystem::path& folder);

/// truth.json: biases, noise, pairs, strips, scene.
void writeTruth(const simulation::Simulator& simulator, const std::string& noise_name,
                const StripFileOptions& options, const std::vector<StripSummary>& strips);

/** \brief Simulates a block into a folder: the strips, the files of writeSurveyFiles(), and last
 * truth.json.
 *
 * The folder is made if it is missing. UsageError where it holds strips of another block, which
 * would be taken for part of it.
 */
void simulateSurvey(const simulation::SimulationOptions& options, const std::string& noise_name,
                    const StripFileOptions& files, int threads,
                    const ProgressCallback& progress = {});

}  // namespace pcl_als
