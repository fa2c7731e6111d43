// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/io/plan_io.h>
#include <pcl_als/report/plan_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using LinesArgument = std::variant<std::filesystem::path, std::vector<StripGeometry>>;

void bindLine(py::module_& m) {
  using Line = StripGeometry;
  py::class_<Line>(
      m, "FlightLine",
      "A planned flight line, straight and level; attributes may be given as keywords.")
      .def(fromKeywords<Line>())
      .def_readwrite("id", &Line::id)
      .def_property(
          "start", [](const Line& line) { return Eigen::Vector2d(line.start); },
          [](Line& line, const Eigen::Vector2d& start) { line.start = start; },
          "east, north, m, any local frame")
      .def_property(
          "end", [](const Line& line) { return Eigen::Vector2d(line.end); },
          [](Line& line, const Eigen::Vector2d& end) { line.end = end; }, "east, north, m")
      .def_readwrite("height", &Line::height, "above mean ground, m")
      .def_readwrite("half_angle", &Line::half_angle, "half the field of view, rad")
      .def_readwrite("speed", &Line::speed, "m/s")
      .def_readwrite("density", &Line::density, "pulses per square metre");
}

/// What a planned flight will give.
struct Plan {
  std::vector<StripGeometry> lines;
  std::shared_ptr<CalibrationResult> expected;
  std::size_t control_points = 0;
  std::vector<std::string> advice;
  std::string json, text;
};

std::shared_ptr<Plan> resultOf(const FlightPlanResult& result) {
  auto plan = std::make_shared<Plan>();
  plan->lines = result.lines, plan->control_points = result.control_points;
  plan->expected = std::make_shared<CalibrationResult>(result.expected);
  plan->advice = result.observability.text();
  plan->json = planJson(result, {}), plan->text = planTables(result);
  return plan;
}

void bindResult(py::module_& m) {
  Record<Plan>(m, "PlanResult", "What a planned flight will give.")
      .field("lines", &Plan::lines)
      .field("expected", &Plan::expected,
             "standard deviations, correlations and statuses as of a calibration; biases are zero")
      .field("control_points", &Plan::control_points, "covered by a line")
      .property(
          "determined", [](const Plan& p) { return p.expected->converged; },
          "whether all requested parameters are determined")
      .field("advice", &Plan::advice,
             "weak combinations of parameters, why, and which line would help")
      .state(&Plan::json)
      .state(&Plan::text)
      .bind()
      .def(
          "to_dict", [](const Plan& p) { return parsedJson(p.json); },
          "The content of plan.json as dictionaries and lists.")
      .def("__str__", [](const Plan& p) { return p.text; });
}

StripGeometry lineOf(const FlightLineRecord& record) {
  StripGeometry line;
  line.id = record.id, line.start = record.start, line.end = record.end;
  line.height = record.height;
  line.speed = record.speed.value_or(line.speed);
  line.density = record.density.value_or(line.density);
  return line;
}

std::vector<StripGeometry> linesOf(const LinesArgument& argument) {
  if (const auto* lines = std::get_if<std::vector<StripGeometry>>(&argument)) return *lines;
  std::vector<StripGeometry> lines;
  for (const FlightLineRecord& record : readFlightLines(std::get<std::filesystem::path>(argument)))
    lines.push_back(lineOf(record));
  return lines;
}

}  // namespace

void bindPlanning(py::module_& m) {
  bindLine(m);
  bindResult(m);
  m.def(
      "plan",
      [](const LinesArgument& lines, std::size_t control, const CalibrationSettings& settings) {
        FlightPlan::Settings plan;
        plan.control_points = control;
        plan.estimate = settings.estimate;
        plan.shared_errors = settings.shared_errors;
        plan.threads = settings.threads;
        plan.noise = settings.noise;
        plan.control_sigma = settings.control_sigma;
        return runJob({}, [&](const ProgressCallback&) {
          return resultOf(FlightPlan(linesOf(lines), plan).evaluate());
        });
      },
      py::arg("lines"), py::kw_only(), py::arg("control") = 0,
      py::arg_v("settings", CalibrationSettings(), "CalibrationSettings()"),
      "Predicts the standard deviations of the parameters from a planned calibration flight, as "
      "pcl_als_plan does. lines: FlightLines, or a CSV id,x1,y1,x2,y2,height[,speed][,density]; "
      "control: number of control points, distributed over the block; settings: estimate, noise, "
      "shared_errors, control_sigma and threads are used. InputError where no two lines overlap.");
}

}  // namespace pcl_als::python
