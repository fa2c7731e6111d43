// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/** \brief The estimates of one flight for the parameters of a system, in information form.
 *
 * With the estimate b of the estimated parameters and its covariance C, the information matrix is
 * C^-1 and the information vector C^-1 b; rows of parameters that have no influence are zero. Held
 * parameters h, whose uncertainty s the covariance includes by F diag(s^2) F' (HeldParameters), are
 * treated as unknowns: b observes beta - F h with the covariance C - F diag(s^2) F'. The
 * information of a prior that the calibration used is removed, so that it is not counted again when
 * missions are combined. Internal units (m, rad, 1); b = assumed - true.
 */
struct CalibrationMission {
  std::string name;                          ///< the calibration file, for messages and tables
  std::optional<long> day;                   ///< date of the flight, days since 1980-01-06
  std::map<std::string, double> covariates;  ///< values such as the temperature, by name
  SystemMatrix information = SystemMatrix::Zero();
  SystemVector information_vector = SystemVector::Zero();
  /// A priori standard deviations of held parameters; zero for other parameters.
  SystemVector held_std = SystemVector::Zero();
  /// Estimates from this flight alone and their standard deviations; NaN for parameters that the
  /// flight does not determine.
  SystemVector bias, std;

  /// A priori standard deviation of a parameter: held_std for a held parameter, else the largest
  /// bias that is accepted.
  double priorStd(SystemParameter p) const {
    const double held = held_std[indexOf(p)];
    return held > 0.0 ? held : largestBias(p);
  }
  bool determines(SystemParameter p) const { return std::isfinite(std[indexOf(p)]); }
};

/** \brief Converts a calibration to a mission.
 *
 * \param name of the calibration, for messages and tables
 * \param system name of the system if the calibration has several (calibrationOfSystem())
 *
 * UsageError if there is no such system; InputError if the calibration has no estimated parameter,
 * a standard deviation is not positive, or the correlation matrix is not positive definite. Both
 * name the calibration.
 */
CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system = {});

/// Kind of change of a parameter over the missions.
enum class ChangeKind {
  step,    ///< a different value from one mission on
  drift,   ///< a change in proportion to the date, the number of the mission or a covariate
  outlier  ///< a different value in one mission only
};
/// "step", "drift" or "outlier".
std::string_view toString(ChangeKind kind);

/// A significant change of one parameter.
struct ParameterChange {
  ChangeKind kind = ChangeKind::step;
  SystemParameter parameter = SystemParameter::boresight_roll;
  /// Indices of missions. Step: the last mission before and the first mission after it that
  /// determine the parameter. Outlier: the mission itself, twice. Drift: the first and last
  /// mission.
  std::size_t last_before = 0, first_after = 0;
  std::string covariate;  ///< of a drift: "date", "mission" (number in order) or a covariate
  /// Change of the bias by the step, of the outlier, or per unit of the covariate (date: per day).
  double size = 0.0, std = 0.0;
  /// Probability that a history without changes shows one that is at least as significant.
  double p_value = 1.0;
  /// Probability of this position of a step among all positions, given that there is a step.
  double position_probability = 1.0;
  /// Probability of this explanation against that of a random variation of the parameter from
  /// mission to mission.
  double probability = 1.0;
};

/// A value that was constant over consecutive missions, internal units.
struct ParameterSegment {
  std::size_t first = 0, last = 0;  ///< indices of missions
  double bias = 0.0, std = 0.0;
};

/// The history of one parameter; internal units.
struct ParameterHistory {
  std::size_t missions = 0;  ///< number of missions that determine the parameter
  /// Test of constancy: sum of the squared deviations from the weighted mean, each divided by its
  /// variance; chi-squared with missions - 1 degrees of freedom if the parameter is constant.
  double chi_squared = 0.0;
  double p_value = 1.0;
  /// p_value exceeds the level of the test divided by the number of parameters (Bonferroni).
  bool constant = true;
  /// Standard deviation of random changes from mission to mission that the standard deviations of
  /// the calibrations do not explain (REML); 0: none.
  double change_std = 0.0;
  std::vector<ParameterSegment> segments;  ///< between steps, in order of time
  /// Value of the model of constants, steps and drifts at each mission.
  std::vector<double> fitted;
};

