// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>

#include <pybind11/eigen.h>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/report/calibration_tables.h>

#include "arguments.h"
#include "bindings.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// A dictionary with a type of its values, for signatures.
class ParameterDict : public py::dict {
  using py::dict::dict;
};

}  // namespace
}  // namespace pcl_als::python

template <>
struct pybind11::detail::handle_type_name<pcl_als::python::ParameterDict> {
  static constexpr auto name = const_name("Dict[str, pcl_als.Parameter]");
};

namespace pcl_als::python {
namespace {

/// A parameter in the unit of interfaces.
struct Parameter {
  std::string name, unit, status, reason;
  double bias = 0.0, std = 0.0, std_formal = 0.0;
};

using Estimates = std::array<ParameterEstimate, kSystemParameterCount>;

/// By name, in the order of SystemParameter.
ParameterDict parametersOf(const Estimates& estimates) {
  ParameterDict parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate =
        estimates[static_cast<std::size_t>(indexOf(info.parameter))];
    Parameter parameter;
    parameter.name = info.name, parameter.unit = info.unit;
    parameter.status = toString(estimate.status), parameter.reason = estimate.reason;
    parameter.bias = estimate.bias / info.internal_per_unit;
    parameter.std = estimate.std / info.internal_per_unit;
    parameter.std_formal = estimate.std_formal / info.internal_per_unit;
    parameters[py::str(parameter.name)] = parameter;
  }
  return parameters;
}

std::vector<std::string> correlationOrder(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const SystemParameter parameter : result.correlation_order)
    names.emplace_back(infoOf(parameter).name);
  return names;
}

void bindParameter(py::module_& m) {
  py::class_<Parameter>(m, "Parameter", "A system parameter of a calibration.")
      .def_readonly("name", &Parameter::name)
      .def_readonly("unit", &Parameter::unit, "of bias, std and std_formal: 'm', 'arcsec' or '1'")
      .def_readonly("bias", &Parameter::bias, "assumed - true")
      .def_readonly("std", &Parameter::std, "standard deviation, with the errors that pairs share")
      .def_readonly("std_formal", &Parameter::std_formal,
                    "standard deviation from the noise of points alone (Habib et al. 2011, Eq. 26)")
      .def_readonly("status", &Parameter::status, "'estimated', 'fixed' or 'not_estimable'")
      .def_readonly("reason", &Parameter::reason, "why it is not estimated; else empty")
      .def("__repr__", [](const Parameter& p) {
        return py::str("<pcl_als.Parameter {} {:.6g} {} (std {:.2g}, {})>")
            .format(p.name, p.bias, p.unit, p.std, p.status);
      });
}

void bindVerdict(py::module_& m) {
  py::class_<CalibrationVerdict>(m, "CalibrationVerdict", "Whether a calibration may be applied.")
      .def_property_readonly(
          "status",
          [](const CalibrationVerdict& verdict) { return std::string(toString(verdict.status)); },
          "'usable', 'parameters_affected', 'no_improvement', 'not_determined' or 'not_converged'")
      .def_readonly("reason", &CalibrationVerdict::reason)
      .def_property_readonly("usable", &CalibrationVerdict::usable)
      .def("__str__", &CalibrationVerdict::text);
  py::class_<MisfitChange>(m, "MisfitChange",
                           "Misfit of overlapping strips before and after, at the same points, "
                           "along the normals; m.")
      .def_readonly("points", &MisfitChange::points)
      .def_readonly("rms_before", &MisfitChange::rms_before)
      .def_readonly("rms_after", &MisfitChange::rms_after)
      .def_readonly("change_std", &MisfitChange::change_std,
                    "standard deviation of the change of the RMS");
}

