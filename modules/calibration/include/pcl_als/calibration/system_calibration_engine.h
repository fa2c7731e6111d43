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
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/survey/area_index.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/scanner_detection.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

class AreaMatcher;
class CalibrationReport;
enum class PointField;
struct FieldDivision;
struct OverlappingPair;
struct PriorEffect;

/// A strip as measured.
struct FlownStrip {
  std::string id;
  std::pair<double, double> span;  ///< first and last firing time, seconds
  std::size_t points = 0;
  /// Of its pairs: median height of the sensor above the patches, metres, zero without pairs;
  /// largest angle of a patch from the vertical, radians.
  double height = 0.0, half_angle = 0.0;
};

/// The last adjustment of a calibration, for further adjustments of the same block (module
/// planning).
struct AdjustedSurvey {
  std::vector<FlownStrip> strips;  ///< by the index that observations use
  WeightedObservations sample;     ///< about kRepresentative observations that represent all
  SharedErrorLevels levels;        ///< as estimated
};

/** \brief Geometric calibration of a LiDAR system (Habib et al. 2011, section 2).
 *
 * Estimates biases (assumed - true) of the system parameters from point-to-patch pairs in
 * overlapping strips (Eq. (11), both directions) and vertical control (Eq. (12)) by modified least
 * squares. In every iteration the points are reconstructed with Eq. (13) and pairs are formed anew,
 * until convergence.
 *
 * The points are read twice, in any order, so that memory depends on the chosen areas and not on
 * the size of the survey:
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
 * The scan angle is that in the plane of the pulse (ScanPlanes). Memory: 48 bytes per 10 m cell a
 * strip touches, about 200 per point in an area, 400 per pair.
 *
 * For point files there is calibrateSurvey() in module processing.
 */
class SystemCalibrationEngine {
 public:
  /// \param anchor south-west corner of the block (metres, ground frame), the origin of the grid of
  /// areas
  SystemCalibrationEngine(std::shared_ptr<const Trajectory> trajectory,
                          const CalibrationSettings& settings, const Eigen::Vector2d& anchor);
  ~SystemCalibrationEngine();
  SystemCalibrationEngine(const SystemCalibrationEngine&) = delete;
  SystemCalibrationEngine& operator=(const SystemCalibrationEngine&) = delete;

  int addStrip(const std::string& id);
  /// A surface that is held fixed, as one more strip: its points are passed to survey() and load(),
  /// their times are not used. UsageError for a standard deviation that is not positive, or a name
  /// of a strip.
  int addReference(const ReferenceSurface& surface);
  void setControl(std::vector<ControlPoint> control) { control_ = std::move(control); }
  /// Limits the pairs to these, by strip id; other strips are used for control only. UsageError
  /// from chooseAreas() for an unknown id.
  void setPairs(std::vector<std::pair<std::string, std::string>> pairs) {
    wanted_pairs_ = std::move(pairs);
  }

  /** \brief Processes that share the calibration; default: one.
   *
   * All of them call the same functions in the same order. Each passes the points of its own strips
   * to survey() and load(), all points of a strip in one process. chooseAreas() and calibrate() are
   * collective and give the same results in all: each process forms the pairs of its share of the
   * areas, for which it receives the points, and all adjust the pairs of all.
   */
  void setProcesses(Communicator* processes, const SharedItems& strips) {
    processes_ = processes;
    strip_shares_ = strips;
  }

