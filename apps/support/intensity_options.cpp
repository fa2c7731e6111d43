// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_options.h"

#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "atmosphere_options.h"
#include "flight_options.h"
#include "report_options.h"
#include "strip_options.h"

namespace pcl_als::app {
namespace {

void addModelOptions(CommandLine& line) {
  const RadiometricModel model;
  line.addNumber("reference_range", "range that intensities are referred to", model.reference_range,
                 {1.0, 20000.0, "m"});
  line.addNumber("range_exponent", "power of range", model.range_exponent, {0.0, 6.0});
  line.addNumber("incidence_exponent", "power of cos(incidence)", model.incidence_exponent,
                 {0.0, 4.0});
  line.addNumber("largest_incidence",
                 "largest incidence angle; larger ones are limited to it and counted",
                 model.largest_incidence, {1.0, 89.0, "degrees"});
  line.addFlag("no_range", "leave the range term out");
  line.addFlag("no_incidence", "leave the incidence term out");
}

void addGainOptions(CommandLine& line) {
  const OptionGroup group(line, Group::inputs);
  line.addText("strip_gains",
               "STRIP=FACTOR,…: known gains of strips; intensities are divided by them")
      .formerly("gains");
  line.addText("pulse_rates",
               "STRIP=HZ,…: pulse rates of all strips; the pulse energy is inversely "
               "proportional (constant power)");
  line.addText("agc_field", "extra field of the LAS points with the value of the gain control");
  line.makeDependent("agc_field", "agc_gain");
  line.makeDependent("agc_gain", "agc_field");
  line.addInputFile("agc_gain",
                    "CSV value,gain: the gain at values of -agc_field, interpolated linearly");
  line.addFlag("echo_energy",
               "use the energies of echoes in place of intensities: extra bytes amplitude times "
               "echo_width, as pcl_als_waveform writes them");
  line.addNumber("saturation",
                 "digital number at which intensity is saturated, in place of 255 where none is "
                 "greater, else 65535; energies of echoes have none",
                 {}, {1.0, 65535.0});
}

void addSurfaceOptions(CommandLine& line) {
  const LocalSurfaceSettings surfaces;
  line.addNumber("surface_radius",
                 "radius of the local planes in plan; 0: that of 16 points, at least the footprint",
                 surfaces.radius, {0.0, 1000.0, "m"});
  line.addNumber("surface_tolerance", "largest distance of points on a local plane",
                 surfaces.tolerance, {0.001, 10.0, "m"});
  line.addNumber("beam_divergence", "divergence of the beam", 0.3, {0.0, 10.0, "mrad"})
      .formerly("divergence");
}

void addOverlapOptions(CommandLine& line) {
  line.addText(
          "estimate",
          "terms to estimate from overlaps: a list of range_exponent, incidence_exponent, "
          "extinction, "
          "strip_gains, or all; terms that the overlaps do not determine keep their given value")
      .in(Group::estimation);
  line.addNumber("cell", "cell size for the comparison of strips; 0: that of 6 points", 0.0,
                 {0.0, 100.0, "m"});
  line.addInputFile("radiometry", "JSON of an earlier run: its model, gains and constant are used");
  line.exclude({"radiometry", "estimate"});
  line.addInputFile(
      "targets",
      "reference targets, CSV x,y,reflectance[,id][,sigma]: reflectance is written as well");
  addUnitsOption(line, "targets", "-targets");
  line.addNumber("target_radius", "radius within which points belong to a target", 1.0,
                 {0.01, 1000.0, "m"});
}

void addOutputOptions(CommandLine& line) {
  line.addOutputFolder("corrected",
                       "folder for the corrected files; all files named are then inputs",
                       copiesOfInputs());
  line.addNumber("intensity_scale", "factor on corrected intensities in the 16-bit field", 1.0,
                 {1e-6, 1e6})
      .formerly("scale")
      .in(Group::output);
  line.addFlag("no_original", "do not keep the original intensity as extra bytes")
      .in(Group::output);
  line.addFlag("no_fields", "do not add range, incidence angle and reflectance as extra bytes")
      .in(Group::output);
  line.addFlag("keep_uncovered",
               "leave any number of points without a trajectory unchanged (default: up to 1 % of a "
               "file, which are counted; a file with more is refused)");
  line.addOutputFile("output", "file for model, uncertainties, counts and statistics", {".json"})
      .formerly("json");
  addReportOption(line,
                  "folder for report.html (pictures inside), report.md and tables as CSV on the "
                  "effect of the correction",
                  {"slopes.csv", "classes.csv", "strips.csv", "histograms.csv"});
}

void setEstimates(const CommandLine& line, OverlapSettings& overlaps) {
  if (!line.has("estimate")) return;
  for (const std::string& name : splitList(line.text("estimate"))) {
    bool known = name == "all" || name == "strip_gains";
    if (known) overlaps.estimate_gains = true;
    for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
      const bool meant = name == nameOf(static_cast<RadiometricTerm>(t));
      known = known || meant;
      if (meant || name == "all") overlaps.estimate[t] = true;
    }
    if (!known)
      throw UsageError("option -estimate: '" + name +
                       "' is none of range_exponent, incidence_exponent, extinction, strip_gains, "
                       "all");
  }
}

std::map<std::string, double> valuesByStrip(const CommandLine& line, const std::string& option,
                                            double low, double high) {
  if (!line.has(option)) return {};
  return line.parsed(option,
                     [=](const std::string& text) { return stripValuesIn(text, low, high); });
}

IntensitySettings intensitySettings(const CommandLine& line, double extinction_per_km) {
  IntensitySettings settings;
  RadiometricModel& model = settings.model;
  model.reference_range = line.number("reference_range");
  model.range_exponent = line.number("range_exponent");
  model.incidence_exponent = line.number("incidence_exponent");
  model.largest_incidence = line.number("largest_incidence");
  model.extinction_per_km = extinction_per_km;
  if (line.has("no_range")) model.range_exponent = 0.0;
  if (line.has("no_incidence")) model.incidence_exponent = 0.0;
  settings.surfaces.radius = line.number("surface_radius");
  settings.surfaces.tolerance = line.number("surface_tolerance");
  settings.footprint_mrad = line.number("beam_divergence");
  settings.cell = line.number("cell");
  setEstimates(line, settings.overlaps);
  settings.gains = valuesByStrip(line, "strip_gains", 1e-6, 1e6);
  settings.pulse_rates = valuesByStrip(line, "pulse_rates", 1.0, 1e9);
  if (line.has("agc_field")) {
    settings.gain_control = line.text("agc_field");
    settings.gain_steps = readGainSteps(line.text("agc_gain"));
  }
  settings.echo_energy = line.has("echo_energy");
  if (line.has("saturation")) settings.saturation = line.number("saturation");
  settings.keep_uncovered = line.has("keep_uncovered");
  settings.strips = stripChoice(line);
  settings.statistics = line.has("output") || line.has("report");
  settings.find_surfaces = model.incidence_exponent != 0.0 || settings.statistics ||
                           !line.has("no_fields") || line.has("estimate") || line.has("targets");
  checkFlightOptions(line);
  settings.gps_week = gpsWeek(line);
  settings.force = line.has("force");
  settings.threads = line.threads();
  return settings;
}

IntensityOutput intensityOutput(const CommandLine& line) {
  IntensityOutput output;
  output.scale = line.number("intensity_scale");
  output.keep_original = !line.has("no_original");
  output.extra_fields = !line.has("no_fields");
  return output;
}

}  // namespace

void addIntensityOptions(CommandLine& line) {
  addModelOptions(line);
  addAtmosphereOptions(line);
  addGainOptions(line);
  addSurfaceOptions(line);
  addOverlapOptions(line);
  addOutputOptions(line);
}

IntensityOptions intensityOptions(const CommandLine& line, double extinction_per_km) {
  IntensityOptions options;
  options.settings = intensitySettings(line, extinction_per_km);
  options.output = intensityOutput(line);
  options.target_radius = line.number("target_radius");
  if (line.has("radiometry")) options.stored = readIntensityJson(line.text("radiometry"));
  if (line.has("targets"))
    options.targets = readReferenceTargets(line.text("targets"), unitOption(line, "targets"));
  return options;
}

}  // namespace pcl_als::app
