// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/survey/area_index.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/survey/time_resolution.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

class AreaMatcher;

/// A strip as it was measured.
struct FlownStrip {
  std::string id;
  std::pair<double, double> span;  ///< first and last firing time, seconds
  std::size_t points = 0;
};

/// What was adjusted last: all that another adjustment of the same block needs (module planning).
struct AdjustedSurvey {
  std::vector<FlownStrip> strips;              ///< by the index that observations use
  std::vector<AreaObservations> observations;  ///< by area
  std::vector<std::vector<double>> weights;    ///< as for Adjustment::accumulate
  SharedErrorLevels levels;                    ///< as estimated
};

/** \brief Geometric calibration of a LiDAR system (Habib et al. 2011, section 2).
 *
 * Estimates biases (assumed - true) of the system parameters from point-to-patch pairs in
 * overlapping strips (Eq. (11), both directions) and vertical control (Eq. (12)) by modified least
 * squares, reconstructing the points with Eq. (13) and pairing anew until the corrections vanish.
 *
 * The points are passed twice, in any order, so that memory depends on the areas chosen and not
 * on the survey:
 * \code
 * SystemCalibrationEngine calibration(trajectory, settings, anchor);
 * const int strip = calibration.addStrip("1");   // for every strip
 * calibration.survey(strip, points, count);      // first pass, all points
 * calibration.chooseAreas();
 * calibration.load(strip, points, count);        // second pass, all points again
 * const CalibrationResult result = calibration.calibrate();
 * \endcode
 * survey() and load() may run on several threads for different strips. With attitude in the
 * trajectory (Trajectory::Options::use_attitude) the model is the rigorous one of Eq. (1); without,
 * the quasi-rigorous one, in which pitch and crab are recovered from the points and roll is zero.
 * Assumes a linear scanner. Memory: 48 bytes per 10 m cell a strip touches, about 200 per point in
 * an area, 400 per pair.
 *
 * For point files there is calibrateSurvey() in module processing.
 */
class SystemCalibrationEngine {
 public:
  /// \param anchor south-west corner of the block (metres, ground frame), from which areas are
  /// counted
  SystemCalibrationEngine(std::shared_ptr<const Trajectory> trajectory,
                          const CalibrationSettings& settings, const Eigen::Vector2d& anchor);
  ~SystemCalibrationEngine();
  SystemCalibrationEngine(const SystemCalibrationEngine&) = delete;
  SystemCalibrationEngine& operator=(const SystemCalibrationEngine&) = delete;

  int addStrip(const std::string& id);
  void setControl(std::vector<ControlPoint> control) { control_ = std::move(control); }
  /// Limits the pairs to these, by strip id; strips in none of them are used for control only.
  /// UsageError from chooseAreas() for an unknown id.
  void setPairs(std::vector<std::pair<std::string, std::string>> pairs) {
    wanted_pairs_ = std::move(pairs);
  }

  void survey(int strip, const CalibrationPoint* points, std::size_t count);
  /// InputError when no strips overlap, or when a strip begins before the trajectory or ends after
  /// it: points that it does not cover are to be left out before. Points in its gaps are not used.
  void chooseAreas();
  void load(int strip, const CalibrationPoint* points, std::size_t count);
  /// Called after every iteration.
  void setProgress(std::function<void(const CalibrationIteration&)> progress) {
    progress_ = std::move(progress);
  }
  /// result.verdict states whether to apply it, with the reason. result.observability is left
  /// empty: see describeObservability() of module planning.
  CalibrationResult calibrate();
  /// After calibrate().
  const AdjustedSurvey& adjusted() const { return adjusted_; }
  const CalibrationSettings& settings() const { return settings_; }

  const std::vector<SurveyArea>& areas() const { return areas_; }
  /// What each area contributed to the determination, together 1; after calibrate().
  const std::vector<double>& informationShares() const { return information_; }
  std::size_t loadedPoints() const;
  std::vector<StripPair> const& pairs() const { return pairs_; }
  /// What was recovered of the attitude, a line for each strip; after chooseAreas().
  const std::vector<std::string>& attitudeRemarks() const { return attitude_remarks_; }
  /// The trajectory that is used: after chooseAreas() with recovered attitude.
  const std::shared_ptr<const Trajectory>& trajectory() const { return trajectory_; }

