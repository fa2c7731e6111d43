// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/survey/survey_messages.h>

namespace pcl_als::detail {
namespace {

void put(ByteWriter& out, const LengthUnit& unit) {
  out.put(unit.metres).put(unit.name);
}

void get(ByteReader& in, LengthUnit& unit) {
  in.get(unit.metres).get(unit.name);
}

}  // namespace

void put(ByteWriter& out, const PointFileInfo& info) {
  out.put(info.path.string()).put(info.point_count).put(info.minimum).put(info.maximum);
  out.put(info.resolution).put(info.crs).put(info.crs_kind).put(info.time_kind).put(info.format);
  out.put(info.corrections).put(info.crs_ignored).put(info.time_shift).put(info.time_fault);
  put(out, info.units.horizontal);
  put(out, info.units.vertical);
  out.put(info.units.source).put(info.units.vertical_source);
}

void get(ByteReader& in, PointFileInfo& info) {
  info.path = in.take<std::string>();
  in.get(info.point_count).get(info.minimum).get(info.maximum);
  in.get(info.resolution).get(info.crs).get(info.crs_kind).get(info.time_kind).get(info.format);
  in.get(info.corrections).get(info.crs_ignored).get(info.time_shift).get(info.time_fault);
  get(in, info.units.horizontal);
  get(in, info.units.vertical);
  in.get(info.units.source).get(info.units.vertical_source);
}

void put(ByteWriter& out, const PointFileSources& sources) {
  put(out, sources.info);
  out.putPlain(sources.sources).put(sources.damage).put(sources.box_remark);
}

void get(ByteReader& in, PointFileSources& sources) {
  get(in, sources.info);
  in.getPlain(sources.sources).get(sources.damage).get(sources.box_remark);
}

void put(ByteWriter& out, const SurveyedFile& file) {
  put(out, file.sources);
  out.putMap(file.tracks, [](ByteWriter& o, const SwathTrack& track) { track.put(o); });
  out.putMap(file.channels, [](ByteWriter& o, const std::set<std::uint8_t>& channels) {
    o.put(std::vector<std::uint8_t>(channels.begin(), channels.end()));
  });
  out.put(file.strip);
}

void get(ByteReader& in, SurveyedFile& file) {
  get(in, file.sources);
  in.getMap(file.tracks, [](ByteReader& i, SwathTrack& track) { track.get(i); });
  in.getMap(file.channels, [](ByteReader& i, std::set<std::uint8_t>& channels) {
    const auto list = i.take<std::vector<std::uint8_t>>();
    channels = {list.begin(), list.end()};
  });
  in.get(file.strip);
}

double readingCost(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  return unknown ? 1.0 : static_cast<double>(size);
}

}  // namespace pcl_als::detail
