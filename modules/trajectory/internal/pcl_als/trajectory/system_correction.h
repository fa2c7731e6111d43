// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/recovered_attitude.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/trajectory/coverage_count.h>
#include <pcl_als/trajectory/point_columns.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

class BiasEvaluator;

namespace detail {
class SourceCorrection;
}

/** \brief Corrects points by a calibration: the one class that applies model, attitude, biases,
 * error sources, strip corrections, systems and alignment of times, for every consumer.
 *
 * \code
 * const pcl_als::SystemCorrection correction(calibration, pcl_als::readTrajectory("flight.csv"));
 * \endcode
 *
 * corrected = biased - A(biased) delta (Habib et al. 2011, Eq. (13), not linearised), with the
 * attitude by which the calibration was estimated: that of the trajectory, nominal, none, or the
 * pitch and crab that the calibration recovered from its points
 * (CalibrationResult::recovered_attitude). The correction of a point depends on the point, the
 * calibration and the flight only.
 *
 * Const member functions may be called from several threads. A copy shares the flight.
 */
class SystemCorrection {
 public:
  struct Options {
    bool strip_corrections = false;  ///< correct the estimated errors of the trajectory as well
    bool invert = false;             ///< apply the biases instead of removing them
    bool force = false;              ///< accept a calibration whose verdict is not usable
    /// Pitch and crab at times of which the calibration has none (other flights, files of earlier
    /// versions): AttitudeRecovery::Outcome::attitude.
    RecoveredAttitude fallback_attitude;
  };

  /// \a samples: the trajectory as delivered, with attitude where it has one. UsageError for a
  /// calibration that should not be applied or has implausible values; InputError for one without
  /// the strip corrections or the recovered attitude that the correction needs, and for samples
  /// without the attitude that it needs.
  SystemCorrection(const CalibrationResult& calibration, std::vector<TrajectorySample> samples,
                   const Options& options);
  SystemCorrection(const CalibrationResult& calibration, std::vector<TrajectorySample> samples)
      : SystemCorrection(calibration, std::move(samples), Options()) {}
  /// The same with a trajectory that others use as well. Whatever its options were, the correction
  /// uses the line fit, attitude and scan planes of the calibration; only where this was estimated
  /// with the attitude of the trajectory, \a flight needs to have it.
  SystemCorrection(const CalibrationResult& calibration, std::shared_ptr<const Trajectory> flight,
                   const Options& options);
  SystemCorrection(const CalibrationResult& calibration, std::shared_ptr<const Trajectory> flight)
      : SystemCorrection(calibration, std::move(flight), Options()) {}
  /// Corrects biases (assumed - true; m, rad, 1) alone, with the attitude of \a flight.
  SystemCorrection(const SystemVector& biases, std::shared_ptr<const Trajectory> flight,
                   bool invert = false);

  /// UsageError with the reason where the verdict of a calibration is not usable.
  static void requireUsable(const CalibrationResult& calibration);

  /// That the flight is not the one that was calibrated with (isOfAnotherFlight()), so that what
  /// the calibration holds of its own flight is not used, in a sentence; empty: it is the same, or
  /// the calibration holds nothing of one.
  const std::string& flightRemark() const { return flight_remark_; }

  /// The flight with the attitude that is used.
  const std::shared_ptr<const Trajectory>& flight() const { return flight_; }
  bool inverted() const { return invert_; }

  /// Conversion of the times of points to those of the flight; default: they are the same.
  void setTimeAlignment(TimeAlignment alignment) { alignment_ = std::move(alignment); }
  const TimeAlignment& timeAlignment() const { return alignment_; }
  double flightTime(double point_time) const { return alignment_(point_time); }

  /// The systems of the calibration.
  const SystemLookup& systems() const { return systems_; }
  /// Id of the strip of points without a point source id.
  void setStrip(const std::string& strip) { systems_.setStrip(strip); }

  /// Whether the attitude at a time of the flight is known; true for models without attitude.
  bool knowsAttitude(double flight_time) const;

  /// The displacements that correct the points, metres. Times are those of the flight
  /// (flightTime()). Points without trajectory or attitude are counted, and their displacement is
  /// zero, as is that of points of strips that the calibration held fixed. Input and output columns
  /// of an axis may be the same. UsageError for columns that lack what the calibration needs
  /// (SystemLookup::objection(), intensities, scan directions); InputError for points that belong
  /// to none of its systems.
  void change(const PointColumns& points, std::size_t count, const EffectColumns& change,
              CoverageCount& coverage) const;

 private:
  /// What the calibration and the options state of a flight between two times.
  void takeOptions(const CalibrationResult& calibration, double from, double to,
                   const Options& options);
  /// The trajectory as the calibration uses it; \a half_width where this states no line fit.
  Trajectory::Options modelOf(const CalibrationResult& calibration, double half_width) const;
  void addEvaluators(const CalibrationResult& calibration, bool strip_corrections);

  /// One of the systems of the calibration.
  struct System {
    std::shared_ptr<const BiasEvaluator> evaluator;
    Eigen::Vector3d offset;  ///< of the coordinates, metres
  };
  /// The displacements of points of one system.
  void changeOf(const System& system, const PointColumns& points, std::size_t count,
                const EffectColumns& change, CoverageCount& coverage) const;
  /// The indices of points by system; those of fixed strips are the last.
  std::vector<std::vector<std::size_t>> bySystem(const PointColumns& points,
                                                 std::size_t count) const;
  /// The displacements of points of several systems, one after the other.
  void changeBySystem(const PointColumns& points, std::size_t count, const EffectColumns& change,
                      CoverageCount& coverage) const;
  /// The displacement is zero where the attitude is not known.
  void keepUnknown(const PointColumns& points, std::size_t count, const EffectColumns& change,
                   CoverageCount& coverage) const;

  std::shared_ptr<const Trajectory> flight_;
  std::string flight_remark_;
  RecoveredAttitude attitude_;
  bool needs_recovered_ = false;  ///< the model's attitude is that of attitude_
  bool invert_ = false;
  TimeAlignment alignment_;
  std::vector<System> evaluators_;  ///< by system
  SystemLookup systems_;
  std::shared_ptr<const detail::SourceCorrection> sources_;  ///< null: none
};

}  // namespace pcl_als
