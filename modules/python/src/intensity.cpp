// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <map>

#include <pybind11/eigen.h>

#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/radiometry/atmosphere.h>
#include <pcl_als/report/intensity_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "messages.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// What a correction of intensities found.
struct Radiometry {
  RadiometricModel model;
  std::map<std::string, double> gains;
  std::map<std::string, std::uint64_t> points_by_status;
  std::string reason, json;
  WarningTexts warnings;
  std::vector<ExcludedPoints> excluded;
};

void bindAtmosphere(py::module_& m) {
  py::class_<Atmosphere>(m, "Atmosphere", "The air as a weather station reports it.")
      .def(fromKeywords<Atmosphere>())
      .def_readwrite("visibility_km", &Atmosphere::visibility_km)
      .def_readwrite("temperature_c", &Atmosphere::temperature_c)
      .def_readwrite("pressure_kpa", &Atmosphere::pressure_kpa)
      .def_readwrite("relative_humidity", &Atmosphere::relative_humidity, "percent")
      .def_readwrite("wavelength_nm", &Atmosphere::wavelength_nm, "of the laser")
      .def_property_readonly(
          "extinction_per_km", [](const Atmosphere& air) { return extinctionOf(air).total(); },
          "one way");
  py::class_<RadiometricModel>(m, "RadiometricModel",
                               "I_c = I (r / r0)^m / cos(theta)^k exp(2 a (r - r0)).")
      .def(fromKeywords<RadiometricModel>())
      .def_readwrite("range_exponent", &RadiometricModel::range_exponent, "m, 0 to 6")
      .def_readwrite("incidence_exponent", &RadiometricModel::incidence_exponent, "k, 0 to 4")
      .def_readwrite("extinction_per_km", &RadiometricModel::extinction_per_km, "a, one way")
      .def_readwrite("reference_range", &RadiometricModel::reference_range, "r0, m")
      .def_readwrite("largest_incidence", &RadiometricModel::largest_incidence,
                     "degrees; larger angles are limited to it")
      .def(
          "factor",
          [](const RadiometricModel& model, double range, double cosine) {
            return model.factor(range, cosine);
          },
          py::arg("range"), py::arg("cosine"),
          "Corrected over given intensity at a range (m) and cosine of the incidence angle (NaN: "
          "no incidence term).");
}

/// The terms that are estimated, by name.
std::vector<std::string> estimatedTerms(const IntensitySettings& settings) {
  std::vector<std::string> names;
  for (std::size_t t = 0; t < kRadiometricTermCount; ++t)
    if (settings.overlaps.estimate[t]) names.emplace_back(nameOf(static_cast<RadiometricTerm>(t)));
  if (settings.overlaps.estimate_gains) names.emplace_back("strip_gains");
  return names;
}

void setEstimatedTerms(IntensitySettings& settings, const std::vector<std::string>& names) {
  settings.overlaps.estimate.fill(false);
  settings.overlaps.estimate_gains = false;
  for (const std::string& name : names) {
    bool known = name == "strip_gains";
    if (known) settings.overlaps.estimate_gains = true;
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
      if (name != nameOf(static_cast<RadiometricTerm>(t))) continue;
      settings.overlaps.estimate[t] = known = true;
    }
    if (!known)
      throw UsageError("estimate: '" + name +
                       "' is none of range_exponent, incidence_exponent, extinction, strip_gains");
  }
}

void bindSettings(py::module_& m) {
  using Settings = IntensitySettings;
  py::class_<Settings>(m, "IntensitySettings",
                       "Settings of a radiometric correction; attributes may be given as keywords.")
      .def(fromKeywords<Settings>())
      .def_readwrite("model", &Settings::model)
      .def_property("estimate", &estimatedTerms, &setEstimatedTerms,
                    "terms to estimate from overlaps: 'range_exponent', 'incidence_exponent', "
                    "'extinction', 'strip_gains'")
      .def_readwrite("gains", &Settings::gains,
                     "known gains by strip; intensities are divided by them")
      .def_readwrite("pulse_rates", &Settings::pulse_rates, "by strip, Hz")
      .def_readwrite("footprint_mrad", &Settings::footprint_mrad, "divergence of the beam")
      .def_readwrite("cell", &Settings::cell, "of the comparison of strips, m; 0: from the density")
      .def_readwrite("saturation", &Settings::saturation, "digital number; 0: 255 or 65535")
      .def_readwrite("strips", &Settings::strips, "points of other strips stay unchanged")
      .def_readwrite("keep_uncovered", &Settings::keep_uncovered,
                     "any number of points without trajectory stay unchanged, else at most 1 %")
      .def_readwrite("gps_week", &Settings::gps_week)
      .def_readwrite("force", &Settings::force)
      .def_readwrite("threads", &Settings::threads);
  py::class_<IntensityOutput>(m, "IntensityOutput", "What is written besides the intensity.")
      .def(fromKeywords<IntensityOutput>())
      .def_readwrite("scale", &IntensityOutput::scale, "factor in the 16-bit field")
      .def_readwrite("keep_original", &IntensityOutput::keep_original,
                     "as extra field original_intensity")
      .def_readwrite("extra_fields", &IntensityOutput::extra_fields,
                     "range, incidence_angle, and reflectance where it is known");
}

