// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_model.h>
#include <pcl_als/survey/strip_choice.h>

namespace pcl_als {

class ByteReader;
class ByteWriter;
class Communicator;

/// Options of a radiometric correction.
struct IntensitySettings {
  RadiometricModel model;
  LocalSurfaceSettings surfaces;
  double footprint_mrad = 0.3;  ///< beam divergence, which bounds the size of surfaces from below
  OverlapSettings overlaps;
  double cell = 0.0;                    ///< metres; 0: from the density of points
  std::size_t most_cells = 200000;      ///< largest number of cells for the comparison of overlaps
  std::map<std::string, double> gains;  ///< by strip: known factors of the recorded intensity
  std::map<std::string, double> pulse_rates;  ///< by strip, Hz: energy is in inverse proportion
  std::string gain_control;                   ///< name of the extra field
  std::vector<GainStep> gain_steps;
  /// Energies of echoes in place of intensities (IntensityInput::Options::echo_energy).
  bool echo_energy = false;
  /// digital number; 0: 255 for 8-bit data, else 65535; none for energies of echoes
  double saturation = 0.0;
  bool keep_uncovered = false;
  bool statistics = false;
  bool force = false;         ///< continue with a trajectory that cannot belong to the points
  bool find_surfaces = true;  ///< false: incidence angles are not needed
  StripChoice strips;         ///< points of other strips stay unchanged
  std::optional<int> gps_week;
  int threads = 0;
  /// That share the files (collective); null: one process.
  Communicator* processes = nullptr;
};

/// Counts over a file for the user.
struct IntensityCounts {
  std::array<std::uint64_t, kRadiometryStatusCount> status{};
  std::uint64_t points = 0, zeros = 0, saturated = 0;
  std::uint64_t excluded = 0;         ///< of no strip in use; not counted in any status
  std::uint64_t clipped = 0;          ///< beyond 65535 after correction: written as 65535
  std::uint64_t rounded_to_zero = 0;  ///< not 0 before, under 0.5 after
  std::vector<std::uint64_t> labels;  ///< points of each label of the strips' arrangement
  /// Points of strips in use that no trajectory covers, by label and reason.
  std::map<std::pair<std::size_t, ExclusionReason>, std::uint64_t> uncovered;
  void merge(const IntensityCounts& other);
  /// All counts, for another process.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);
};

inline constexpr double kLargestIntensity = 65535.0;  ///< that a LAS record can hold

/// Content of the output besides corrected intensities.
struct IntensityOutput {
  double scale = 1.0;         ///< on corrected intensities in the 16-bit field
  bool keep_original = true;  ///< as extra field original_intensity
  bool extra_fields = true;   ///< range, incidence_angle, and reflectance where it is known
};

}  // namespace pcl_als
