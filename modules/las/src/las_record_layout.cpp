// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als {
namespace {

// format, length, GPS time, RGB, NIR, waveform packet: LAS 1.4 R15, tables 7-17.
struct FormatRow {
  std::size_t length;
  int gps_time, rgb, nir, waveform;
};
constexpr FormatRow kFormats[] = {
    {20, -1, -1, -1, -1}, {28, 20, -1, -1, -1}, {26, -1, 20, -1, -1}, {34, 20, 28, -1, -1},
    {57, 20, -1, -1, 28}, {63, 20, 28, -1, 34}, {30, 22, -1, -1, -1}, {36, 22, 30, -1, -1},
    {38, 22, 30, 36, -1}, {59, 22, -1, -1, 30}, {67, 22, 30, 36, 38},
};

}  // namespace

LasRecordLayout LasRecordLayout::of(int format) {
  if (format < 0 || format > 10)
    throw UsageError("LAS point format " + std::to_string(format) + " is not one of 0 to 10");
  const FormatRow& row = kFormats[format];
  LasRecordLayout layout;
  layout.format = format;
  layout.length = row.length;
  layout.extended = format >= 6;
  if (!layout.extended) {
    layout.classification = 15;
    layout.scan_angle = 16;
    layout.user_data = 17;
    layout.point_source_id = 18;
  }
  layout.gps_time = row.gps_time;
  layout.rgb = row.rgb;
  layout.nir = row.nir;
  layout.waveform = row.waveform;
  return layout;
}

}  // namespace pcl_als
