// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <nlohmann/json.hpp>

#include <pcl_als/io/applied_correction.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/report/inventory_report.h>

#include "excluded_json.h"
#include "flight_json.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

Json vector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json statistics(const PointStatistics& s) {
  Json json;
  json["points"] = s.points;
  json["first_returns"] = s.first_returns;
  json["single_returns"] = s.single_returns;
  json["minimum"] = vector(s.minimum);
  json["maximum"] = vector(s.maximum);
  json["time"] = {s.first_time, s.last_time};
  json["scan_angle_deg"] = {s.least_scan_angle, s.largest_scan_angle};
  json["intensity"] = {s.least_intensity, s.largest_intensity};
  json["unsorted_times"] = s.unsorted_times;
  json["zero_times"] = s.zero_times;
  json["invalid_times"] = s.invalid_times;
  json["invalid_coordinates"] = s.invalid_coordinates;
  json["wrong_returns"] = s.wrong_returns;
  json["withheld"] = s.withheld;
  json["synthetic"] = s.synthetic;
  json["overlap_flags"] = s.overlap_flags;
  json["channels"] = s.channels;
  json["returns"] = Json::object();
  for (std::size_t r = 0; r < s.returns.size(); ++r)
    if (s.returns[r] > 0) json["returns"][std::to_string(r)] = s.returns[r];
  json["classes"] = Json::object();
  for (std::size_t c = 0; c < s.classes.size(); ++c)
    if (s.classes[c] > 0) json["classes"][std::to_string(c)] = s.classes[c];
  return json;
}

Json lasParts(const std::filesystem::path& path) {
  // The header and VLRs; the census has found what of the rest cannot be read.
  const LasFile file(path, kLazAllFields, LasDamage::keep_intact);
  Json json;
  json["generating_software"] = file.header().generating_software;
  json["system"] = file.header().system_id;
  json["record_length"] = file.header().record_length;
  json["extra_fields"] = Json::array();
  for (const LasExtraField& field : file.extraFields())
    json["extra_fields"].push_back({{"name", field.name},
                                    {"description", field.description},
                                    {"type", lasExtraTypeName(field)},
                                    {"position", field.position}});
  json["vlrs"] = Json::array();
  for (const LasVlrEntry& vlr : file.vlrs())
    json["vlrs"].push_back({{"user", vlr.user_id},
                            {"record", vlr.record_id},
                            {"bytes", vlr.length},
                            {"extended", vlr.extended}});
  return json;
}

/// Lengths of one unit of the file in metres, and what states them; null where nothing does.
Json unitsJson(const PointFileInfo& info) {
  const auto unit = [](const LengthUnit& length, const std::string& source) {
    Json json{{"name", length.name}, {"metres", length.metres}, {"stated_by", nullptr}};
    if (!source.empty()) json["stated_by"] = source;
    return json;
  };
  if (info.crs_kind == CrsKind::geographic) return "degrees";
  return {{"horizontal", unit(info.units.horizontal, info.units.source)},
          {"vertical", unit(info.units.vertical, info.units.vertical_source)}};
}

Json fileJson(const FileInventory& file) {
  Json json;
  json["path"] = file.info.path.string();
  json["format"] = file.info.format;
  json["crs"] = file.info.crs;
  json["crs_ignored"] = file.info.crs_ignored;
  json["units"] = unitsJson(file.info);
  json["time_kind"] = timeKindName(file.info.time_kind);
  json["time_shift_s"] = file.info.time_shift;
  json["corrections"] = Json::array();
  for (const AppliedCorrection& correction : parseCorrections(file.info.corrections))
    json["corrections"].push_back(correction.describe());
  json["resolution"] = vector(file.info.resolution);
  json["coordinate_steps"] = vector(file.steps);
  json["header_minimum"] = vector(file.info.minimum);
  json["header_maximum"] = vector(file.info.maximum);
  if (file.info.format.rfind("LA", 0) == 0) json["las"] = lasParts(file.info.path);
  json["statistics"] = statistics(file.statistics);
  json["remarks"] = textsOf(file.remarks);
  return json;
}

Json stripJson(const DatasetInventory& survey, const StripInventory& strip) {
  Json json;
  json["id"] = strip.id;
  json["statistics"] = statistics(strip.statistics);
  json["density_per_m2"] = strip.density;
  json["area_m2"] = strip.area;
  json["recorded_with"] = nullptr;
  if (strip.recorded_with) json["recorded_with"] = survey.strips[*strip.recorded_with].id;
  json["gaps"] = Json::array();
  for (const TimeGap& gap : strip.gaps) json["gaps"].push_back({gap.from, gap.to});
  json["remarks"] = textsOf(strip.remarks);
  return json;
}

}  // namespace

std::string inventoryJson(const DatasetInventory& survey,
                          const std::vector<ExcludedPoints>& excluded,
                          const ListedTrajectory& flight) {
  Json json;
  json["format"] = "pcl_als info";
  json["version"] = 1;
  json["cell_m"] = survey.cell;
  json["files"] = Json::array();
  for (const FileInventory& file : survey.files) json["files"].push_back(fileJson(file));
  json["strips"] = Json::array();
  for (const StripInventory& strip : survey.strips)
    json["strips"].push_back(stripJson(survey, strip));
  json["left_out"] = excludedJson(excluded);
  json["overlaps"] = Json::array();
  for (const StripOverlap& overlap : survey.overlaps)
    json["overlaps"].push_back({{"a", survey.strips[overlap.a].id},
                                {"b", survey.strips[overlap.b].id},
                                {"area_m2", overlap.area}});
  json["area_m2_by_number_of_strips"] = survey.area_by_strips;
  json["duplicates"] = survey.duplicates;
  json["duplicates_estimated"] = survey.duplicates_estimated;
  json["remarks"] = textsOf(survey.remarks);
  detail::addFlight(json, flight);
  // Text fields of a file may hold bytes that are no UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pcl_als
