// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/image_flight.h>
#include <pcl_als/simulation/lidar_system.h>

#include "random.h"

namespace pcl_als::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = ImageMeasurement::Kind;

constexpr double kFromBorder = 0.3;     ///< mm that features are away from the border of an image
constexpr double kClearance = 0.1;      ///< metres before a feature that may be hidden
constexpr double kOpenRadius = 2.0;     ///< metres around a tie point without objects
constexpr double kShortestRidge = 4.0;  ///< metres
constexpr int kDistortionSteps = 20;

/// omega, phi, kappa of Rx(omega) Ry(phi) Rz(kappa).
Vector3d anglesOf(const Matrix3d& r) {
  return {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
          std::atan2(-r(0, 1), r(0, 0))};
}

/// A camera in the air, local frame. The axes of the image are those of the body: right, forward,
/// up.
struct Station {
  Vector3d position;
  Matrix3d ground_from_image;
  std::string id;
};

/// Takes the measurements of one block.
class Photographer {
 public:
  Photographer(const Scene& scene, const SimulationOptions& options,
               const ImageFlightOptions& flight)
      : scene_(scene), options_(options), flight_(flight), random_(keyOf({options.seed, 0x1A6E})) {}

  SimulatedImages run(const std::vector<ControlPoint>& check_points);

 private:
  void fly();
  void addLine(double x, bool north, int& number);
  void addTiePoints();
  void photograph(const std::string& id, const Vector3d& local);
  void photograph(const ObjectLine& ridge);
  std::optional<Vector2d> imageOf(const Station& station, const Vector3d& local) const;
  Vector2d distorted(const Vector2d& ideal) const;
  bool visible(const Station& station, const Vector3d& local) const;
  void measure(const Station& station, Kind kind, const std::string& feature, Vector2d place);

  const Scene& scene_;
  const SimulationOptions& options_;
  const ImageFlightOptions& flight_;
  Random random_;
  std::vector<Station> stations_;
  SimulatedImages images_;
};

void Photographer::fly() {
  const Vector2d size = scene_.maximum() - scene_.minimum();
  const Vector2d ground = flight_.camera.format * flight_.height / flight_.camera.focal_length;
  const double spacing = ground.x() * (1.0 - flight_.side_overlap);
  const auto lines = std::max(2L, std::lround(std::ceil(size.x() / spacing)));
  int number = 0;
  for (long line = 0; line < lines; ++line) {
    const double share = (static_cast<double>(line) + 0.5) / static_cast<double>(lines);
    addLine(scene_.minimum().x() + share * size.x(), line % 2 == 0, number);
  }
}

void Photographer::addLine(double x, bool north, int& number) {
  const double length = scene_.maximum().y() - scene_.minimum().y();
  const double base = flight_.camera.format.y() * flight_.height / flight_.camera.focal_length *
                      (1.0 - flight_.forward_overlap);
  const auto count = std::max(2L, std::lround(std::ceil(length / base)) + 1);
  const double motion = options_.vertical ? 0.0 : 2.0 * options_.attitude_amplitude;
  const double crab = options_.vertical ? 0.0 : 0.5 * options_.largest_crab;
  for (long i = 0; i < count; ++i) {
    const double along = length * static_cast<double>(i) / static_cast<double>(count - 1);
    Station station;
    station.position = {x + random_.uniform(-8.0, 8.0),
                        north ? scene_.minimum().y() + along : scene_.maximum().y() - along,
                        flight_.height + random_.uniform(-6.0, 6.0)};
    const double heading = (north ? 0.0 : kPi) + crab * random_.uniform(-1.0, 1.0);
    const double roll = random_.uniform(-motion, motion);
    station.ground_from_image = groundFromBody(roll, random_.uniform(-motion, motion), heading);
    station.id = "I" + std::to_string(++number);
    ImageOrientation truth;
    truth.id = station.id;
    truth.position = options_.origin + station.position;
    truth.angles = anglesOf(station.ground_from_image);
    ImageOrientation approximate = truth;
    for (int axis = 0; axis < 3; ++axis) {
      approximate.position[axis] += flight_.position_error * random_.normal();
      approximate.angles[axis] += flight_.angle_error * random_.normal();
    }
    images_.truth.push_back(truth);
    images_.approximate.push_back(approximate);
    stations_.push_back(std::move(station));
  }
}

Vector2d Photographer::distorted(const Vector2d& ideal) const {
  const FrameCamera& camera = flight_.camera;
  Vector2d measured = ideal + camera.principal_point;
  for (int i = 0; i < kDistortionSteps; ++i) measured += ideal - camera.reduced(measured);
  return measured;
}

std::optional<Vector2d> Photographer::imageOf(const Station& station, const Vector3d& local) const {
  const Vector3d ray = station.ground_from_image.transpose() * (local - station.position);
  if (ray.z() > -1.0) return std::nullopt;
  const Vector2d ideal = -flight_.camera.focal_length * ray.head<2>() / ray.z();
  const Eigen::Array2d most = 0.5 * flight_.camera.format.array() - kFromBorder;
  if ((ideal.array().abs() > most).any()) return std::nullopt;
  const Vector2d measured = distorted(ideal);
  if ((measured.array().abs() > most).any()) return std::nullopt;
  return measured;
}

