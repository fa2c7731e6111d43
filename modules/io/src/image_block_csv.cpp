// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/image_block_io.h>

#include "csv_table.h"

namespace pcl_als {
namespace {

using detail::CsvTable;

/// Share of the image that coordinates may be beyond its border.
constexpr double kBeyond = 0.02;
/// Coordinates of all images together that cover less of the format have another unit: a tenth, cm
/// instead of mm. Images that overlap less than 88 % cannot have the same point in so small a part.
constexpr double kLeastCovered = 0.12;

/// A standard deviation in the image is between these shares of its width.
constexpr double kLeastSigma = 1e-6, kMostSigma = 0.1;
/// Standard deviations of coordinates where nothing states one.
constexpr double kDefaultPixels = 0.5, kDefaultMillimetres = 0.003;

double angle(const CsvTable& table, std::size_t column) {
  const double value = table.number(column);
  if (std::abs(value) > 720.0) table.refuse(column, "is not an angle in degrees");
  return value * kRadiansPerDegree;
}

/// A standard deviation; 0 where the column or the field is missing.
double sigmaOf(const CsvTable& table, std::size_t column) {
  if (column == CsvTable::npos || table.text(column).empty()) return 0.0;
  const double value = table.number(column);
  if (value < 0.0) table.refuse(column, "must not be negative");
  return value;
}

std::string idOf(const CsvTable& table, std::size_t column) {
  std::string id(table.text(column));
  if (id.empty()) table.refuse(column, "must not be empty");
  return id;
}

void checkInside(const CsvTable& table, std::size_t column, const Eigen::Vector2d& mm,
                 const FrameCamera& camera) {
  const Eigen::Array2d most = (0.5 + kBeyond) * camera.format.array();
  if ((mm.array().abs() <= most).all()) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "is outside the image of %g x %g %s: the coordinates have another unit, or belong "
                "to another camera",
                camera.format.x() / camera.unit(), camera.format.y() / camera.unit(),
                camera.unitName());
  table.refuse(column, text);
}

/// Refuses a record that gives a measurement a second time: a point once in an image, each place on
/// a line once.
void checkSingle(const CsvTable& table, std::size_t column, const ImageMeasurement& m,
                 std::set<std::string>& known) {
  std::string key = m.image + '\n' + m.feature;
  if (m.kind == ImageMeasurement::Kind::line)
    key += '\n' + std::to_string(m.position.x()) + '\n' + std::to_string(m.position.y());
  if (known.insert(std::move(key)).second) return;
  table.refuse(column, "is measured twice in image " + m.image +
                           (m.kind == ImageMeasurement::Kind::line ? ", at the same place" : ""));
}

double imageSigma(const CsvTable& table, std::size_t column, const FrameCamera& camera,
                  double otherwise) {
  const double given = sigmaOf(table, column);
  const double mm = camera.unit() * (given > 0.0 ? given : otherwise);
  const double width = camera.format.maxCoeff();
  if (given > 0.0 && (mm < kLeastSigma * width || mm > kMostSigma * width))
    table.refuse(column, std::string("is not a standard deviation of image coordinates in ") +
                             camera.unitName());
  return mm;
}

void checkCoverage(const std::filesystem::path& path, const FrameCamera& camera,
                   const std::vector<ImageMeasurement>& measurements) {
  Eigen::AlignedBox2d box;
  for (const ImageMeasurement& m : measurements) box.extend(m.position);
  const double share = (box.sizes().array() / camera.format.array()).maxCoeff();
  if (measurements.size() < 3 || share >= kLeastCovered) return;
  char text[160];
  std::snprintf(text, sizeof text,
                ": all coordinates are within %.2g %% of the image: their unit is not %s, or they "
                "belong to another camera",
                100.0 * share, camera.unitName());
  throw InputError(path.string() + text);
}

}  // namespace

