// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/shared_work.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/processing/intensity_input.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>
#include <pcl_als/radiometry/reference_targets.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

/// A window with the results for its points.
struct EvaluatedWindow {
  std::size_t file = 0;
  IntensityWindow window;
  std::vector<PointRadiometry> radiometry;
  std::vector<LocalSurface> surfaces;  ///< empty where none are computed
  std::vector<int> strip;              ///< of each point; -1: of no strip in use
  std::vector<double> divisor;  ///< of each point's intensity: gains, pulse energy, gain control
};

/// Specification of the evaluation of a window.
struct WindowChoice {
  std::function<bool(double x, double y)> wanted;  ///< whether a point is evaluated; empty: all are
  const std::byte* records = nullptr;              ///< as WindowRequest
  std::size_t record_length = 0;
};

/** \brief Point files and their flight, prepared for estimation and correction.
 *
 * Of several processes each evaluates the windows of its share of the files; sums of files are
 * merged in the order of the files, so that results do not depend on the number of processes.
 * Memory: that of IntensityInput, a window for each thread, and sums for at most
 * IntensitySettings::most_cells cells.
 */
class IntensityRun {
 public:
  /// First pass over all files. InputError where they cannot be used.
  IntensityRun(const std::vector<std::string>& paths, std::shared_ptr<const Trajectory> trajectory,
               const IntensitySettings& settings);
  IntensityRun(const IntensityRun&) = delete;
  IntensityRun& operator=(const IntensityRun&) = delete;

  /// The files by the process that reads them.
  const SharedItems& shares() const { return shares_; }
  /// Names of the strips in use.
  const std::vector<std::string>& strips() const { return survey_->strips(); }
  const IntensityInput& input(std::size_t file) const { return *inputs_[file]; }
  std::size_t files() const { return inputs_.size(); }
  const IntensitySettings& settings() const { return settings_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// Warnings of the check of the trajectory.
  const Warnings& warnings() const { return warnings_; }
  const std::shared_ptr<const Trajectory>& trajectory() const { return trajectory_; }
  const TimeAlignment& timeAlignment(std::size_t file) const { return times_[file]; }
  const StripAssignment& arrangement() const { return survey_->arrangement(); }
  const PointFileSources& sources(std::size_t file) const { return survey_->files()[file].sources; }
  /// Whether each point source id of a file is one strip in use.
  bool allChosen(std::size_t file) const;
  /// The reason for which a point of a file with this time has no trajectory.
  ExclusionReason whyUncovered(std::size_t file, double time) const;
  /// The points that stay unchanged, from the counts of all files.
  std::vector<ExcludedPoints> excludedPoints(const IntensityCounts& counts) const;
  double saturation() const { return saturation_; }
  double cellSize() const { return cell_size_; }
  double radius(int strip) const { return radii_[static_cast<std::size_t>(strip)]; }

  /// Estimates the parameters that the settings request; they are used in what follows.
  OverlapResult adjust(const std::function<void(double)>& progress);
  /// Estimates the factor to reflectance, which is used in what follows.
  ReferenceResult refer(std::vector<ReferenceTarget> targets, double radius);

  void useModel(const RadiometricModel& model) { model_ = model; }
  /// Estimated gains by strip (of an earlier run).
  void useGains(const std::vector<double>& gains) { estimated_gains_ = gains; }
  void useConstant(double constant) { constant_ = constant; }
  const RadiometricModel& model() const { return model_; }
  const std::vector<double>& estimatedGains() const { return estimated_gains_; }
  /// Divisor of all intensities of a strip: known gain, pulse energy, estimated gain.
  double gain(int strip) const {
    return known_gains_[static_cast<std::size_t>(strip)] *
           estimated_gains_[static_cast<std::size_t>(strip)];
  }
  double constant() const { return constant_; }  ///< corrected intensity of reflectance 1; 0: none

  /// Calls \a each with the points of strips in use.
  void visit(std::size_t file,
             const std::function<void(int strip, const Eigen::Vector3d& place)>& each) const;
  void evaluate(std::size_t file, std::size_t window, EvaluatedWindow& out,
                const WindowChoice& choice = WindowChoice()) const;
  bool usable(float intensity) const { return intensity > 0.0F && intensity < saturation_; }

 private:
  void openFiles(const std::vector<std::string>& paths);
  void shareInputs(const std::vector<std::string>& paths);
  /// Cells of a file: sums over its windows in their order.
  RadiometricCells cellsOf(std::size_t file, const std::function<void(double)>& progress) const;
  struct Sample;  ///< a point for the check of the trajectory
  std::vector<Sample> samplesOf(std::size_t file) const;
  /// Radii of surfaces by strip, in some windows of a file.
  std::vector<std::pair<int, double>> radiiOf(std::size_t file) const;
  /// x, y, corrected intensity of points at targets.
  std::vector<Eigen::Vector3d> targetPoints(std::size_t file,
                                            const ReferenceCalibration& calibration) const;
  void alignTimes();
  void arrangeStrips(const std::vector<std::string>& paths);
  void checkTrajectory();
  /// Names strips that are certainly several flight lines.
  void warnOfLines();
  void chooseRadii();
  void chooseCells();
  WindowRequest requestFor(std::size_t file) const;
  std::map<int, LocalSurfaces> surfacesOf(const IntensityWindow& window) const;
  double knownGain(const std::string& strip) const;
  double gainControl(double value, const std::string& path) const;

  IntensitySettings settings_;
  SharedItems shares_;
  std::shared_ptr<const Trajectory> trajectory_;
  std::vector<std::unique_ptr<IntensityInput>> inputs_;
  std::vector<TimeAlignment> times_;
  std::optional<SurveyReader> survey_;  ///< with tracks only where strips are split
  std::vector<double> radii_, known_gains_, estimated_gains_;
  std::vector<std::string> remarks_;
  Warnings warnings_;
  RadiometricModel model_;
  double saturation_ = 65535.0, cell_size_ = 2.0, constant_ = 0.0;
  std::uint32_t one_cell_in_ = 1;
};

}  // namespace pcl_als