void bindFits(py::module_& m) {
  py::class_<PairFit>(m, "PairFit",
                      "Normal distances of the points of a pair of strips to the patches of the "
                      "other strip; m.")
      .def_readonly("a", &PairFit::a)
      .def_readonly("b", &PairFit::b)
      .def_readonly("correspondences", &PairFit::correspondences)
      .def_readonly("rms_before", &PairFit::rms_before)
      .def_readonly("rms_after", &PairFit::rms_after)
      .def_readonly("mean_before", &PairFit::mean_before)
      .def_readonly("mean_after", &PairFit::mean_after);
  py::class_<ControlFit>(m, "ControlFit", "Heights of a strip above control points; m.")
      .def_readonly("strip", &ControlFit::strip)
      .def_readonly("points", &ControlFit::points)
      .def_readonly("mean_before", &ControlFit::mean_before)
      .def_readonly("rms_before", &ControlFit::rms_before)
      .def_readonly("mean_after", &ControlFit::mean_after)
      .def_readonly("rms_after", &ControlFit::rms_after);
  py::class_<ErrorFinding>(m, "ErrorFinding", "A possible cause of the misfit of strips.")
      .def_readonly("source", &ErrorFinding::source)
      .def_readonly("title", &ErrorFinding::title)
      .def_readonly("unit", &ErrorFinding::unit, "of value and std")
      .def_readonly("probability", &ErrorFinding::probability, "that the error is present")
      .def_readonly("value", &ErrorFinding::value, "assumed - true, where it is present")
      .def_readonly("std", &ErrorFinding::std)
      .def_readonly("effect", &ErrorFinding::effect, "on the ground at the edge of the swath, m")
      .def_readonly("determined", &ErrorFinding::determined)
      .def_readonly("corrected", &ErrorFinding::corrected)
      .def_readonly("evidence", &ErrorFinding::evidence)
      .def_readonly("remedy", &ErrorFinding::remedy);
}

void bindSystem(py::module_& m) {
  py::class_<SystemEstimate>(m, "SystemEstimate", "One of several systems of a calibration.")
      .def_property_readonly("name", [](const SystemEstimate& s) { return s.group.name; })
      .def_property_readonly("strips", [](const SystemEstimate& s) { return s.group.strips; })
      .def_property_readonly("parameters",
                             [](const SystemEstimate& s) { return parametersOf(s.parameters); })
      .def_property_readonly(
          "offset", [](const SystemEstimate& s) { return Eigen::Vector3d(s.offset); },
          "of its coordinates, assumed - true, to the first system: east, north, up, m")
      .def_property_readonly(
          "offset_std", [](const SystemEstimate& s) { return Eigen::Vector3d(s.offset_std); }, "m");
}

void bindResult(py::module_& m) {
  using Result = CalibrationResult;
  py::class_<Result, std::shared_ptr<Result>>(m, "CalibrationResult",
                                              "The content of a calibration.json.")
      .def_readonly("verdict", &Result::verdict)
      .def_property_readonly(
          "parameters", [](const Result& r) { return parametersOf(r.parameters); },
          "the eight system parameters by name, such as 'boresight_roll'")
      .def_property_readonly(
          "attitude", [](const Result& r) { return std::string(toString(r.attitude)); },
          "source of the attitude of the model: 'none', 'points', 'trajectory' or 'nominal'")
      .def_property_readonly("correlation_order", &correlationOrder,
                             "names of the rows and columns of correlation")
      .def_property_readonly(
          "correlation", [](const Result& r) { return Eigen::MatrixXd(r.correlation); },
          "of the estimated parameters; a new array")
      .def_readonly("systems", &Result::systems,
                    "all systems where there are several; parameters are those of the first one")
      .def_readonly("sigma0", &Result::sigma0, "standard deviation of unit weight, 1")
      .def_readonly("redundancy", &Result::redundancy)
      .def_readonly("converged", &Result::converged)
      .def_readonly("misfit", &Result::misfit)
      .def_readonly("pairs", &Result::pairs)
      .def_readonly("control", &Result::control, "fit of each strip to control")
      .def_readonly("diagnosis", &Result::diagnosis, "possible causes of the misfit")
      .def_readonly("observability", &Result::observability,
                    "what is weakly determined, why, and what would help")
      .def_property_readonly("warnings", [](const Result& r) { return textsOf(r.warnings); })
      .def_readonly("left_out", &Result::left_out)
      .def_readonly("inputs", &Result::inputs, "names of files")
      .def(
          "to_dict", [](const Result& r) { return parsedJson(calibrationJson(r)); },
          "The content of calibration.json as dictionaries and lists; angles in arc-seconds.")
      .def(
          "write",
          [](const Result& r, const std::filesystem::path& path) { writeCalibration(path, r); },
          py::arg("path"), "Writes calibration.json; the file appears when it is complete.")
      .def("__str__", &calibrationTables);
}

}  // namespace

void bindCalibrationResult(py::module_& m) {
  bindParameter(m);
  bindVerdict(m);
  bindFits(m);
  bindSystem(m);
  bindResult(m);
  m.def("read_calibration", &readCalibration, py::arg("path"),
        "Reads a calibration.json. InputError for a file that is none.");
}

}  // namespace pcl_als::python
