// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/radiometry/atmosphere.h>
#include <pcl_als/report/waveform_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// What a decomposition found.
struct Waveforms {
  std::uint64_t waveforms = 0, echoes = 0, new_echoes = 0;
  double pulse_width_ns = 0.0;
  Eigen::MatrixXd response;
  std::optional<double> calibration_constant;
  std::string json, text;
  std::vector<std::string> remarks;
};

constexpr std::pair<RangeOrigin, const char*> kRangeOrigins[] = {
    {RangeOrigin::automatic, "automatic"},
    {RangeOrigin::anchor, "anchor"},
    {RangeOrigin::emitted, "emitted"}};

std::string rangeFrom(const WaveformSettings& settings) {
  for (const auto& [origin, name] : kRangeOrigins)
    if (origin == settings.range_from) return name;
  return {};
}

void setRangeFrom(WaveformSettings& settings, const std::string& text) {
  for (const auto& [origin, name] : kRangeOrigins) {
    if (text != name) continue;
    settings.range_from = origin;
    return;
  }
  throw UsageError("range_from: '" + text + "' is none of automatic, anchor, emitted");
}

/// A setting within the settings of cross sections.
template <typename M>
auto sectionSetting(M CrossSectionSettings::*member) {
  return std::pair([member](const WaveformSettings& s) { return s.cross_sections.*member; },
                   [member](WaveformSettings& s, M value) { s.cross_sections.*member = value; });
}

void bindSettings(py::module_& m) {
  using Settings = WaveformSettings;
  const auto [attenuation, setAttenuation] =
      sectionSetting(&CrossSectionSettings::correct_attenuation);
  const auto [week, setWeek] = sectionSetting(&CrossSectionSettings::gps_week);
  const auto [force, setForce] = sectionSetting(&CrossSectionSettings::force);
  const auto [radius, setRadius] = sectionSetting(&CrossSectionSettings::target_radius);
  py::class_<Settings>(m, "WaveformSettings",
                       "Settings of a decomposition; attributes may be given as keywords.")
      .def(fromKeywords<Settings>())
      .def_readwrite("pulse_width_ns", &Settings::pulse_width_ns,
                     "full width at half maximum of the response; 0: estimated")
      .def_readwrite("pulse", &Settings::pulse, "the response by samples, in place of a Gaussian")
      .def_readwrite("pulse_spacing_ns", &Settings::pulse_spacing_ns, "of these samples")
      .def_readwrite("false_echoes", &Settings::false_echoes, "expected in a waveform")
      .def_readwrite("ringing", &Settings::ringing,
                     "share of the amplitude of an echo below which echoes behind it are excluded")
      .def_readwrite("ringing_reach_ns", &Settings::ringing_reach_ns)
      .def_readwrite("saturation", &Settings::saturation,
                     "digitizer counts; 0: the largest that the bits of a sample hold")
      .def_readwrite("new_echoes", &Settings::new_echoes, "write echoes without a return")
      .def_readwrite("move_returns", &Settings::move_returns, "to the place of their echo")
      .def_property("range_from", &rangeFrom, &setRangeFrom,
                    "where times of PulseWaves files count from: 'automatic', 'anchor', 'emitted'")
      .def_property(
          "beam_divergence",
          [](const Settings& s) { return s.cross_sections.model.beam_divergence; },
          [](Settings& s, double mrad) { s.cross_sections.model.beam_divergence = mrad; },
          "full angle, mrad; for cross sections")
      .def_property(
          "calibration_constant", [](const Settings& s) { return s.cross_sections.model.constant; },
          [](Settings& s, double constant) { s.cross_sections.model.constant = constant; },
          "of cross sections, m^2 / (count ns km^4); 1: they are relative")
      .def_property("correct_attenuation", attenuation, setAttenuation,
                    "divide cross sections by the transmission that the echoes before leave")
      .def_property("target_radius", radius, setRadius, "of the points of a target, m")
      .def_property("gps_week", week, setWeek)
      .def_property("force", force, setForce)
      .def_readwrite("threads", &Settings::threads);
}

