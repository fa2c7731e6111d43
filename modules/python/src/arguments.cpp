// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "arguments.h"

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/survey/cloud_input.h>

namespace pcl_als::python {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::unique_ptr<Survey> surveyOfStrips(const Strips& strips, int threads) {
  if (strips.empty()) throw UsageError("no points are given");
  std::vector<SurveyInput> inputs;
  for (const LidarStrip& strip : strips) {
    if (strip.id.empty()) throw UsageError("a strip needs an id");
    inputs.push_back(makeCloudInput<PointLidar>(strip.cloud, strip.frame, strip.id, {}));
  }
  return std::make_unique<Survey>(SurveyReader::ofInputs(std::move(inputs), threads));
}

/// A survey of the points; null where they are one already.
std::unique_ptr<Survey> openSurvey(const PointsArgument& points, int threads) {
  return std::visit(
      Overloaded{[](const std::reference_wrapper<Survey>&) { return std::unique_ptr<Survey>(); },
                 [&](const Strips& strips) { return surveyOfStrips(strips, threads); },
                 [&](const Files& files) {
                   return std::make_unique<Survey>(files.texts(), PointWindow(), threads);
                 }},
      points);
}

}  // namespace

std::vector<std::string> Files::texts() const {
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(path.string());
  return texts;
}

UsedSurvey::UsedSurvey(const PointsArgument& points, int threads)
    : opened_(openSurvey(points, threads)),
      survey_(opened_ ? opened_.get() : &std::get<std::reference_wrapper<Survey>>(points).get()),
      lock_(survey_->busy) {}

LoadedTrajectory flightOf(const TrajectoryArgument& argument,
                          const TrajectoryLoadingOptions& options) {
  if (const auto* files = std::get_if<Files>(&argument))
    return loadTrajectory(files->paths, options);
  return std::get<std::reference_wrapper<LoadedTrajectory>>(argument).get();
}

std::vector<ControlPoint> controlOf(const ControlArgument& argument) {
  if (const auto* path = std::get_if<std::filesystem::path>(&argument)) return readControl(*path);
  if (const auto* points = std::get_if<std::vector<ControlPoint>>(&argument)) return *points;
  return {};
}

CalibrationResult calibrationOf(const CalibrationArgument& argument) {
  if (const auto* path = std::get_if<std::filesystem::path>(&argument))
    return readCalibration(*path);
  return std::get<std::reference_wrapper<CalibrationResult>>(argument).get();
}

void addInputs(const TrajectoryArgument& flight, const ControlArgument& control,
               std::vector<std::string>& inputs) {
  if (const auto* files = std::get_if<Files>(&flight))
    for (const std::string& path : files->texts()) inputs.push_back(path);
  if (const auto* path = std::get_if<std::filesystem::path>(&control))
    inputs.push_back(path->string());
}

pybind11::object parsedJson(const std::string& text) {
  return pybind11::module_::import("json").attr("loads")(text);
}

}  // namespace pcl_als::python