  void survey(int strip, const LidarReturn* points, std::size_t count);
  /// InputError when no strips overlap, when a reference surface overlaps none or lies far above or
  /// below them, when control lies elsewhere, or when a strip begins before the trajectory or ends
  /// after it: such points are to be left out by the caller. Points in gaps of the trajectory are
  /// not used.
  void chooseAreas();
  void load(int strip, const LidarReturn* points, std::size_t count);
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
  /// Share of each area in the information about the parameters, sum 1; after calibrate().
  const std::vector<double>& informationShares() const { return information_; }
  /// Collective, after load(): gives each process the points of its areas.
  void shareAreas();
  std::size_t loadedPoints() const;
  std::vector<StripPair> const& pairs() const { return pairs_; }
  /// Results of the recovery of attitude, a line for each strip; after chooseAreas().
  const std::vector<std::string>& attitudeRemarks() const { return attitude_remarks_; }
  /// The trajectory that is used: after chooseAreas() with recovered attitude.
  const std::shared_ptr<const Trajectory>& trajectory() const { return trajectory_; }

 private:
  struct State;
  struct StripCorrections;

  void shareSurvey();
  bool isMine(std::size_t area) const { return area_shares_.mine(area); }
  /// Points for which patches are searched.
  struct Candidates {
    std::size_t per_strip = 0;  ///< in an area
    std::size_t pairs = 0;      ///< that all of them may form
  };
  Candidates candidatesOfStrips() const;  ///< collective
  void forOwnAreas(const std::function<void(std::size_t area)>& work) const;
  void leaveOutUnpaired();
  void leaveOutSmallStrips();
  /// Strips with times rounded to steps in which the sensor moves by more than the error of its
  /// trajectory.
  void leaveOutRoundedTimes();
  void checkTrajectory();
  /// Refuses control that is in another coordinate reference system or unit.
  void checkControl();
  void checkTimes() const;
  void recoverAttitude();
  /// Finds the planes of a scanner that has several, and whether it deflects about an axis.
  void findScanPlanes();
  void describeAttitudes();
  void useNonLinearModel(const std::string& remark);
  void choosePairs();
  void releaseMap();
  // Surfaces that are held fixed.
  bool isReference(int strip) const;
  bool isHeld(int strip) const { return held_of_[static_cast<std::size_t>(strip)] >= 0; }
  bool isHeld(const PairObservation& o) const {
    return o.a != PairObservation::kControl && (isHeld(o.a) || isHeld(o.b));
  }
  /// By strip, whether it is used and not held fixed.
  std::vector<bool> correctedStrips() const;
  /// Finds the fixed strips, and gives each held surface a system that has no unknowns.
  void holdSurfaces();
  /// Refuses reference surfaces that no strip overlaps, or that lie far from the strips.
  void checkReferences() const;
  std::string objectionTo(int reference) const;
  /// Adds the fit of the held surfaces to the result: \a after selects the values that are set.
  void addHeldFit(const std::vector<AreaObservations>& observations, const SystemVector& biases,
                  bool after, CalibrationResult& result) const;
  /// Adds the height of each held surface above the rest of the block, by an adjustment in which it
  /// is unknown, and judges it. The adjustment is restored.
  void checkHeldHeights(State& state, SharedErrors& errors, CalibrationResult& result) const;
  /// Adds to the diagnosis the causes that concern parts of the block: differences between sessions
  /// or channels, and jumps of the trajectory. The adjustment is restored.
  void diagnoseParts(State& state, SharedErrors& errors, const ScanGeometry& edge,
                     CalibrationResult& result) const;
  /// Adds constant differences between points of one strip that differ in their channel, user data
  /// or scan direction, and judges them.
  void diagnoseFields(const State& state, const ScanGeometry& edge,
                      CalibrationResult& result) const;
  /// Adds an error of the scan angle as a function of it, and judges it.
  void diagnoseAngles(const State& state, const ScanGeometry& edge,
                      CalibrationResult& result) const;
  FieldDivision divisionBy(PointField field) const;  ///< collective
  /// The pairs of the parts of divided strips, by area; misclosures are those of corrected points.
  std::vector<AreaObservations> pairsOf(const FieldDivision& division, const State& state) const;
  /// Observations as those of a block without held surfaces: these become control. Returns whether
  /// there are any.
  bool replaceHeld(std::vector<AreaObservations>& observations) const;
  /// Limits of determination for the flying height.
  void adaptLimits();
  int stripNamed(const std::string& id) const;
  /// Finds strips whose coordinates were rounded to large steps, and distributes them evenly.
  void distributeRounded();
  /// Returns the number of pairs that may be formed.
  std::size_t prepare();
  std::vector<std::vector<TimeSpan>> measuredTimes() const;  ///< by strip, in the areas
  std::vector<TimeSpan> flownTimes() const;                  ///< by strip
  /// Forms pairs with the effects of all error sources.
  void considerSources();
  /// Finds the error sources that the data support, by an adjustment with all of them, and
  /// estimates these. Returns whether they differ from those estimated before.
  bool selectSources(State& state);
  /// Adds to the covariance of the parameters the effect of error sources for which there is
  /// positive evidence, and that are not corrected because they are not supported: their mean
  /// square if present times the probability that they are.
  void allowForUndecidedSources(State& state) const;
  /// Heights of the strips, as delivered, above control points; above surfaces that are held fixed
  /// where there is no control.
  std::vector<double> heightsAboveKnown(const State& state) const;
  /// Lets the iteration begin with an offset of the block that is larger than any error of a
  /// system.
  void startWithBlockOffset(State& state);
  /// Marks the parameters that cannot be told from a height offset of the block.
  void judgeBlockOffset(const State& state, CalibrationResult& result) const;
  /// Lets the iteration continue after a change of the error sources that are estimated.
  static void continueWithSources(State& state, CalibrationResult& result);
  void formPairs(State& state);
  /// Of the strips, metres per second.
  double meanSpeed(const std::vector<TimeSpan>& spans) const;
  /// Finds whether any control point is covered by a strip, and warns where none is.
  void warnOfUncoveredControl(const State& state);
  /// Selects a reduced set of the pairs in the state that gives nearly the estimates of all.
  void selectPairs(State& state);
  void weigh(State& state) const;
  void choose(State& state) const;
  /// Chooses the parameters that all systems share, or those of the first one.
  void chooseParametersOf(State& state) const;
  /// Values of the error sources whose effects are removed from the points: those that are
  /// estimated, ranging on slopes excepted.
  static ErrorSourceVector sourcesOf(const State& state);
  /// The corrections of the solution.
  StripCorrections correctionsOf(const State& state) const;
  /// Reconstructs the points with the biases of their systems.
  void correctPoints(State& state);
  void adjust(State& state, bool estimate_components) const;
  void shrinkThreshold(State& state) const;
  /// Whether no parameter changed by more than a number of its standard deviations.
  static bool isUpdateWithin(const State& state, const SystemVector& before, double deviations);
  /// Records the last update.
  static void recordUpdate(State& state, const SystemVector& before);
  /// The parameter with the largest change relative to its standard deviation in the last
  /// iterations.
  static SystemParameter mostChangingParameter(const State& state);
  /// Whether another iteration follows. Where the limit is reached and the parameters are chosen
  /// automatically, the one that changes most is left out and the iteration continues.
  bool mayContinue(State& state, const CalibrationResult& result) const;
  void iterate(State& state, CalibrationResult& result);
  /// Iterates until convergence, also with the error sources that the data support.
  void iterateToConvergence(State& state, CalibrationResult& result);
  // Transitions between the phases of the iteration, see State::Phase.
  void openIteration(State& state, std::size_t done);
  void leaveCoarse(State& state);
  void samplePairs(State& state, std::size_t pairs);
  void formAllPairs(State& state);
  void pairAllCandidates(State& state);  ///< unless they are
  void openVarianceComponents(State& state, std::size_t done);
  void closeSelection(State& state) const;
  void closeConverged(State& state) const;
  /// The reason for which the iteration did not converge, for the verdict.
  std::string reasonNotConverged(const State& state, const CalibrationResult& result) const;
  /// Excludes a strip from the calibration.
  void leaveOut(int strip, LeftOutReason reason);
  /// The pairs of strips that were to be compared, with their height offsets.
  std::vector<OverlappingPair> overlappingPairs() const;
  /// Adds warnings of strips that do not fit the others.
  void diagnose(CalibrationResult& result) const;
  /// Moves the observations, weights and variance components out of the state.
  void keepAdjusted(State& state, const std::vector<TimeSpan>& spans);
  /// The noise of points and the sizes of the trajectory errors, as estimated.
  ErrorLevels errorLevels(const State& state) const;
  /// Adds the fits of all pairs.
  void addFits(State& state, const CalibrationReport& report, CalibrationResult& result);
  /// Names the strips that cover a target that was not located there.
  void warnOfTargets(CalibrationResult& result) const;
  /// The pairs of a control area; a target is searched for within the largest distance.
  AreaObservations matchControl(std::size_t area, double threshold) const;
  /// Adds the pairs beyond the threshold to the observations, or forms all anew where those are
  /// outdated.
  void addFarPairs(State& state);
  /// Adds the residuals of control, and the parameters that depend on contradictory control.
  void assessControl(State& state, const SharedErrors& errors, CalibrationResult& result) const;
  /// Adds warnings and the verdict. \param not_converged why the iteration did not converge
  void judge(State& state, const SharedErrors& errors, const std::vector<PriorEffect>& effects,
             const std::string& not_converged, CalibrationResult& result) const;
  /// Adds the parameters that differ between halves of the block.
  void assessParts(const State& state, CalibrationResult& result) const;

