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

/// Settings of a radiometric correction.
struct IntensitySettings {
  RadiometricModel model;
  LocalSurfaceSettings surfaces;
  double footprint_mrad = 0.3;  ///< beam divergence; surfaces are not smaller than the footprint
  OverlapSettings overlaps;
  double cell = 0.0;                    ///< metres; 0: from the density of the points
  std::size_t most_cells = 200000;      ///< largest number of cells for the comparison of overlaps
  std::map<std::string, double> gains;  ///< by strip: known factors of the recorded intensity
  /// By strip: pulse repetition rates, Hz; the energy of a pulse is inversely proportional to them.
  std::map<std::string, double> pulse_rates;
  std::string gain_control;          ///< name of the extra field with the AGC value; empty: none
  std::vector<GainStep> gain_steps;  ///< receiver gain as a function of the AGC value
  /// Use energies of echoes instead of intensities (IntensityInput::Options::echo_energy).
  bool echo_energy = false;
  /// Digital number from which intensities count as saturated; 0: 255 for 8-bit data, else 65535;
  /// no limit for energies of echoes.
  double saturation = 0.0;
  bool keep_uncovered = false;  ///< keep points without trajectory unchanged
  bool statistics = false;      ///< compute statistics of the effect (IntensityStatistics)
  bool force = false;           ///< continue with a trajectory that cannot belong to the points
  bool find_surfaces = true;    ///< false: incidence angles are not needed
  StripChoice strips;           ///< points of other strips stay unchanged
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  int threads = 0;              ///< 0: all cores; the result does not depend on it
  /// The processes that share the files (collective); null: one process.
  Communicator* processes = nullptr;
};

/// Numbers of points of a file.
struct IntensityCounts {
  std::array<std::uint64_t, kRadiometryStatusCount> status{};  ///< by RadiometryStatus
  std::uint64_t points = 0, zeros = 0, saturated = 0;
  std::uint64_t excluded = 0;         ///< of strips that are not used; in no status
  std::uint64_t clipped = 0;          ///< above 65535 after correction; written as 65535
  std::uint64_t rounded_to_zero = 0;  ///< not 0 before, below 0.5 after correction
  std::vector<std::uint64_t> labels;  ///< by label (StripAssignment::labels())
  /// Points of the strips in use that the trajectory does not cover, by label and reason.
  std::map<std::pair<std::size_t, ExclusionReason>, std::uint64_t> uncovered;
  void merge(const IntensityCounts& other);
  /// Writes and reads all counts, for another process.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);
};

inline constexpr double kLargestIntensity = 65535.0;  ///< largest intensity of a LAS record

/// Content of the output besides corrected intensities.
struct IntensityOutput {
  double scale = 1.0;         ///< factor of the corrected intensities in the 16-bit field
  bool keep_original = true;  ///< add the extra field original_intensity
  bool extra_fields = true;   ///< add range, incidence_angle, and reflectance if it is known
};

class IntensityRun;
class Trajectory;

/// Result of an earlier run: model, gains by strip, and the constant to reflectance.
struct StoredRadiometry {
  RadiometricModel model;
  std::map<std::string, double> gains;
  double constant = 0.0;
  bool echo_energy = false;  ///< for energies of echoes, not for intensities
};

/// Options of correctIntensity().
struct IntensityOptions {
  IntensitySettings settings;
  IntensityOutput output;
  std::optional<StoredRadiometry> stored;  ///< is used and nothing is estimated
  std::vector<ReferenceTarget> targets;    ///< targets of known reflectance; may be empty
  double target_radius = 1.0;  ///< metres; points within this distance belong to a target
  BatchOptions batch;          ///< processes that share the files, continuation of a run

  using SeenPoint = std::function<void(int strip, const Eigen::Vector3d& place)>;
  /// Called once when the files have been read for the first time. The function that it returns is
  /// called with every point that is written (metres, ground frame), one at a time. May be empty.
  std::function<SeenPoint(const IntensityRun& run)> observe;
};

/// Points without a usable corrected intensity: saturated, clipped or rounded to zero.
struct LostIntensities {
  /// Shares from which the result is not reliable, and from which there is a warning.
  static constexpr double kAll = 0.99, kMany = 0.1;
  double share = 0.0;  ///< share of these points in the points with an intensity
  std::string text;    ///< a sentence for the user
};
LostIntensities lostIntensities(const IntensityCounts& counts);

/// Statistics of the output, for the report.
struct IntensityOutcome {
  explicit IntensityOutcome(std::size_t strips) : statistics(strips), histograms(strips) {}
  std::vector<IntensityCounts> counts;  ///< by file
  /// Faults of the files, and other files that were copied (LasRewriteResult), with their names.
  std::vector<std::string> remarks;
  IntensityStatistics statistics;
  std::vector<IntensityHistogram> histograms;
  /// Called with every point (metres, ground frame), one at a time; may be empty.
  std::function<void(int strip, const Eigen::Vector3d& place)> seen;

  void addRemarks(const std::filesystem::path& path, const std::vector<std::string>& written);
};

/// Result of correctIntensity().
struct IntensityResult {
  std::vector<std::string> strips;  ///< names of the strips in use
  /// Divisor of the intensities of each strip: known gain, pulse energy and estimated gain.
  std::vector<double> gains;
  std::shared_ptr<const IntensityRun> run;  ///< the files, and the model that was used
  IntensityOutcome outcome{0};
  std::optional<OverlapResult> overlaps;     ///< if strips were compared
  std::optional<ReferenceResult> reference;  ///< if there are targets
  std::vector<ExcludedPoints> excluded;      ///< points that were not corrected
  Warnings warnings;
  /// The reason for which the result is not reliable, in one line; empty if it is reliable.
  std::string unreliable;

  IntensityCounts counts() const;  ///< of all files
};

/** \brief Corrects intensities of point files for range, incidence angle and atmosphere.
 *
 * The equations are those of RadiometricModel (Habib et al. 2011, Eq. (35)-(36)). On request gains,
 * exponents and extinction are estimated from overlaps (IntensitySettings::overlaps) and the factor
 * to reflectance from targets; then each file is written. Memory: that of IntensityRun.
 *
 * \param outputs a file for each of \a paths, of the same kind; each appears only when it is
 *        complete
 * \param flight the trajectory from which the points were measured
 *
 * UsageError for impossible options. InputError for files that cannot be used, for stored values
 * that lack a strip, and for points without trajectory unless they are kept. Cancelled.
 * \code
 * pcl_als::IntensityOptions options;
 * options.settings.model.extinction_per_km = 0.08;
 * pcl_als::correctIntensity({"strip1.laz"}, {"normalised1.laz"}, flight, options);
 * \endcode
 */
IntensityResult correctIntensity(const std::vector<std::string>& paths,
                                 const std::vector<std::string>& outputs,
                                 std::shared_ptr<const Trajectory> flight,
                                 const IntensityOptions& options = {},
                                 const ProgressCallback& progress = {});

}  // namespace pcl_als