std::map<std::string, double> gainsOf(const IntensityRun& run) {
  std::map<std::string, double> gains;
  for (std::size_t i = 0; i < run.strips().size(); ++i)
    gains[run.strips()[i]] = run.gain(static_cast<int>(i));
  return gains;
}

std::map<std::string, std::uint64_t> pointsByStatus(const IntensityCounts& counts) {
  std::map<std::string, std::uint64_t> points;
  for (std::size_t i = 0; i < kRadiometryStatusCount; ++i)
    points[nameOf(static_cast<RadiometryStatus>(i))] = counts.status[i];
  return points;
}

void bindResult(py::module_& m) {
  Record<Radiometry>(m, "IntensityResult", "The result of a radiometric correction.")
      .field("model", &Radiometry::model, "as it was used, with the estimated terms")
      .field("gains", &Radiometry::gains, "divisor of the intensities of each strip")
      .field("points_by_status", &Radiometry::points_by_status)
      .field("reason", &Radiometry::reason, "why the result is not reliable; empty where it is")
      .property("reliable", [](const Radiometry& r) { return r.reason.empty(); })
      .state(&Radiometry::warnings)
      .property("warnings",
                [](const Radiometry& r) { return hintedTexts("correct_intensity", r.warnings); })
      .field("left_out", &Radiometry::excluded)
      .state(&Radiometry::json)
      .bind()
      .def(
          "to_dict", [](const Radiometry& r) { return parsedJson(r.json); },
          "The content of the JSON file of pcl_als_intensity as dictionaries and lists.");
}

std::shared_ptr<Radiometry> resultOf(const IntensityReport& report) {
  const IntensityResult& result = *report.result;
  auto radiometry = std::make_shared<Radiometry>();
  radiometry->model = result.run->model(), radiometry->gains = gainsOf(*result.run);
  radiometry->points_by_status = pointsByStatus(result.counts());
  radiometry->reason = result.unreliable, radiometry->json = intensityJson(report);
  radiometry->warnings = warningTexts(result.warnings);
  radiometry->excluded = result.excluded;
  return radiometry;
}

std::shared_ptr<Radiometry> correctIntensities(const Files& inputs, const Files& outputs,
                                               const TrajectoryArgument& trajectory,
                                               const IntensityOptions& options,
                                               const std::optional<Atmosphere>& air,
                                               const ProgressCallback& report) {
  if (inputs.paths.size() != outputs.paths.size())
    throw UsageError("outputs: not as many as inputs");
  IntensityOptions used = options;
  used.settings.statistics = true;
  ExtinctionChoice extinction;
  extinction.air = air;
  if (air) {
    extinction.parts = extinctionOf(*air);
    used.settings.model.extinction_per_km = extinction.parts.total();
  }
  extinction.per_km = used.settings.model.extinction_per_km;
  TrajectoryLoadingOptions reading;
  reading.crs = commonReference(inputs.texts()).crs;
  const LoadedTrajectory flight = flightOf(trajectory, reading);
  const IntensityResult result =
      correctIntensity(inputs.texts(), outputs.texts(), flight.trajectory, used, report);
  return resultOf({&result, extinction, options.output, outputs.texts()});
}

}  // namespace

void bindIntensity(py::module_& m) {
  bindAtmosphere(m);
  bindSettings(m);
  bindResult(m);
  m.def(
      "correct_intensity",
      [](const Files& inputs, const Files& outputs, const TrajectoryArgument& trajectory,
         const IntensitySettings& settings, const std::optional<Atmosphere>& atmosphere,
         const IntensityOutput& output, const std::optional<std::filesystem::path>& targets,
         double target_radius, const PythonProgress& progress) {
        return runJob(progress, [&](const ProgressCallback& report) {
          IntensityOptions options;
          options.settings = settings, options.output = output;
          options.target_radius = target_radius;
          if (targets) options.targets = readReferenceTargets(*targets);
          return correctIntensities(inputs, outputs, trajectory, options, atmosphere, report);
        });
      },
      py::arg("inputs"), py::arg("outputs"), py::arg("trajectory"), py::kw_only(),
      py::arg_v("settings", IntensitySettings(), "IntensitySettings()"),
      py::arg("atmosphere") = py::none(),
      py::arg_v("output", IntensityOutput(), "IntensityOutput()"), py::arg("targets") = py::none(),
      py::arg("target_radius") = 1.0, py::arg("progress") = py::none(),
      "Corrects intensities of point files for range, incidence and atmosphere (radar equation; "
      "Habib et al. 2011, Eq. 35-36), as pcl_als_intensity does; one output for each input. "
      "atmosphere: sets the extinction of the model; targets: CSV of places of known reflectance, "
      "used within target_radius (m). InputError where points have no trajectory.");
}

}  // namespace pcl_als::python
