// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/history/calibration_history.h>

#include "change_detection.h"
#include "mission_variance.h"

namespace pcl_als {
namespace {

using detail::DetectedChange;
using detail::HistoryModel;
using detail::HistoryTerm;
using detail::MissionInformation;

/// Orders missions by date where all have one.
bool sortByDate(std::vector<CalibrationMission>& missions) {
  const auto is_dated = [](const CalibrationMission& mission) { return mission.day.has_value(); };
  if (!std::all_of(missions.begin(), missions.end(), is_dated)) return false;
  std::stable_sort(
      missions.begin(), missions.end(),
      [](const CalibrationMission& a, const CalibrationMission& b) { return *a.day < *b.day; });
  return true;
}

/// The test of constancy, by the standard deviations of each parameter alone.
void testConstancy(const HistoryOptions& options, CalibrationHistory& history) {
  int parameters = 0;
  for (const SystemParameterInfo& info : systemParameters()) {
    ParameterHistory& parameter =
        history.parameters[static_cast<std::size_t>(indexOf(info.parameter))];
    const int p = indexOf(info.parameter);
    double weights = 0.0, mean = 0.0;
    for (const CalibrationMission& mission : history.missions) {
      if (!mission.determines(info.parameter)) continue;
      ++parameter.missions;
      const double weight = 1.0 / (mission.std[p] * mission.std[p]);
      weights += weight;
      mean += weight * mission.bias[p];
    }
    if (parameter.missions == 0) continue;
    ++parameters;
    mean /= weights;
    for (const CalibrationMission& mission : history.missions) {
      if (!mission.determines(info.parameter)) continue;
      const double deviation = (mission.bias[p] - mean) / mission.std[p];
      parameter.chi_squared += deviation * deviation;
    }
    if (parameter.missions > 1)
      parameter.p_value =
          chiSquaredTail(parameter.chi_squared, static_cast<double>(parameter.missions) - 1.0);
  }
  for (ParameterHistory& parameter : history.parameters)
    parameter.constant = !(parameter.p_value < options.level / std::max(1, parameters));
}

std::vector<HistoryTerm> termsOf(const CalibrationHistory& history,
                                 const std::vector<DetectedChange>& changes) {
  std::vector<HistoryTerm> terms = detail::constantTerms(history.missions);
  for (const DetectedChange& change : changes) terms.push_back(change.term);
  return terms;
}

/// Sizes of the changes and values over time from the model of all of them.
void describe(const HistoryModel& model, std::vector<DetectedChange> changes,
              CalibrationHistory& history) {
  const std::size_t constants = model.terms().size() - changes.size();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(constants + i);
    changes[i].change.size = model.solution()[at];
    changes[i].change.std = std::sqrt(model.covariance()(at, at));
    history.changes.push_back(changes[i].change);
  }
  std::sort(history.changes.begin(), history.changes.end(),
            [](const ParameterChange& a, const ParameterChange& b) {
              return std::pair(a.parameter, a.first_after) < std::pair(b.parameter, b.first_after);
            });
  for (std::size_t p = 0; p < history.parameters.size(); ++p) {
    ParameterHistory& parameter = history.parameters[p];
    if (parameter.missions == 0) continue;
    const auto row = static_cast<Eigen::Index>(p);
    std::size_t first = 0;
    const auto close = [&](std::size_t last) {
      parameter.segments.push_back(
          {first, last, model.at(last)[row], std::sqrt(model.covarianceAt(last)(row, row))});
    };
    for (const ParameterChange& change : history.changes) {
      if (static_cast<std::size_t>(indexOf(change.parameter)) != p ||
          change.kind != ChangeKind::step)
        continue;
      close(change.first_after - 1);
      first = change.first_after;
    }
    close(history.missions.size() - 1);
    for (std::size_t m = 0; m < history.missions.size(); ++m)
      parameter.fitted.push_back(model.at(m)[row]);
  }
}

/// The prediction error of a mission by all others, for parameters that these determine.
MissionAgreement agreementOf(std::size_t m, const CalibrationMission& mission,
                             const MissionInformation& data,
                             const std::vector<HistoryTerm>& terms) {
  MissionInformation others = data;
  others.matrix[m].setZero();
  others.vector[m].setZero();
  std::vector<HistoryTerm> lasting;
  for (const HistoryTerm& term : terms)
    if (term.lasting) lasting.push_back(term);
  const HistoryModel model(others, lasting);
  const SystemMatrix prediction = model.covarianceAt(m);
  std::vector<int> own, compared;
  for (int p = 0; p < kSystemParameterCount; ++p)
    if (data.matrix[m](p, p) > 0.0) own.push_back(p);
  for (const int p : own) {
    const auto parameter = static_cast<SystemParameter>(p);
    const double limit = 0.01 * largestBias(parameter);
    if (mission.determines(parameter) && prediction(p, p) < limit * limit) compared.push_back(p);
  }
  MissionAgreement agreement;
  if (compared.empty()) return agreement;
  Eigen::MatrixXd information = data.matrix[m](own, own);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    information(at, at) +=
        1.0 / std::pow(mission.priorStd(static_cast<SystemParameter>(own[i])), 2);
  }
  SystemMatrix covariance = SystemMatrix::Zero();
  const Eigen::MatrixXd of_mission = inverseOfDefinite(information);
  if (of_mission.size() == 0) return agreement;
  covariance(own, own) = of_mission;
  const SystemVector bias = covariance * data.vector[m];
  const Eigen::VectorXd error = (bias - model.at(m))(compared);
  const Eigen::MatrixXd variance = (covariance + prediction)(compared, compared);
  const Eigen::VectorXd normalised = error.cwiseQuotient(variance.diagonal().cwiseSqrt());
  const Eigen::MatrixXd weight = inverseOfDefinite(variance);
  if (weight.size() == 0) return agreement;
  agreement.chi_squared = error.dot(weight * error);
  agreement.freedom = static_cast<double>(compared.size());
  agreement.p_value = chiSquaredTail(agreement.chi_squared, agreement.freedom);
  Eigen::Index largest = 0;
  normalised.cwiseAbs().maxCoeff(&largest);
  agreement.largest = static_cast<SystemParameter>(compared[static_cast<std::size_t>(largest)]);
  agreement.deviation = normalised[largest];
  return agreement;
}

