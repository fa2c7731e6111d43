// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/io/image_block_io.h>

#include "csv_table.h"

namespace pcl_als {
namespace {

using detail::CsvTable;

constexpr std::array<const char*, 4> kSigmas = {"sigma_plan_1", "sigma_height_1", "sigma_plan_2",
                                                "sigma_height_2"};
struct Correlation {
  const char* name;
  int row, column;
};
constexpr std::array<Correlation, 6> kCorrelations = {{{"r_p1h1", 0, 1},
                                                       {"r_p1p2", 0, 2},
                                                       {"r_p1h2", 0, 3},
                                                       {"r_h1p2", 1, 2},
                                                       {"r_h1h2", 1, 3},
                                                       {"r_p2h2", 2, 3}}};

double positive(const CsvTable& table, std::size_t column) {
  const double value = table.number(column);
  if (value <= 0.0) table.refuse(column, "must be more than 0 metres");
  return value;
}

/// Columns of the covariance of a line.
class CovarianceColumns {
 public:
  explicit CovarianceColumns(const CsvTable& table) : sigma_(table.optional("sigma")) {
    if (sigma_ == CsvTable::npos) {
      for (std::size_t i = 0; i < 4; ++i) sigmas_[i] = table.required(kSigmas[i]);
    }
    for (std::size_t i = 0; i < 6; ++i) correlations_[i] = table.optional(kCorrelations[i].name);
  }

  Eigen::Matrix4d read(const CsvTable& table) const {
    Eigen::Vector4d sigmas;
    for (int i = 0; i < 4; ++i)
      sigmas[i] =
          positive(table, sigma_ != CsvTable::npos ? sigma_ : sigmas_[static_cast<std::size_t>(i)]);
    Eigen::Matrix4d unit = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t column = correlations_[i];
      if (column == CsvTable::npos || table.text(column).empty()) continue;
      const double value = table.number(column);
      if (std::abs(value) >= 1.0) table.refuse(column, "is not between -1 and 1");
      unit(kCorrelations[i].row, kCorrelations[i].column) = value;
      unit(kCorrelations[i].column, kCorrelations[i].row) = value;
    }
    if (!CholeskyFactor(unit).succeeded())
      throw InputError(table.at("the correlations of the line exclude each other"));
    return sigmas.asDiagonal() * unit * sigmas.asDiagonal();
  }

 private:
  std::size_t sigma_;
  std::array<std::size_t, 4> sigmas_{};
  std::array<std::size_t, 6> correlations_{};
};

ObjectLine::Kind kindOf(const CsvTable& table, std::size_t column) {
  using Kind = ObjectLine::Kind;
  if (column == CsvTable::npos) return Kind::unknown;
  for (const Kind kind : {Kind::ridge, Kind::valley, Kind::eave}) {
    if (table.text(column) == nameOf(kind)) return kind;
  }
  return Kind::unknown;
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    if (to > from) found.emplace_back(text.substr(from, to - from));
    from = to + 1;
  }
  return found;
}

std::string joined(const std::vector<std::string>& strips) {
  std::string text;
  for (const std::string& strip : strips) text += (text.empty() ? "" : " ") + strip;
  return text;
}

void append(std::string& text, const char* format, double value) {
  char number[40];
  std::snprintf(number, sizeof number, format, value);
  text += number;
}

std::string csvOf(const std::vector<ObjectLine>& lines) {
  std::string text = "id,kind,x1,y1,z1,x2,y2,z2";
  for (const char* name : kSigmas) text += std::string(",") + name;
  for (const Correlation& c : kCorrelations) text += std::string(",") + c.name;
  text += ",strips\n";
  for (const ObjectLine& line : lines) {
    text += line.id + "," + nameOf(line.kind);
    for (int i = 0; i < 3; ++i) append(text, ",%.5f", line.start[i]);
    for (int i = 0; i < 3; ++i) append(text, ",%.5f", line.end[i]);
    const Eigen::Vector4d sigmas = line.covariance.diagonal().cwiseSqrt();
    for (int i = 0; i < 4; ++i) append(text, ",%.6f", sigmas[i]);
    for (const Correlation& c : kCorrelations)
      append(text, ",%.5f", line.covariance(c.row, c.column) / (sigmas[c.row] * sigmas[c.column]));
    text += "," + joined(line.strips) + "\n";
  }
  return text;
}

std::string geoJsonOf(const std::vector<ObjectLine>& lines, const std::string& crs) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["type"] = "FeatureCollection";
  const std::string prefix = "EPSG:";
  if (crs.compare(0, prefix.size(), prefix) == 0) {
    json["crs"] = {
        {"type", "name"},
        {"properties", {{"name", "urn:ogc:def:crs:EPSG::" + crs.substr(prefix.size())}}}};
  }
  json["features"] = Json::array();
  const auto place = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d millimetres = (p * 1000.0).array().round() / 1000.0;
    return Json{millimetres.x(), millimetres.y(), millimetres.z()};
  };
  for (const ObjectLine& line : lines) {
    Json feature;
    feature["type"] = "Feature";
    feature["geometry"] = {{"type", "LineString"},
                           {"coordinates", Json::array({place(line.start), place(line.end)})}};
    Json& properties = feature["properties"];
    properties["id"] = line.id;
    properties["kind"] = nameOf(line.kind);
    for (int i = 0; i < 4; ++i)
      properties[std::string(kSigmas[static_cast<std::size_t>(i)]) + "_m"] =
          std::sqrt(line.covariance(i, i));
    properties["strips"] = line.strips;
    json["features"].push_back(std::move(feature));
  }
  return json.dump(1) + "\n";
}

}  // namespace

std::string nameOf(ObjectLine::Kind kind) {
  switch (kind) {
    case ObjectLine::Kind::ridge:
      return "ridge";
    case ObjectLine::Kind::valley:
      return "valley";
    case ObjectLine::Kind::eave:
      return "eave";
    case ObjectLine::Kind::unknown:
      break;
  }
  return "";
}

std::vector<ObjectLine> readLines(const std::filesystem::path& path) {
  CsvTable table(path);
  const std::size_t id = table.required("id"), kind = table.optional("kind"),
                    strips = table.optional("strips");
  const std::array<std::size_t, 6> places = {table.required("x1"), table.required("y1"),
                                             table.required("z1"), table.required("x2"),
                                             table.required("y2"), table.required("z2")};
  const CovarianceColumns covariance(table);
  std::vector<ObjectLine> lines;
  std::set<std::string> ids;
  while (table.next()) {
    ObjectLine line;
    line.id = table.text(id);
    if (line.id.empty()) table.refuse(id, "must name the line");
    if (!ids.insert(line.id).second) table.refuse(id, "names two lines");
    for (int i = 0; i < 3; ++i) {
      line.start[i] = table.coordinate(places[static_cast<std::size_t>(i)]);
      line.end[i] = table.coordinate(places[static_cast<std::size_t>(i) + 3]);
    }
    const Eigen::Vector3d along = line.end - line.start;
    if (along.head<2>().norm() < 0.1 * along.norm() || along.norm() < 0.01)
      table.refuse(places[3], "gives a line that is vertical or has no length");
    line.kind = kindOf(table, kind);
    line.covariance = covariance.read(table);
    if (strips != CsvTable::npos) line.strips = words(table.text(strips));
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw InputError(path.string() + ": has a header but no lines");
  return lines;
}

void writeLines(const std::filesystem::path& path, const std::vector<ObjectLine>& lines,
                const std::string& crs) {
  writeFile(path, path.extension() == ".geojson" ? geoJsonOf(lines, crs) : csvOf(lines));
}

}  // namespace pcl_als