void bindResult(py::module_& m) {
  Record<Waveforms>(m, "WaveformResult", "The result of a decomposition of waveforms.")
      .field("waveforms", &Waveforms::waveforms)
      .field("echoes", &Waveforms::echoes)
      .field("new_echoes", &Waveforms::new_echoes, "that no return belongs to")
      .field("pulse_width_ns", &Waveforms::pulse_width_ns, "of the response that was used")
      .field("response", &Waveforms::response, "rows of time (ns) and value")
      .field("calibration_constant", &Waveforms::calibration_constant,
             "of cross sections; None without a trajectory")
      .field("warnings", &Waveforms::remarks)
      .state(&Waveforms::json)
      .state(&Waveforms::text)
      .bind()
      .def(
          "to_dict", [](const Waveforms& w) { return parsedJson(w.json); },
          "The content of waveform.json of pcl_als_waveform as dictionaries and lists; its entry "
          "'waveforms' has the samples, echoes and adjusted values of some waveforms.")
      .def("__str__", [](const Waveforms& w) { return w.text; });
}

std::shared_ptr<Waveforms> resultOf(const WaveformResult& result, const WaveformReport& report) {
  auto found = std::make_shared<Waveforms>();
  found->waveforms = result.counts.waveforms, found->echoes = result.counts.echoes;
  found->new_echoes = result.counts.added;
  found->pulse_width_ns = result.pulses.front().width_ns;
  const auto count = static_cast<Eigen::Index>(result.pulse.size());
  found->response.resize(count, 2);
  for (Eigen::Index i = 0; i < count; ++i)
    found->response.row(i) << result.pulse_first_ns +
                                  result.pulse_spacing_ns * static_cast<double>(i),
        result.pulse[static_cast<std::size_t>(i)];
  if (result.cross_sections) found->calibration_constant = result.cross_sections->constant;
  found->json = waveformJson(report), found->text = describe(result);
  found->remarks = result.remarks;
  return found;
}

}  // namespace

void bindWaveforms(py::module_& m) {
  bindSettings(m);
  bindResult(m);
  m.def(
      "decompose_waveforms",
      [](const std::filesystem::path& input, const std::filesystem::path& output,
         const WaveformSettings& settings, const std::vector<std::uint64_t>& waveforms,
         const OptionalTrajectory& trajectory, const std::optional<Atmosphere>& atmosphere,
         const std::optional<std::filesystem::path>& targets, const PythonProgress& progress) {
        return runJob(progress, [&](const ProgressCallback& report) {
          WaveformSettings used = settings;
          used.examples = true, used.shown = waveforms;
          if (const auto flight = given<TrajectoryArgument>(trajectory)) {
            TrajectoryLoadingOptions reading;
            reading.crs = commonReference({input.string()}).crs;
            used.cross_sections.trajectory = flightOf(*flight, reading).trajectory;
          } else if (atmosphere || targets) {
            throw UsageError("atmosphere and targets need a trajectory");
          }
          if (atmosphere)
            used.cross_sections.model.extinction_per_km = extinctionOf(*atmosphere).total();
          if (targets) used.cross_sections.targets = readReferenceTargets(*targets);
          const WaveformResult result = decomposeWaveforms(input, output, used, report);
          return resultOf(result, {&result, input.string(), output.string()});
        });
      },
      py::arg("input"), py::arg("output"), py::kw_only(),
      py::arg_v("settings", WaveformSettings(), "WaveformSettings()"),
      py::arg_v("waveforms", std::vector<std::uint64_t>(), "[]"),
      py::arg("trajectory") = py::none(), py::arg("atmosphere") = py::none(),
      py::arg("targets") = py::none(), py::arg("progress") = py::none(),
      "Decomposes the waveforms of a LAS, LAZ or PulseWaves file into echoes and writes them as "
      "points, as pcl_als_waveform does. waveforms: numbers of points (or pulses) whose waveforms "
      "the result contains, from 0, in place of examples; trajectory: for cross sections, with "
      "the extinction of an atmosphere, calibrated by targets (CSV of places of known "
      "reflectance). InputError for files without waveforms and damaged ones.");
}

}  // namespace pcl_als::python
