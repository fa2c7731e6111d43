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

std::shared_ptr<Survey> surveyOfStrips(const Strips& strips, int threads) {
  if (strips.empty()) throw UsageError("no points are given");
  std::vector<SurveyInput> inputs;
  for (const auto& strip : strips) {
    if (strip->id.empty()) throw UsageError("a strip needs an id");
    inputs.push_back(makeCloudInput<PointLidar>(strip->cloud, strip->frame, strip->id, {}));
  }
  return std::make_shared<Survey>(SurveyReader::ofInputs(std::move(inputs), threads));
}

std::shared_ptr<Survey> surveyOf(const PointsArgument& points, int threads) {
  return std::visit(
      Overloaded{[](const std::shared_ptr<Survey>& survey) { return survey; },
                 [&](const Strips& strips) { return surveyOfStrips(strips, threads); },
                 [&](const Paths& paths) {
                   return std::make_shared<Survey>(SurveyReader(textsOfPaths(paths), threads));
                 },
                 [&](const std::filesystem::path& path) {
                   return std::make_shared<Survey>(SurveyReader({path.string()}, threads));
                 }},
      points);
}

}  // namespace

UsedSurvey::UsedSurvey(const PointsArgument& points, int threads)
    : survey_(surveyOf(points, threads)), lock_(survey_->busy) {}

FlightFile flightOf(const FlightArgument& argument, const FlightFileOptions& options) {
  if (const auto* flight = std::get_if<std::shared_ptr<FlightFile>>(&argument)) return **flight;
  if (const auto* path = std::get_if<std::filesystem::path>(&argument))
    return readFlight(*path, options);
  return readFlight(std::get<Paths>(argument), options);
}

std::vector<ControlPoint> controlOf(const ControlArgument& argument) {
  if (const auto* path = std::get_if<std::filesystem::path>(&argument)) return readControl(*path);
  if (const auto* points = std::get_if<std::vector<ControlPoint>>(&argument)) return *points;
  return {};
}

void addInputs(const FlightArgument& flight, const ControlArgument& control,
               std::vector<std::string>& inputs) {
  if (const auto* path = std::get_if<std::filesystem::path>(&flight))
    inputs.push_back(path->string());
  if (const auto* paths = std::get_if<Paths>(&flight))
    for (const auto& path : *paths) inputs.push_back(path.string());
  if (const auto* path = std::get_if<std::filesystem::path>(&control))
    inputs.push_back(path->string());
}

std::vector<std::string> textsOfPaths(const Paths& paths) {
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(path.string());
  return texts;
}

pybind11::object parsedJson(const std::string& text) {
  return pybind11::module_::import("json").attr("loads")(text);
}

}  // namespace pcl_als::python