 private:
  struct State;

  void leaveOutUnpaired();
  void leaveOutSmallStrips();
  /// Those whose times are rounded to steps in which the sensor moves by more than a trajectory's
  /// error.
  void leaveOutRoundedTimes();
  void checkTrajectory();
  void checkTimes() const;
  void recoverAttitude();
  void describeAttitudes();
  void takeNonLinear(const std::string& remark);
  void choosePairs();
  int stripNamed(const std::string& id) const;
  void prepare();
  std::vector<std::vector<TimeSpan>> measuredTimes() const;  ///< by strip, in the areas
  void pairUp(State& state) const;
  /// Finds whether any control point is covered by a strip, and warns where none is.
  void lookAtControl(const State& state);
  /// Keeps the pairs that determine the parameters, of all that are in the state.
  void selectPairs(State& state);
  void weigh(State& state) const;
  void choose(State& state) const;
  void adjust(State& state, bool estimate_components) const;
  void shrinkThreshold(State& state) const;
  /// Whether no parameter changed by more than a number of its standard deviations.
  static bool restsWithin(const State& state, const SystemVector& before, double deviations);
  /// Records what the last update changed.
  static void recordUpdate(State& state, const SystemVector& before);
  /// The parameter that changed most in the last iterations, by its standard deviation.
  static SystemParameter mostRestless(const State& state);
  /// Whether another iteration follows. Where the limit is reached and the parameters are chosen
  /// automatically, the one that changes most is left out and the iteration continues.
  bool mayContinue(State& state, const CalibrationResult& result) const;
  void iterate(State& state, CalibrationResult& result);
  // Transitions between the phases of the iteration, see State::Phase.
  void openIteration(State& state, std::size_t done) const;
  void leaveCoarse(State& state) const;
  void pairAllCandidates(State& state) const;
  void openVarianceComponents(State& state, std::size_t done) const;
  void closeSelection(State& state) const;
  void closeConverged(State& state) const;
  /// Why the iteration did not converge, for the verdict.
  std::string whyOpen(const State& state, const CalibrationResult& result) const;
  bool hasPairs(int strip, const CalibrationResult& result) const;
  /// Why a strip that overlaps others has no pairs, for a warning; empty where it overlaps none.
  std::string lostStrip(int strip) const;
  /// Adds what is wrong with strips: those without pairs, those that do not fit the others.
  void diagnose(CalibrationResult& result) const;
  /// Moves what was adjusted out of the state.
  void keepAdjusted(State& state, const std::vector<TimeSpan>& spans);
  /// Adds what control shows, with the parameters that depend on contradictory control.
  void assessControl(State& state, const SharedErrors& errors, CalibrationResult& result) const;

  std::shared_ptr<const Trajectory> trajectory_;
  CalibrationSettings settings_;
  AttitudeSource attitude_ = AttitudeSource::none;
  RecoveredAttitude recovered_attitude_;
  SurveyMap map_;
  TrajectoryPlausibility plausibility_;
  std::deque<TimeResolution> times_;         ///< by strip
  std::deque<AttitudeRecovery> recoveries_;  ///< by strip; empty where none is wanted
  std::vector<std::string> ids_;
  std::vector<bool> used_;
  std::vector<ControlPoint> control_;
  bool control_seen_ = false;  ///< whether a strip has a patch under any of it
  std::vector<std::pair<std::string, std::string>> wanted_pairs_;
  std::vector<StripPair> pairs_;
  std::vector<SurveyArea> areas_;
  std::size_t pair_areas_ = 0;  ///< the first ones of areas_; the others surround control points
  std::unique_ptr<AreaIndex> index_;
  std::vector<AreaMatcher> matchers_;
  std::vector<double> information_;  ///< by area
  AdjustedSurvey adjusted_;
  std::vector<std::string> warnings_, attitude_remarks_;
  std::string height_error_;  ///< of the trajectory, as recorded scan angles show it
  std::function<void(const CalibrationIteration&)> progress_;
};

}  // namespace pcl_als
