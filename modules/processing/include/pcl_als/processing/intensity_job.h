// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/processing/batch_options.h>
#include <pcl_als/radiometry/intensity_statistics.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_model.h>
#include <pcl_als/radiometry/reference_targets.h>

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

class IntensityRun;
class Trajectory;

/// Model, gains by strip and constant that an earlier run estimated.
struct StoredRadiometry {
  RadiometricModel model;
  std::map<std::string, double> gains;
  double constant = 0.0;
  bool echo_energy = false;  ///< of energies of echoes, not of intensities
};

struct IntensityOptions {
  IntensitySettings settings;
  IntensityOutput output;
  std::optional<StoredRadiometry> stored;  ///< used instead of estimating
  std::vector<ReferenceTarget> targets;    ///< of known reflectance; may be empty
  double target_radius = 1.0;              ///< metres: points this close belong to a target
  BatchOptions batch;  ///< processes that share the files; continuation of an interrupted run

  using SeenPoint = std::function<void(int strip, const Eigen::Vector3d& place)>;
  /// Called once when the files have been read for the first time; what it returns is called with
  /// every point that is written, one at a time (pictures of a report). May be empty.
  std::function<SeenPoint(const IntensityRun& run)> observe;
};

/// Points without a usable corrected intensity: saturated, clipped or rounded to zero.
struct LostIntensities {
  static constexpr double kAll = 0.99, kMany = 0.1;  ///< shares: no result; worth a warning
  double share = 0.0;                                ///< of the points with an intensity
  std::string text;
};
LostIntensities lostIntensities(const IntensityCounts& counts);

/// Statistics of the output, for the report.
struct IntensityOutcome {
  explicit IntensityOutcome(std::size_t strips) : statistics(strips), histograms(strips) {}
  std::vector<IntensityCounts> counts;  ///< by file
  /// Of the files: what was wrong, and what was copied besides (LasRewriteResult); with their
  /// names.
  std::vector<std::string> remarks;
  IntensityStatistics statistics;
  std::vector<IntensityHistogram> histograms;
  /// Called with every point, one at a time; may be empty.
  std::function<void(int strip, const Eigen::Vector3d& place)> seen;

  void addRemarks(const std::filesystem::path& path, const std::vector<std::string>& written);
};

struct IntensityResult {
  std::vector<std::string> strips;  ///< names of the strips in use
  /// Divisor of the intensities of each strip: known gain, pulse energy and estimated gain.
  std::vector<double> gains;
  std::shared_ptr<const IntensityRun> run;  ///< the files, and the model as it was used
  IntensityOutcome outcome{0};
  std::optional<OverlapResult> overlaps;     ///< where strips were compared
  std::optional<ReferenceResult> reference;  ///< where there are targets
  std::vector<ExcludedPoints> excluded;      ///< points that stay as they are
  Warnings warnings;
  /// The reason for which the result is not reliable, in one line; empty where it is.
  std::string unreliable;

  IntensityCounts counts() const;  ///< of all files
};

/** \brief Corrects intensities of point files for range, incidence angle and atmosphere.
 *
 * Estimates gains, exponents and extinction from overlaps where IntensityOptions::settings ask for
 * it, the factor to reflectance from targets, then writes each file. Memory: that of IntensityRun.
 *
 * \param outputs a file for each of \a paths, of the same kind; each appears only when it is
 *        complete
 * \param flight whose positions the points were measured from
 *
 * UsageError for impossible options; InputError for files that cannot be used, for a stored
 * radiometry that lacks a strip, and where points have no trajectory; Cancelled.
 */
IntensityResult correctIntensity(const std::vector<std::string>& paths,
                                 const std::vector<std::string>& outputs,
                                 std::shared_ptr<const Trajectory> flight,
                                 const IntensityOptions& options = {},
                                 const ProgressCallback& progress = {});

}  // namespace pcl_als
