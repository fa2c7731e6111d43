// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/io/image_block_io.h>

#include "csv_table.h"
#include "json_node.h"
#include "json_parse.h"

namespace pcl_als {
namespace {

using detail::JsonNode;

constexpr const char* kFormat = "pcl_als camera";
constexpr std::array<const char*, 3> kRadial = {"k1_per_mm2", "k2_per_mm4", "k3_per_mm6"};
constexpr std::array<const char*, 2> kTangential = {"p1_per_mm", "p2_per_mm"};

Eigen::Vector2d pairOf(const JsonNode& node) {
  const std::vector<JsonNode> items = node.items();
  if (items.size() != 2) node.refuse("must be a list of two numbers");
  return {items[0].number(), items[1].number()};
}

double positive(const JsonNode& node) {
  const double value = node.number();
  if (value <= 0.0) node.refuse("must be more than 0");
  return value;
}

}  // namespace

FrameCamera readCamera(const std::filesystem::path& path) {
  const nlohmann::json json = detail::parseJson(detail::readWholeFile(path), path.string());
  const JsonNode root(json, path.string());
  if (!root.has("format") || root["format"].text() != kFormat)
    root.refuse(std::string("is no camera: 'format' must be \"") + kFormat + "\"");
  FrameCamera camera;
  if (root.has("name")) camera.name = root["name"].text();
  camera.focal_length = positive(root["focal_length_mm"]);
  if (root.has("principal_point_mm")) camera.principal_point = pairOf(root["principal_point_mm"]);
  if (root.has("pixel_size_mm")) {
    camera.pixel_size = positive(root["pixel_size_mm"]);
    camera.format = camera.pixel_size * pairOf(root["image_size_px"]);
  } else {
    camera.format = pairOf(root["image_size_mm"]);
  }
  if (camera.format.minCoeff() <= 0.0) root.refuse("has an image without size");
  if (camera.format.maxCoeff() > 20.0 * camera.focal_length ||
      camera.focal_length > 100.0 * camera.format.maxCoeff())
    root["focal_length_mm"].refuse("does not fit the size of the image: is its unit mm?");
  if (!root.has("distortion")) return camera;
  const JsonNode distortion = root["distortion"];
  for (std::size_t i = 0; i < kRadial.size(); ++i)
    if (distortion.has(kRadial[i])) camera.radial[i] = distortion[kRadial[i]].number();
  for (std::size_t i = 0; i < kTangential.size(); ++i)
    if (distortion.has(kTangential[i])) camera.tangential[i] = distortion[kTangential[i]].number();
  return camera;
}

void writeCamera(const std::filesystem::path& path, const FrameCamera& camera) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["version"] = 1;
  json["name"] = camera.name;
  json["focal_length_mm"] = camera.focal_length;
  json["principal_point_mm"] = {camera.principal_point.x(), camera.principal_point.y()};
  if (camera.pixel_size > 0.0) {
    json["pixel_size_mm"] = camera.pixel_size;
    json["image_size_px"] = {camera.format.x() / camera.pixel_size,
                             camera.format.y() / camera.pixel_size};
  } else {
    json["image_size_mm"] = {camera.format.x(), camera.format.y()};
  }
  for (std::size_t i = 0; i < kRadial.size(); ++i)
    json["distortion"][kRadial[i]] = camera.radial[i];
  for (std::size_t i = 0; i < kTangential.size(); ++i)
    json["distortion"][kTangential[i]] = camera.tangential[i];
  writeFile(path, json.dump(1) + "\n");
}

}  // namespace pcl_als
