// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

const std::array<ErrorSourceInfo, kErrorSourceCount>& errorSources() {
  static const std::array<ErrorSourceInfo, kErrorSourceCount> kSources{{
      {ErrorSource::slope_ranging, "slope_ranging", "range error on inclined surfaces", "1", 1.0,
       "process the waveforms with another detector of echoes, or avoid steep surfaces in tie "
       "areas; points are not corrected for it"},
      {ErrorSource::range_scale, "range_scale", "scale of the ranges", "ppm", 1e-6,
       "check the atmospheric correction (temperature, pressure, flying height) and the clock of "
       "the range measurement"},
      {ErrorSource::time_offset, "time_offset", "time offset between scanner and trajectory", "ms",
       1e-3,
       "check the time synchronisation (PPS cable and delay, leap seconds, time stamp at the start "
       "or the end of a message)"},
      {ErrorSource::mirror_torsion, "mirror_torsion", "torsion or lag of the mirror", "arcsec",
       kRadiansPerArcsec,
       "have the encoder and the mirror's torsion calibrated by the manufacturer; a lower scan "
       "rate reduces the error"},
      {ErrorSource::encoder_cubic, "encoder_cubic", "cubic error of the angle encoder", "arcsec",
       kRadiansPerArcsec,
       "have the angle encoder calibrated by the manufacturer; a smaller field of view reduces the "
       "error"},
      {ErrorSource::intensity_ranging, "intensity_ranging",
       "range error that depends on the intensity", "m", 1.0,
       "apply the manufacturer's range walk correction, or renew it with targets of known "
       "reflectance"},
      {ErrorSource::encoder_quadratic, "encoder_quadratic", "quadratic error of the angle encoder",
       "arcsec", kRadiansPerArcsec,
       "have the angle encoder, or an eccentricity of its disk, calibrated by the manufacturer"},
      {ErrorSource::deflection_scale, "deflection_scale", "scale of the deflection from the axis",
       "ppm", 1e-6,
       "have the deflection angle of the prisms or of the tilted mirror calibrated by the "
       "manufacturer"},
      {ErrorSource::height_offset, "height_offset", "height offset of the block", "m", 1.0,
       "check the height of the base station's antenna, the geoid model, the vertical datum and "
       "the unit of the trajectory and of the control, and lever_arm_z, which moves points alike"},
      {ErrorSource::east_offset, "east_offset", "offset of the block to the east", "m", 1.0,
       "check the position of the base station and the datum of the trajectory and of the "
       "control"},
      {ErrorSource::north_offset, "north_offset", "offset of the block to the north", "m", 1.0,
       "check the position of the base station and the datum of the trajectory and of the "
       "control"},
  }};
  return kSources;
}

}  // namespace pcl_als
