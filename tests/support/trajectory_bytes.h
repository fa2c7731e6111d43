// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>

#include "las_bytes.h"

// Trajectories of a few records, written by hand from the descriptions of their formats: a flight
// to the north at 60 m/s, one record a second.
namespace pcl_als::test {

/// TerraScan User's Guide: a header of 1376 bytes, records of 64.
inline std::string terrascanTrajectory(unsigned count) {
  Bytes bytes;
  bytes.text("TSCANTRJ", 8).u32(20010715).u32(1376).u32(count).u32(64);
  bytes.text("", 1376 - 24);
  for (unsigned i = 0; i < count; ++i)
    bytes.f64(100.0 + i)
        .f64(5e5)
        .f64(5e6 + 60.0 * i)
        .f64(1500.0)
        .f64(359.0)
        .f64(2.0)
        .f64(-1.0)
        .u64(0);
  return bytes.str();
}

/// RIEGL .pof. Records begin at Wednesday 29 April 2015, 53,809 s of the day.
struct PofBytes {
  unsigned minor = 1, unit = 1, system = 0, count = 3, stated = 0, offset = 315;
  unsigned year = 2015, month = 4, day = 29;
  double first_time = 53809.0, step = 1.0;
  double latitude = 38.5;  ///< degrees

  std::string str() const {
    Bytes bytes;
    bytes.text("RIEGL POSITION&ORIENTATION", 27).u16(1).u16(minor).u32(offset);
    bytes.u16(year).u16(month).u16(day).u64(stated > 0 ? stated : count);
    for (int i = 0; i < 9; ++i) bytes.f64(0.0);  // box, statistics of the time steps
    bytes.u8(unit).u8(system).text("UTC", 16).text("", 16);
    for (int i = 0; i < 5; ++i) bytes.text("", 32);  // device, project, company, reserved
    for (unsigned i = 0; i < count; ++i) {
      bytes.f64(first_time + step * i).f64(-107.9).f64(latitude + 60.0 / 111000.0 * i).f64(1721.0);
      bytes.f64(-0.35).f64(2.32).f64(359.63);
      if (minor >= 1) bytes.f64(60.0 * i);
    }
    return bytes.str();
  }
};

/// RIEGL .poq of the same times.
inline std::string poqBytes(unsigned count, unsigned minor, double first_time = 53809.0) {
  Bytes bytes;
  bytes.text("RIEGL POSITION&ORIENTATION QUALITY", 35).u16(1).u16(minor).u32(67);
  bytes.f64(1.0).f64(1.0).f64(0.0);
  for (unsigned i = 0; i < count; ++i) {
    bytes.f64(first_time + i).f64(0.01).f64(0.02).f64(0.03).f64(0.004).f64(0.005).f64(0.006);
    bytes.f64(1.5).u16(9);
    if (minor >= 1) bytes.u16(5);
  }
  return bytes.str();
}

/// Leica .sol: header of 35 bytes with its checksum, 149 bytes of a solution.
inline std::string solBytes(unsigned count, double first_time = 400825.0) {
  std::string all;
  for (unsigned i = 0; i < count; ++i) {
    Bytes bytes;
    bytes.u8(0xAA).u8(0x44).u16(149).u8(1).u8(1).u8(2).u8(3).u8(0).u8(0).u16(i).u16(7);
    bytes.u8(1).u8(1).u16(2150).f64(first_time + i).f64(0.0);
    unsigned sum = 0;
    for (const char byte : bytes.str()) sum ^= static_cast<unsigned char>(byte);
    bytes.u8(sum).u16(1).u16(2).u16(3).u8(4);
    bytes.f64(0.82 + 60.0 / 6.37e6 * i).f64(0.15).f64(1500.0).f32(2e-9F).f32(2e-9F).f32(0.03F);
    bytes.f64(0.01).f64(-0.02).f64(6.27).f32(4e-5F).f32(5e-5F).f32(1e-4F);
    bytes.f64(60.0).f64(0.0).f64(0.0).f32(0.01F).f32(0.01F).f32(0.01F);
    bytes.f64(0.0).f64(0.0).f64(0.0).f32(47.5F).u8(1).u8(0).u32(0);
    all += bytes.str();
  }
  return all;
}

}  // namespace pcl_als::test
