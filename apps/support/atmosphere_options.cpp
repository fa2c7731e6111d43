// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "atmosphere_options.h"

namespace pcl_als::app {

std::vector<std::string> addAtmosphereOptions(CommandLine& line) {
  const Atmosphere air;
  line.addFlag("no_atmosphere", "leave the atmosphere out");
  line.addNumber("visibility", "visibility (models of Kruse and Kim)", air.visibility_km,
                 {0.01, 500.0, "km"});
  line.addNumber("temperature", "air temperature", air.temperature_c, {-60.0, 60.0, "C"});
  line.addNumber("pressure", "air pressure", air.pressure_kpa, {20.0, 120.0, "kPa"});
  line.addNumber("humidity", "relative humidity", air.relative_humidity, {0.0, 100.0, "%"});
  line.addNumber("wavelength", "wavelength of the laser", air.wavelength_nm, {500.0, 1650.0, "nm"});
  line.addNumber("attenuation", "attenuation, one way, instead of the weather", {},
                 {0.0, 1000.0, "dB/km"});
  return {"no_atmosphere", "visibility", "temperature", "pressure",
          "humidity",      "wavelength", "attenuation"};
}

ExtinctionChoice extinctionChoice(const CommandLine& line) {
  ExtinctionChoice choice;
  if (line.has("no_atmosphere")) {
    choice.remark = "atmosphere: not applied";
    return choice;
  }
  if (line.has("attenuation")) {
    choice.per_km = extinctionFromDecibel(line.number("attenuation"));
  } else {
    Atmosphere air;
    air.visibility_km = line.number("visibility");
    air.temperature_c = line.number("temperature");
    air.pressure_kpa = line.number("pressure");
    air.relative_humidity = line.number("humidity");
    air.wavelength_nm = line.number("wavelength");
    choice.air = air;
    choice.parts = extinctionOf(air);
    choice.per_km = choice.parts.total();
  }
  choice.remark = extinctionText(choice);
  return choice;
}

}  // namespace pcl_als::app