std::vector<ImageOrientation> readImages(const std::filesystem::path& path) {
  CsvTable table(path);
  const std::size_t id = table.required("image"), x = table.required("x"), y = table.required("y"),
                    z = table.required("z"), omega = table.required("omega"),
                    phi = table.required("phi"), kappa = table.required("kappa"),
                    position_sigma = table.optional("sigma_position"),
                    angle_sigma = table.optional("sigma_angle");
  std::vector<ImageOrientation> images;
  std::set<std::string> ids;
  while (table.next()) {
    ImageOrientation image;
    image.id = idOf(table, id);
    if (!ids.insert(image.id).second) table.refuse(id, "names two images");
    image.position = {table.coordinate(x), table.coordinate(y), table.coordinate(z)};
    image.angles = {angle(table, omega), angle(table, phi), angle(table, kappa)};
    image.position_sigma = sigmaOf(table, position_sigma);
    image.angle_sigma = sigmaOf(table, angle_sigma) * kRadiansPerDegree;
    images.push_back(image);
  }
  if (images.empty()) throw InputError(path.string() + ": has a header but no images");
  return images;
}

void writeImages(const std::filesystem::path& path, const std::vector<ImageOrientation>& images) {
  std::string text = "image,x,y,z,omega,phi,kappa,sigma_position,sigma_angle\n";
  for (const ImageOrientation& image : images) {
    char line[200];
    const Eigen::Vector3d degrees = image.angles / kRadiansPerDegree;
    std::snprintf(line, sizeof line, ",%.5f,%.5f,%.5f,%.9f,%.9f,%.9f,", image.position.x(),
                  image.position.y(), image.position.z(), degrees.x(), degrees.y(), degrees.z());
    text += image.id + line;
    if (image.position_sigma > 0.0) {
      std::snprintf(line, sizeof line, "%.4f", image.position_sigma);
      text += line;
    }
    text += ",";
    if (image.angle_sigma > 0.0) {
      std::snprintf(line, sizeof line, "%.6f", image.angle_sigma / kRadiansPerDegree);
      text += line;
    }
    text += "\n";
  }
  writeFile(path, text);
}

std::vector<ImageMeasurement> readMeasurements(const std::filesystem::path& path,
                                               const FrameCamera& camera, double sigma) {
  CsvTable table(path);
  const std::size_t image = table.required("image"), kind = table.required("kind"),
                    feature = table.required("feature"), x = table.required("x"),
                    y = table.required("y"), sigma_column = table.optional("sigma");
  if (sigma <= 0.0) sigma = camera.pixel_size > 0.0 ? kDefaultPixels : kDefaultMillimetres;
  std::vector<ImageMeasurement> measurements;
  std::set<std::string> known;
  while (table.next()) {
    ImageMeasurement m;
    m.image = idOf(table, image);
    m.feature = idOf(table, feature);
    if (table.text(kind) != "point" && table.text(kind) != "line")
      table.refuse(kind, "is neither point nor line");
    m.kind =
        table.text(kind) == "line" ? ImageMeasurement::Kind::line : ImageMeasurement::Kind::point;
    m.position = camera.fromFile({table.number(x), table.number(y)});
    checkInside(table, x, m.position, camera);
    checkSingle(table, feature, m, known);
    m.sigma = imageSigma(table, sigma_column, camera, sigma);
    measurements.push_back(std::move(m));
  }
  if (measurements.empty()) throw InputError(path.string() + ": has a header but no coordinates");
  checkCoverage(path, camera, measurements);
  return measurements;
}

void writeMeasurements(const std::filesystem::path& path, const FrameCamera& camera,
                       const std::vector<ImageMeasurement>& measurements) {
  std::string text = "image,kind,feature,x,y,sigma\n";
  for (const ImageMeasurement& m : measurements) {
    const Eigen::Vector2d given = camera.toFile(m.position);
    char line[120];
    std::snprintf(line, sizeof line, ",%.5f,%.5f,%.5g\n", given.x(), given.y(),
                  m.sigma / camera.unit());
    text += m.image + (m.kind == ImageMeasurement::Kind::line ? ",line," : ",point,") + m.feature +
            line;
  }
  writeFile(path, text);
}

}  // namespace pcl_als