bool Photographer::visible(const Station& station, const Vector3d& local) const {
  const Vector3d ray = local - station.position;
  const double distance = ray.norm();
  std::vector<SurfaceHit> hits;
  if (!scene_.trace(station.position, ray / distance, hits)) return false;
  return hits.front().range > distance - kClearance;
}

void Photographer::measure(const Station& station, Kind kind, const std::string& feature,
                           Vector2d place) {
  const double pixel = flight_.camera.unit();
  const double noise = pixel * (kind == Kind::line ? flight_.line_noise : flight_.noise);
  for (int axis = 0; axis < 2; ++axis) place[axis] += noise * random_.normal();
  // Exact coordinates are given a small standard deviation: there is no weight without one.
  images_.measurements.push_back(
      {station.id, feature, kind, place, noise > 0.0 ? noise : 0.1 * pixel});
}

void Photographer::photograph(const std::string& id, const Vector3d& local) {
  std::vector<std::pair<const Station*, Vector2d>> seen;
  for (const Station& station : stations_) {
    const auto place = imageOf(station, local);
    if (place && visible(station, local)) seen.emplace_back(&station, *place);
  }
  if (seen.size() < 2) return;
  for (const auto& [station, place] : seen) measure(*station, Kind::point, id, place);
  images_.true_points.push_back({id, options_.origin + local, 0.0});
}

void Photographer::addTiePoints() {
  const Vector2d size = scene_.maximum() - scene_.minimum();
  const auto columns = static_cast<int>(size.x() / flight_.tie_spacing);
  const auto rows = static_cast<int>(size.y() / flight_.tie_spacing);
  int number = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vector2d place =
          scene_.minimum() + flight_.tie_spacing * Vector2d(column + random_.uniform(0.1, 0.9),
                                                            row + random_.uniform(0.1, 0.9));
      const std::string id = "T" + std::to_string(++number);
      if (!scene_.isOpen(place, kOpenRadius)) continue;
      photograph(id, {place.x(), place.y(), scene_.terrain().height(place.x(), place.y())});
    }
  }
}

void Photographer::photograph(const ObjectLine& ridge) {
  const Vector3d start = ridge.start - options_.origin, end = ridge.end - options_.origin;
  for (const Station& station : stations_) {
    std::vector<Vector2d> places;
    for (int i = 0; i < flight_.places_per_line; ++i) {
      const double share = random_.uniform(0.03, 0.97);
      const Vector3d local = start + share * (end - start);
      const auto place = imageOf(station, local);
      if (place && visible(station, local)) places.push_back(*place);
    }
    if (places.size() < 2) continue;
    for (const Vector2d& place : places) measure(station, Kind::line, ridge.id, place);
  }
}

SimulatedImages Photographer::run(const std::vector<ControlPoint>& check_points) {
  images_.camera = flight_.camera;
  fly();
  addTiePoints();
  for (const ControlPoint& point : check_points) {
    Vector3d local = point.position - options_.origin;
    local.z() = scene_.terrain().height(local.x(), local.y());  // without the error of the survey
    const std::size_t before = images_.true_points.size();
    photograph(point.id, local);
    if (images_.true_points.size() > before) images_.check_points.push_back(point);
  }
  images_.ridges = ridgesOf(scene_, options_.origin);
  for (const ObjectLine& ridge : images_.ridges) photograph(ridge);
  return std::move(images_);
}

}  // namespace

FrameCamera ImageFlightOptions::standardCamera() {
  FrameCamera camera;
  camera.name = "simulated 100 mm";
  camera.focal_length = 100.5;
  camera.pixel_size = 0.006;
  camera.format = camera.pixel_size * Vector2d(9000.0, 6732.0);
  camera.principal_point = {0.021, -0.013};
  camera.radial = {2.0e-6, -6.0e-10, 0.0};
  camera.tangential = {1.5e-7, -1.0e-7};
  return camera;
}

std::vector<ObjectLine> ridgesOf(const Scene& scene, const Vector3d& origin) {
  std::vector<ObjectLine> ridges;
  int number = 0;
  for (const Building& building : scene.buildings()) {
    ++number;
    if (building.pitch <= 0.0) continue;
    const Vector3d along(std::cos(building.azimuth), std::sin(building.azimuth), 0.0);
    const double reach = 0.5 * building.length + building.overhang;
    const double height = building.eaves + 0.5 * building.width * std::tan(building.pitch);
    const Vector3d middle = origin + Vector3d(building.centre.x(), building.centre.y(), height);
    if (2.0 * reach < kShortestRidge) continue;
    ObjectLine ridge;
    ridge.id = "R" + std::to_string(number);
    ridge.kind = ObjectLine::Kind::ridge;
    ridge.start = middle - reach * along;
    ridge.end = middle + reach * along;
    ridges.push_back(ridge);
  }
  return ridges;
}

SimulatedImages simulateImages(const Scene& scene, const SimulationOptions& options,
                               const ImageFlightOptions& flight,
                               const std::vector<ControlPoint>& check_points) {
  if (flight.height < 50.0 + scene.terrain().highest())
    throw UsageError("simulation: the images are taken below the highest terrain");
  return Photographer(scene, options, flight).run(check_points);
}

}  // namespace pcl_als::simulation
