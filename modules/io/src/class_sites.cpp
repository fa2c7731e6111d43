// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cctype>
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/class_io.h>

#include "csv_table.h"

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

using Json = nlohmann::json;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<ClassSite> sitesOfCsv(const fs::path& path) {
  detail::CsvTable table(path);
  const std::size_t x = table.required("x"), y = table.required("y"),
                    name = table.required("class");
  std::vector<ClassSite> sites;
  while (table.next()) {
    ClassSite site;
    site.name = table.text(name);
    const std::string fault = classNameFault(site.name);
    if (!fault.empty()) table.refuse(name, fault);
    site.place = {table.number(x), table.number(y)};
    sites.push_back(std::move(site));
  }
  return sites;
}

/// The features of one GeoJSON file.
class GeoJsonSites {
 public:
  explicit GeoJsonSites(const fs::path& path) : name_(path.string()) {
    const Json json = Json::parse(readWholeFile(path, kJsonLimits), nullptr, false);
    if (json.is_discarded() || !json.is_object() || !json.contains("features") ||
        !json["features"].is_array())
      throw InputError(name_ + ": is no GeoJSON with features");
    for (const Json& feature : json["features"]) {
      ++feature_;
      addFeature(feature);
    }
    if (!sites.empty() && largest_ <= 180.0)
      throw InputError(name_ + ": its coordinates are degrees; reproject it to the points' CRS");
  }

  std::vector<ClassSite> sites;

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(name_ + ": feature " + std::to_string(feature_) + ": " + what);
  }

  void addFeature(const Json& feature) {
    if (!feature.is_object() || !feature.contains("geometry") || !feature.contains("properties") ||
        !feature["properties"].is_object() || !feature["properties"].contains("class"))
      refuse("has no geometry or no property 'class'");
    const Json& label = feature["properties"]["class"];
    ClassSite site;
    if (!label.is_string() && !label.is_number() && !label.is_boolean())
      refuse("its class is neither text nor number");
    site.name = label.is_string() ? trimmed(label.get<std::string>()) : label.dump();
    const std::string fault = classNameFault(site.name);
    if (!fault.empty()) refuse("its class name " + fault);
    const Json& geometry = feature["geometry"];
    if (!geometry.is_object() || !geometry.contains("type") || !geometry["type"].is_string() ||
        !geometry.contains("coordinates"))
      refuse("has no geometry");
    addGeometry(geometry["type"].get<std::string>(), geometry["coordinates"], site);
  }

  void addGeometry(const std::string& type, const Json& coordinates, ClassSite site) {
    if (!coordinates.is_array()) refuse("has no coordinates");
    if (type == "Point") {
      site.place = placeOf(coordinates);
      sites.push_back(site);
    } else if (type == "MultiPoint") {
      for (const Json& point : coordinates) addGeometry("Point", point, site);
    } else if (type == "Polygon") {
      for (const Json& ring : coordinates) site.rings.push_back(ringOf(ring));
      if (site.rings.empty()) refuse("is a polygon without rings");
      sites.push_back(site);
    } else if (type == "MultiPolygon") {
      for (const Json& polygon : coordinates) addGeometry("Polygon", polygon, site);
    } else {
      const bool word = type.size() <= 40 && std::all_of(type.begin(), type.end(), [](char c) {
                          return std::isalpha(static_cast<unsigned char>(c)) != 0;
                        });
      refuse((word ? "is a " + type : "has an unknown geometry") +
             "; points and polygons can be used");
    }
  }

  std::vector<Eigen::Vector2d> ringOf(const Json& coordinates) {
    std::vector<Eigen::Vector2d> ring;
    if (coordinates.is_array())
      for (const Json& point : coordinates) ring.push_back(placeOf(point));
    if (ring.size() < 4 || ring.front() != ring.back()) refuse("has a ring that is not closed");
    return ring;
  }

  Eigen::Vector2d placeOf(const Json& point) {
    if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number())
      refuse("has a position that is no pair of numbers");
    Eigen::Vector2d place(point[0].get<double>(), point[1].get<double>());
    if (!place.allFinite()) refuse("has a position that is not finite");
    largest_ = std::max(largest_, place.cwiseAbs().maxCoeff());
    return place;
  }

  std::string name_;
  std::size_t feature_ = 0;
  double largest_ = 0.0;
};

}  // namespace

std::vector<ClassSite> readClassSites(const fs::path& path, const LengthUnit& unit) {
  const std::string extension = lowerExtension(path);
  const bool json = extension == ".geojson" || extension == ".json";
  std::vector<ClassSite> sites = json ? GeoJsonSites(path).sites : sitesOfCsv(path);
  if (sites.empty()) throw InputError(path.string() + ": holds no sites");
  for (ClassSite& site : sites) {
    site.place *= unit.metres;
    for (auto& ring : site.rings)
      for (Eigen::Vector2d& corner : ring) corner *= unit.metres;
  }
  return sites;
}

}  // namespace pcl_als