/// Agreement of a mission with its prediction from all other missions.
struct MissionAgreement {
  double chi_squared = 0.0;  ///< prediction error, squared and weighted by its covariance
  double freedom = 0.0;      ///< number of parameters that were compared; 0: no prediction
  double p_value = 1.0;
  bool agrees = true;  ///< p_value exceeds the level divided by the number of missions
  /// Parameter with the largest prediction error in units of its standard deviation.
  SystemParameter largest = SystemParameter::boresight_roll;
  double deviation = 0.0;  ///< that ratio
};

/// Settings of calibrationHistory().
struct HistoryOptions {
  /// Significance level of each test over the whole history: constancy of all parameters, steps,
  /// and missions that do not agree.
  double level = 0.05;
  /// Known standard deviations of the change between missions, internal units; NaN: estimated.
  SystemVector change_std = SystemVector::Constant(std::numeric_limits<double>::quiet_NaN());

  void validate() const;  ///< UsageError for a level outside (0, 0.5) or a negative std
};

/** \brief Calibrations of one system over missions, combined by their covariances.
 *
 * Model: mission m observes b_m = beta(m) + u_m + e_m. e_m has the covariance of the calibration
 * with all its correlations. u_m is a random change with the standard deviation change_std of each
 * parameter, independent between missions and parameters. beta(m) is constant except for
 * significant steps, drifts and outliers. Unknowns of a single mission (its height offset, its
 * trajectory errors) are contained in the covariance of that mission. Internal units (m, rad, 1).
 */
struct CalibrationHistory {
  /// Smallest number of missions from which the standard deviation of changes is estimated; two
  /// missions have one degree of freedom only.
  static constexpr std::size_t kFewestForChange = 3;

  std::vector<CalibrationMission> missions;  ///< in the order of their dates
  bool dated = false;                        ///< all missions have a date
  std::array<ParameterHistory, kSystemParameterCount> parameters;
  std::vector<ParameterChange> changes;  ///< by parameter, in order of time
  std::vector<MissionAgreement> agreement;
  /// Biases to be used from now on: those of the last mission; zero for parameters that no mission
  /// determines.
  SystemVector value = SystemVector::Zero();
  SystemMatrix covariance = SystemMatrix::Zero();

  const ParameterHistory& operator[](SystemParameter p) const { return parameters[indexOf(p)]; }
  bool knows(SystemParameter p) const { return parameters[indexOf(p)].missions > 0; }
  /// Name of a mission for tables: its date if it is known, else the name of its file.
  std::string label(std::size_t mission) const;
};

/** \brief Combines missions, which must be given in order of time unless all have a date.
 *
 * UsageError without missions or for impossible options. A single mission is a valid history. The
 * significance of steps is that of the largest score statistic, whose distribution is simulated
 * with the covariances of the missions (deterministic seed); that of outliers and drifts follows
 * from Bonferroni's inequality.
 * \code
 * std::vector<pcl_als::CalibrationMission> missions;
 * for (const char* file : {"may.json", "june.json", "july.json"})
 *   missions.push_back(pcl_als::missionOf(pcl_als::readCalibration(file), file));
 * const auto history = pcl_als::calibrationHistory(std::move(missions));
 * for (const auto& change : history.changes) std::cout << changeText(history, change) << '\n';
 * \endcode
 */
CalibrationHistory calibrationHistory(std::vector<CalibrationMission> missions,
                                      const HistoryOptions& options = {});

/// A change in one line: "boresight_roll changed by 12.1 +- 1.9 arcsec between 2026-05-04 and
/// 2026-05-09 (p < 0.001)"
std::string changeText(const CalibrationHistory& history, const ParameterChange& change);

/// The biases to be used from now on as a calibration, with their correlations. Attitude source,
/// scan planes and other settings are those of \a newest; the verdict is usable.
CalibrationResult pooledInstrument(const CalibrationHistory& history,
                                   const CalibrationResult& newest);

}  // namespace pcl_als
