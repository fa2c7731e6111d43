// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_options.h"

#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "flight_options.h"
#include "strip_options.h"

namespace pcl_als::app {
namespace {

void addModelOptions(CommandLine& line) {
  const RadiometricModel model;
  line.add<double>("reference_range", "range that intensities are referred to, m",
                   model.reference_range);
  line.add<double>("range_exponent", "power of range, 0 to 6", model.range_exponent);
  line.add<double>("incidence_exponent", "power of cos(incidence), 0 to 4",
                   model.incidence_exponent);
  line.add<double>("largest_incidence",
                   "largest incidence angle, degrees; larger ones are limited to it and counted",
                   model.largest_incidence);
  line.addFlag("no_range", "leave the range term out");
  line.addFlag("no_incidence", "leave the incidence term out");
  line.addFlag("no_atmosphere", "leave the atmosphere out");
}

void addAirOptions(CommandLine& line) {
  const Atmosphere air;
  line.add<double>("visibility", "visibility, km (models of Kruse and Kim)", air.visibility_km);
  line.add<double>("temperature", "air temperature, C", air.temperature_c);
  line.add<double>("pressure", "air pressure, kPa", air.pressure_kpa);
  line.add<double>("humidity", "relative humidity, %", air.relative_humidity);
  line.add<double>("wavelength", "wavelength of the laser, nm, 500 to 1650", air.wavelength_nm);
  line.addOptional("attenuation", "attenuation, dB/km, one way, instead of the weather");
}

void addGainOptions(CommandLine& line) {
  line.addOptional("gains",
                   "STRIP=FACTOR,…: known gains of strips; intensities are divided by them");
  line.addOptional("pulse_rates",
                   "STRIP=HZ,…: pulse rates of all strips; the pulse energy is inversely "
                   "proportional (constant power)");
  line.addOptional("agc_field", "extra field of the LAS points with the value of the gain control");
  line.addOptional("agc_gain",
                   "CSV value,gain: the gain at values of -agc_field, interpolated linearly");
  line.addOptional("saturation",
                   "digital number at which intensity is saturated (default: 255 where none is "
                   "greater, else 65535)");
}

void addSurfaceOptions(CommandLine& line) {
  const LocalSurfaceSettings surfaces;
  line.add<double>(
      "surface_radius",
      "radius of the local planes in plan, m; 0: that of 16 points, at least the footprint",
      surfaces.radius);
  line.add<double>("surface_tolerance", "largest distance of points on a local plane, m",
                   surfaces.tolerance);
  line.add<double>("divergence", "divergence of the beam, mrad", 0.3);
}

void addOverlapOptions(CommandLine& line) {
  line.addOptional(
      "estimate",
      "terms to estimate from overlaps: a list of range_exponent, incidence_exponent, extinction, "
      "strip_gains, or all; terms that the overlaps do not determine keep their given value");
  line.add<double>("cell", "cell size for the comparison of strips, m; 0: that of 6 points", 0.0);
  line.addOptional("radiometry", "JSON of an earlier run: its model, gains and constant are used");
  line.addOptional(
      "targets",
      "reference targets, CSV x,y,reflectance[,id][,sigma]: reflectance is written as well");
  addUnitsOption(line, "targets", "-targets");
  line.add<double>("target_radius", "radius within which points belong to a target, m", 1.0);
}

void addOutputOptions(CommandLine& line) {
  line.addOptional("corrected", "folder for the corrected files; all files named are then inputs");
  line.add<double>("scale", "factor on corrected intensities in the 16-bit field", 1.0);
  line.addFlag("no_original", "do not keep the original intensity as extra bytes");
  line.addFlag("no_fields", "do not add range, incidence angle and reflectance as extra bytes");
  line.addFlag("keep_uncovered",
               "leave any number of points without a trajectory unchanged (default: up to 1 % of a "
               "file, which are counted; a file with more is refused)");
  line.addOptional("json", "file for model, uncertainties, counts and statistics");
  line.addOptional("report",
                   "folder for report.html (pictures inside), report.md and tables as CSV on the "
                   "effect of the correction");
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

std::map<std::string, double> valuesByStrip(const CommandLine& line, const char* option, double low,
                                            double high) {
  if (!line.has(option)) return {};
  return line.parsed(option,
                     [=](const std::string& text) { return stripValuesIn(text, low, high); });
}

IntensitySettings intensitySettings(const CommandLine& line, double extinction_per_km) {
  IntensitySettings settings;
  RadiometricModel& model = settings.model;
  model.reference_range = line.number("reference_range", 1.0, 20000.0, "m");
  model.range_exponent = line.number("range_exponent", 0.0, 6.0, "(exponent)");
  model.incidence_exponent = line.number("incidence_exponent", 0.0, 4.0, "(exponent)");
  model.largest_incidence = line.number("largest_incidence", 1.0, 89.0, "degrees");
  model.extinction_per_km = extinction_per_km;
  if (line.has("no_range")) model.range_exponent = 0.0;
  if (line.has("no_incidence")) model.incidence_exponent = 0.0;
  settings.surfaces.radius = line.number("surface_radius", 0.0, 1000.0, "m");
  settings.surfaces.tolerance = line.number("surface_tolerance", 0.001, 10.0, "m");
  settings.footprint_mrad = line.number("divergence", 0.0, 10.0, "mrad");
  settings.cell = line.number("cell", 0.0, 100.0, "m");
  setEstimates(line, settings.overlaps);
  settings.gains = valuesByStrip(line, "gains", 1e-6, 1e6);
  settings.pulse_rates = valuesByStrip(line, "pulse_rates", 1.0, 1e9);
  if (line.has("agc_field") != line.has("agc_gain"))
    throw UsageError("options -agc_field and -agc_gain: give both or none");
  if (line.has("agc_field")) {
    settings.gain_control = line.text("agc_field");
    settings.gain_steps = readGainSteps(line.text("agc_gain"));
  }
  if (line.has("saturation"))
    settings.saturation = numberIn(line.text("saturation"), "option -saturation", 1.0, 65535.0);
  settings.keep_uncovered = line.has("keep_uncovered");
  settings.strips = stripChoice(line);
  settings.statistics = line.has("json") || line.has("report");
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
  output.scale = line.number("scale", 1e-6, 1e6, "(factor)");
  output.keep_original = !line.has("no_original");
  output.extra_fields = !line.has("no_fields");
  return output;
}

}  // namespace

void addIntensityOptions(CommandLine& line) {
  addModelOptions(line);
  addAirOptions(line);
  addGainOptions(line);
  addSurfaceOptions(line);
  addOverlapOptions(line);
  addOutputOptions(line);
}

ExtinctionChoice extinctionChoice(const CommandLine& line) {
  ExtinctionChoice choice;
  if (line.has("no_atmosphere")) {
    choice.remark = "atmosphere: left out";
    return choice;
  }
  if (line.has("attenuation")) {
    choice.per_km = line.parsed("attenuation", [](const std::string& text) {
      return extinctionFromDecibel(numberIn(text, "dB/km", 0.0, 1000.0));
    });
  } else {
    Atmosphere air;
    air.visibility_km = line.number("visibility", 0.01, 500.0, "km");
    air.temperature_c = line.number("temperature", -60.0, 60.0, "C");
    air.pressure_kpa = line.number("pressure", 20.0, 120.0, "kPa");
    air.relative_humidity = line.number("humidity", 0.0, 100.0, "%");
    air.wavelength_nm = line.number("wavelength", 500.0, 1650.0, "nm");
    choice.air = air;
    choice.parts = extinctionOf(air);
    choice.per_km = choice.parts.total();
  }
  choice.remark = extinctionText(choice);
  return choice;
}

IntensityOptions intensityOptions(const CommandLine& line, double extinction_per_km) {
  if (line.has("radiometry") && line.has("estimate"))
    throw UsageError("options -radiometry and -estimate exclude each other");
  IntensityOptions options;
  options.settings = intensitySettings(line, extinction_per_km);
  options.output = intensityOutput(line);
  options.target_radius = line.number("target_radius", 0.01, 1000.0, "m");
  if (line.has("radiometry")) options.stored = readIntensityJson(line.text("radiometry"));
  if (line.has("targets"))
    options.targets = readReferenceTargets(line.text("targets"), unitOption(line, "targets"));
  return options;
}

}  // namespace pcl_als::app
