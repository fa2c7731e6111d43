// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/** \brief What one flight tells about the parameters of a system, in information form.
 *
 * With the estimate b of the estimated parameters and its covariance C, the information matrix is
 * C^-1 and the information vector C^-1 b; rows of parameters that do not matter are zero. Held
 * parameters h, whose possible size s the covariance includes by F diag(s^2) F' (HeldParameters),
 * are unknowns beside the others: b observes beta - F h with the covariance C - F diag(s^2) F'. The
 * information of a prior that the calibration used is taken out, so that combining missions does
 * not count it again. Internal units (m, rad, 1); b = assumed - true.
 */
struct CalibrationMission {
  std::string name;                          ///< the calibration file, for messages and tables
  std::optional<long> day;                   ///< date of the flight, days since 1980-01-06
  std::map<std::string, double> covariates;  ///< values such as the temperature, by name
  SystemMatrix information = SystemMatrix::Zero();
  SystemVector information_vector = SystemVector::Zero();
  /// A priori standard deviations of held parameters; zero for the others.
  SystemVector held_std = SystemVector::Zero();
  /// Estimates by this flight alone and their standard deviations; NaN for parameters that the
  /// flight does not determine.
  SystemVector bias, std;

  /// A priori standard deviation of a parameter: that of a held one, else the largest bias that is
  /// accepted.
  double priorStd(SystemParameter p) const {
    const double held = held_std[indexOf(p)];
    return held > 0.0 ? held : largestBias(p);
  }
  bool determines(SystemParameter p) const { return std::isfinite(std[indexOf(p)]); }
};

/** \brief The mission of a calibration.
 *
 * \param system name of the system, of a calibration with several (calibrationOfSystem(), whose
 * UsageError is thrown with \a name).
 *
 * InputError, with \a name, where the calibration has no estimated parameter, where a standard
 * deviation is not positive, or where the correlation matrix is not positive definite.
 */
CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system = {});

/// What a change of a parameter over the missions looks like.
enum class ChangeKind {
  step,    ///< another value from one mission on
  drift,   ///< proportional to the date, the number of the mission or a covariate
  outlier  ///< another value in one mission only
};
std::string_view toString(ChangeKind kind);

/// A significant change of one parameter.
struct ParameterChange {
  ChangeKind kind = ChangeKind::step;
  SystemParameter parameter = SystemParameter::boresight_roll;
  /// The last mission before a step that determines the parameter, and the first one after it; the
  /// outlier itself in both; for a drift the first and the last mission.
  std::size_t last_before = 0, first_after = 0;
  std::string covariate;  ///< of a drift: "date", "mission" (number in order) or a covariate
  /// Change of the bias across the step, of the outlier, or per unit of the covariate (day).
  double size = 0.0, std = 0.0;
  /// Probability of a change that is at least as significant anywhere in the history where nothing
  /// changes.
  double p_value = 1.0;
  /// Of a step: probability of this position among all, given that there is one.
  double position_probability = 1.0;
  /// Probability of this explanation against one where the parameter varies from mission to mission
  /// at random.
  double probability = 1.0;
};

/// A value that held over consecutive missions.
struct ParameterSegment {
  std::size_t first = 0, last = 0;  ///< missions
  double bias = 0.0, std = 0.0;
};

/// The history of one parameter; internal units.
struct ParameterHistory {
  std::size_t missions = 0;  ///< that determine the parameter; 0: nothing is known
  /// Test of constancy: sum of the squares of the deviations from the weighted mean over their
  /// variances, which has missions - 1 degrees of freedom where the parameter is constant.
  double chi_squared = 0.0;
  double p_value = 1.0;
  /// p_value exceeds the level of the test divided by the number of parameters (Bonferroni).
  bool constant = true;
  /// Standard deviation of random changes from mission to mission, which the standard deviations of
  /// the calibrations do not explain (REML); 0: none.
  double change_std = 0.0;
  std::vector<ParameterSegment> segments;  ///< between steps, in order of time
  /// Value at each mission by the model of constants, steps and drifts.
  std::vector<double> fitted;
};

/// How a mission agrees with the prediction from all others.
struct MissionAgreement {
  double chi_squared = 0.0;  ///< of the prediction error, in its covariance
  double freedom = 0.0;      ///< number of parameters that were compared; 0: no prediction
  double p_value = 1.0;
  bool agrees = true;  ///< p_value exceeds the level divided by the number of missions
  SystemParameter largest = SystemParameter::boresight_roll;  ///< with the largest deviation
  double deviation = 0.0;  ///< of that parameter, in standard deviations of its prediction error
};

struct HistoryOptions {
  /// Level of each test: of constancy over all parameters, of steps, and of missions that disagree,
  /// each over the whole history.
  double level = 0.05;
  /// Standard deviations of change between missions that are known; NaN: estimated.
  SystemVector change_std = SystemVector::Constant(std::numeric_limits<double>::quiet_NaN());

  void validate() const;  ///< UsageError for a level outside (0, 0.5) or a negative std
};

/** \brief Calibrations of one system over missions, combined by their covariances.
 *
 * Model: mission m observes b_m = beta(m) + u_m + e_m, where e_m has the covariance of the
 * calibration with all its correlations, u_m is a random change with the standard deviation
 * change_std of each parameter, independent between missions and parameters, and beta(m) is
 * constant but for significant steps, drifts and outliers. Unknowns that belong to one mission (its
 * height offset, its trajectory errors) are contained in the covariance of that mission.
 */
struct CalibrationHistory {
  /// Missions that the standard deviation of changes is estimated from at least: two have one
  /// degree of freedom.
  static constexpr std::size_t kFewestForChange = 3;

  std::vector<CalibrationMission> missions;  ///< in the order of their dates
  bool dated = false;                        ///< all missions have a date
  std::array<ParameterHistory, kSystemParameterCount> parameters;
  std::vector<ParameterChange> changes;  ///< by parameter, in order of time
  std::vector<MissionAgreement> agreement;
  /// The value from now on: at the last mission, of the estimated parameters; others are zero.
  SystemVector value = SystemVector::Zero();
  SystemMatrix covariance = SystemMatrix::Zero();

  const ParameterHistory& operator[](SystemParameter p) const { return parameters[indexOf(p)]; }
  bool knows(SystemParameter p) const { return parameters[indexOf(p)].missions > 0; }
  /// Name for tables: the date where it is known, else the name of the file.
  std::string label(std::size_t mission) const;
};

/** \brief Combines missions, given in order of time unless all have a date.
 *
 * UsageError without missions or with impossible options. One mission is its own history.
 * Significance of steps is that of the largest of all score statistics, whose distribution is
 * simulated with the covariances of the missions (deterministic seed); of outliers and drifts by
 * Bonferroni's inequality.
 */
CalibrationHistory calibrationHistory(std::vector<CalibrationMission> missions,
                                      const HistoryOptions& options = {});

/// "boresight_roll changed by 12.1 +- 1.9 arcsec between 2026-05-04 and 2026-05-09 (p < 0.001)"
std::string changeText(const CalibrationHistory& history, const ParameterChange& change);

/// The value from now on as a calibration: parameters, correlation, attitude and settings of
/// \a newest; verdict usable.
CalibrationResult pooledInstrument(const CalibrationHistory& history,
                                   const CalibrationResult& newest);

}  // namespace pcl_als
