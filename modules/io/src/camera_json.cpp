// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <cstring>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/field_node.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/io/json_text.h>

namespace pcl_als {
namespace {

constexpr const char* kFormat = "pcl_als camera";
constexpr int kVersion = 1;
constexpr std::array<const char*, 3> kRadial = {"k1_per_mm2", "k2_per_mm4", "k3_per_mm6"};
constexpr std::array<const char*, 2> kTangential = {"p1_per_mm", "p2_per_mm"};

/// Keys without effect are refused where they look like one that has.
void checkKeys(const FieldNode& root) {
  constexpr std::array<const char*, 5> kKeys = {"focal_length_mm", "principal_point_mm",
                                                "pixel_size_mm", "image_size_px", "image_size_mm"};
  for (const std::string& key : root.keys()) {
    for (const char* known : kKeys) {
      const std::string stem(known, std::strlen(known) - 3);
      if (key.compare(0, stem.size(), stem) == 0 &&
          std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
        root[key].refuse(std::string("is not known: is '") + known + "' meant?");
    }
  }
  if (!root.has("distortion")) return;
  for (const std::string& key : root["distortion"].keys()) {
    if (std::find(kRadial.begin(), kRadial.end(), key) == kRadial.end() &&
        std::find(kTangential.begin(), kTangential.end(), key) == kTangential.end())
      root["distortion"][key].refuse(
          "is not known: keys are k1_per_mm2, k2_per_mm4, k3_per_mm6, p1_per_mm, p2_per_mm");
  }
}

/// No camera displaces a corner of its image by more than this share of its distance.
constexpr double kMostDistortion = 0.5;

void checkDistortion(const FrameCamera& camera, const FieldNode& root) {
  for (const Eigen::Vector2d& sign : {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(-1.0, 1.0),
                                      Eigen::Vector2d(1.0, -1.0), Eigen::Vector2d(-1.0, -1.0)}) {
    const Eigen::Vector2d corner = 0.5 * sign.cwiseProduct(camera.format);
    const Eigen::Vector2d from = corner - camera.principal_point;
    const double moved = (camera.reduced(corner) - from).norm();
    if (moved <= kMostDistortion * from.norm()) continue;
    char text[120];
    std::snprintf(text, sizeof text,
                  "displaces a corner of the image by %.3g mm: do its coefficients refer to mm?",
                  moved);
    root["distortion"].refuse(text);
  }
}

Eigen::Vector2d pairOf(const FieldNode& node) {
  const std::vector<FieldNode> items = node.items();
  if (items.size() != 2) node.refuse("must be a list of two numbers");
  return {items[0].number(), items[1].number()};
}

double positive(const FieldNode& node) {
  const double value = node.number();
  if (value <= 0.0) node.refuse("must be more than 0");
  return value;
}

}  // namespace

FrameCamera readCamera(const std::filesystem::path& path) {
  const FieldValue file = parseJson(readWholeFile(path, kJsonLimits), path.string());
  const FieldNode root(file, path.string());
  if (!root.has("format") || root["format"].text() != kFormat)
    root.refuse(std::string("is no camera: 'format' must be \"") + kFormat + "\"");
  if (root.has("version") && root["version"].whole() != kVersion)
    root["version"].refuse("is not " + std::to_string(kVersion) + ", which can be read");
  checkKeys(root);
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
  if ((camera.principal_point.array().abs() > 0.5 * camera.format.array()).any())
    root["principal_point_mm"].refuse(
        "is outside the image: it is given in mm from the middle of the image");
  if (!root.has("distortion")) return camera;
  const FieldNode distortion = root["distortion"];
  for (std::size_t i = 0; i < kRadial.size(); ++i)
    if (distortion.has(kRadial[i])) camera.radial[i] = distortion[kRadial[i]].number();
  for (std::size_t i = 0; i < kTangential.size(); ++i)
    if (distortion.has(kTangential[i])) camera.tangential[i] = distortion[kTangential[i]].number();
  checkDistortion(camera, root);
  return camera;
}

void writeCamera(const std::filesystem::path& path, const FrameCamera& camera) {
  using List = FieldValue::List;
  FieldValue file, distortion;
  file.set("format", kFormat);
  file.set("version", kVersion);
  file.set("name", camera.name);
  file.set("focal_length_mm", camera.focal_length);
  file.set("principal_point_mm", List{camera.principal_point.x(), camera.principal_point.y()});
  if (camera.pixel_size > 0.0) {
    file.set("pixel_size_mm", camera.pixel_size);
    file.set("image_size_px",
             List{camera.format.x() / camera.pixel_size, camera.format.y() / camera.pixel_size});
  } else {
    file.set("image_size_mm", List{camera.format.x(), camera.format.y()});
  }
  for (std::size_t i = 0; i < kRadial.size(); ++i) distortion.set(kRadial[i], camera.radial[i]);
  for (std::size_t i = 0; i < kTangential.size(); ++i)
    distortion.set(kTangential[i], camera.tangential[i]);
  file.set("distortion", std::move(distortion));
  writeFile(path, jsonText(file));
}

}  // namespace pcl_als