  std::shared_ptr<const Trajectory> trajectory_;
  CalibrationSettings settings_;
  AttitudeSource attitude_ = AttitudeSource::none;
  RecoveredAttitude recovered_attitude_;
  SurveyMap map_;
  TrajectoryPlausibility plausibility_;
  std::deque<AttitudeRecovery> recoveries_;  ///< by strip; empty where none is needed
  std::deque<ScannerDetection> scanners_;    ///< by strip; empty without attitude
  std::vector<std::string> ids_;
  std::vector<bool> used_;
  /// The fixed strips together, or a reference surface.
  struct HeldStrips {
    ReferenceSurface surface;
    bool is_reference = false;
  };
  std::vector<HeldStrips> held_;
  std::vector<int> held_of_;  ///< by strip: index in held_; -1: not held
  StripSystems systems_;
  std::vector<StripGroup> compared_;  ///< sessions and channels, where no systems are given
  std::vector<ControlPoint> control_;
  std::string control_remark_;    ///< why no strip covers control; empty: unknown
  bool control_covered_ = false;  ///< whether any strip has a patch at a control point
  std::vector<std::pair<std::string, std::string>> wanted_pairs_;
  std::vector<StripPair> pairs_;
  std::vector<SurveyMap::HeightOffset> pair_heights_;  ///< by pair
  std::vector<SurveyArea> areas_;
  std::size_t pair_areas_ = 0;  ///< the first ones of areas_; the others surround control points
  std::unique_ptr<AreaIndex> index_;
  std::vector<AreaMatcher> matchers_;
  std::vector<double> information_;  ///< by area
  AdjustedSurvey adjusted_;
  Warnings warnings_;
  std::vector<std::string> attitude_remarks_;
  std::vector<LeftOutPoints> left_out_;
  HeightError height_error_;  ///< of the trajectory, from recorded scan angles
  bool conical_ = false;      ///< whether the scanner is conical
  bool rosette_ = false;      ///< whether it describes rosettes
  ErrorSourceScale source_scale_;
  Communicator* processes_ = nullptr;
  SharedItems strip_shares_, area_shares_;  ///< which processes read and form pairs
  std::size_t loaded_points_ = 0;           ///< of all processes
  std::function<void(const CalibrationIteration&)> progress_;
};

}  // namespace pcl_als