std::string probabilityText(double p) {
  return p < 0.001 ? "p < 0.001" : "p = " + significantText(p, 1);
}

}  // namespace

std::string_view toString(ChangeKind kind) {
  if (kind == ChangeKind::step) return "step";
  return kind == ChangeKind::drift ? "drift" : "outlier";
}

void HistoryOptions::validate() const {
  if (!(level > 0.0 && level < 0.5)) throw UsageError("the level of tests must be in (0, 0.5)");
  for (const double std : change_std)
    if (std < 0.0 || std::isinf(std))
      throw UsageError("standard deviations of changes must not be negative");
}

std::string CalibrationHistory::label(std::size_t mission) const {
  const CalibrationMission& m = missions[mission];
  return m.day ? dateText(*m.day) : m.name;
}

CalibrationHistory calibrationHistory(std::vector<CalibrationMission> missions,
                                      const HistoryOptions& options) {
  options.validate();
  if (missions.empty()) throw UsageError("a history needs at least one calibration");
  CalibrationHistory history;
  history.dated = sortByDate(missions);
  history.missions = std::move(missions);
  testConstancy(options, history);
  std::vector<DetectedChange> changes =
      detail::detectChanges(history.missions, options, history.dated);
  const std::vector<HistoryTerm> terms = termsOf(history, changes);
  const SystemVector change_std =
      detail::changeStdByReml(history.missions, terms, options.change_std);
  const MissionInformation data = detail::informationOf(history.missions, change_std);
  const HistoryModel model(data, terms);
  for (int p = 0; p < kSystemParameterCount; ++p)
    history.parameters[static_cast<std::size_t>(p)].change_std = change_std[p];
  describe(model, std::move(changes), history);
  const std::size_t last = history.missions.size() - 1;
  history.value = model.at(last);
  history.covariance = model.covarianceAt(last);
  for (const SystemParameterInfo& info : systemParameters()) {
    if (history.knows(info.parameter)) continue;
    const int p = indexOf(info.parameter);
    history.value[p] = 0.0;
    history.covariance.row(p).setZero();
    history.covariance.col(p).setZero();
  }
  for (std::size_t m = 0; m <= last; ++m) {
    MissionAgreement agreement = agreementOf(m, history.missions[m], data, terms);
    agreement.agrees =
        !(agreement.p_value < options.level / static_cast<double>(history.missions.size()));
    history.agreement.push_back(agreement);
  }
  return history;
}

std::string changeText(const CalibrationHistory& history, const ParameterChange& change) {
  const std::string name(infoOf(change.parameter).name);
  const std::string size = valueText(change.parameter, change.size, change.std);
  const std::string probability = " (" + probabilityText(change.p_value) + ")";
  if (change.kind == ChangeKind::outlier)
    return name + " of " + history.label(change.first_after) + " differs by " + size +
           " from the other calibrations" + probability;
  if (change.kind == ChangeKind::step)
    return name + " changed by " + size + " between " + history.label(change.last_before) +
           " and " + history.label(change.first_after) + probability;
  if (change.covariate == "date") {
    const double days = static_cast<double>(*history.missions[change.first_after].day -
                                            *history.missions[change.last_before].day);
    return name + " drifts with time: " +
           valueText(change.parameter, change.size * days, change.std * days) + " over " +
           numberText(days, 0) + " days" + probability;
  }
  return name + " depends on the " + change.covariate + ": " + size + " per unit" + probability;
}

CalibrationResult pooledInstrument(const CalibrationHistory& history,
                                   const CalibrationResult& newest) {
  CalibrationResult result;
  result.system_name = newest.system_name;
  result.attitude = newest.attitude;
  result.scan_planes = newest.scan_planes;
  result.channel_field = newest.channel_field;
  result.source_scale = newest.source_scale;
  result.line_fit_half_width = newest.line_fit_half_width;
  result.crs = newest.crs;
  for (const CalibrationMission& mission : history.missions) result.inputs.push_back(mission.name);
  result.verdict.reason = "pooled from " + counted(history.missions.size(), "calibration");
  std::vector<int> known;
  for (const SystemParameterInfo& info : systemParameters()) {
    ParameterEstimate& parameter = result[info.parameter];
    const int p = indexOf(info.parameter);
    if (!history.knows(info.parameter)) {
      parameter.status = ParameterStatus::not_estimable;
      parameter.reason = "no calibration determines it";
      continue;
    }
    known.push_back(p);
    result.correlation_order.push_back(info.parameter);
    parameter.status = ParameterStatus::estimated;
    parameter.bias = history.value[p];
    parameter.std = parameter.std_formal = std::sqrt(history.covariance(p, p));
  }
  const Eigen::MatrixXd covariance = history.covariance(known, known);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  result.correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  return result;
}

}  // namespace pcl_als
