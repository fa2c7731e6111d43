// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "random.h"

namespace pcl_als::simulation {

namespace {

double halfSwath(const PlannedLine& line, const SimulationOptions& options) {
  return line.height * std::tan(0.5 * options.scanner.field_of_view);
}

/// Largest angle between a pulse and the plane across the flight, radians.
double aheadAngle(const ScannerOptions& scanner) {
  if (!scanner.hasMirrorAngle()) return 0.5 * scanner.field_of_view;
  return scanner.type == ScannerType::cross ? 0.0 : scanner.channel_angle;
}

double turnAngle(const ScannerOptions& scanner) {
  return scanner.type == ScannerType::cross ? scanner.channel_angle : 0.0;
}

/// Bounding rectangle of the planned swaths.
std::pair<Eigen::Vector2d, Eigen::Vector2d> plannedRectangle(const SimulationOptions& options) {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e30), upper = -lower;
  for (const PlannedLine& line : options.lines) {
    const Eigen::Vector2d course = (line.end - line.start).normalized();
    const Eigen::Vector2d reach =
        halfSwath(line, options) * Eigen::Vector2d(std::abs(course.y()), std::abs(course.x()));
    lower = lower.cwiseMin(line.start.cwiseMin(line.end) - reach);
    upper = upper.cwiseMax(line.start.cwiseMax(line.end) + reach);
  }
  return {lower, upper};
}

/// Random places of the block: an endless sequence from a key.
class Places {
 public:
  Places(const SimulationOptions& options, std::uint64_t key)
      : random_(key), rectangle_(plannedRectangle(options)) {}
  Eigen::Vector2d next() {
    const double x = random_.uniform(rectangle_.first.x(), rectangle_.second.x());
    return {x, random_.uniform(rectangle_.first.y(), rectangle_.second.y())};
  }
  Random& random() { return random_; }

 private:
  Random random_;
  std::pair<Eigen::Vector2d, Eigen::Vector2d> rectangle_;
};

bool farFromAll(const Eigen::Vector2d& place, const std::vector<Eigen::Vector2d>& others,
                double distance) {
  return std::none_of(others.begin(), others.end(), [&](const Eigen::Vector2d& other) {
    return (other - place).norm() < distance;
  });
}

/// Metres from the edges of the swaths to control points and sites.
double marginOf(const SimulationOptions& options) {
  double margin = 20.0;
  for (const PlannedLine& line : options.lines)
    margin = std::min(margin, 0.2 * halfSwath(line, options));
  return margin;
}

/// Bare, clear of objects, not steep, under at least two swaths.
bool suitsControl(const Eigen::Vector2d& place, const Scene& scene,
                  const SimulationOptions& options) {
  const std::size_t wanted = std::min<std::size_t>(2, options.lines.size());
  if (swathsOver(place, options, marginOf(options)) < static_cast<int>(wanted)) return false;
  if (!scene.isOpen(place, 6.0)) return false;
  constexpr double kSteepest = 0.9848;  // cosine of 10 degrees
  return scene.terrain().normal(place.x(), place.y()).z() > kSteepest;
}

/// The cover seen from above where it is uniform around the place; otherwise none.
bool uniformCover(const Eigen::Vector2d& place, const Scene& scene, LandCover& cover) {
  cover = scene.topCover(place.x(), place.y());
  const double radius = cover == LandCover::tree ? 0.7 : 1.5;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * kPi * i;
    const LandCover there =
        scene.topCover(place.x() + radius * std::cos(angle), place.y() + radius * std::sin(angle));
    if (classNameOf(there) != classNameOf(cover)) return false;
  }
  return true;
}

}  // namespace

std::pair<Eigen::Vector2d, Eigen::Vector2d> sceneRectangle(const SimulationOptions& options) {
  auto [lower, upper] = plannedRectangle(options);
  double margin = 0.0;
  for (const PlannedLine& line : options.lines) {
    // Terrain up to 80 m (and the mountains) below the mean, the aircraft off its line, tilted and
    // crabbing.
    const double height = line.height + 80.0 + 1.5 * options.scene.mountains;
    const double tilt = std::abs(options.mean_pitch) + options.attitude_amplitude +
                        options.mounting.segment<3>(3).cwiseAbs().maxCoeff();
    const double half = height * std::tan(0.5 * options.scanner.field_of_view + tilt);
    const double aside = half - halfSwath(line, options);
    const double ahead = height * std::tan(tilt + aheadAngle(options.scanner)) +
                         half * std::sin(options.largest_crab + turnAngle(options.scanner));
    margin = std::max({margin, aside + 15.0, ahead + 15.0});
  }
  lower = ((lower.array() - margin) / 10.0).floor() * 10.0;
  upper = ((upper.array() + margin) / 10.0).ceil() * 10.0;
  return {lower, upper};
}

int swathsOver(const Eigen::Vector2d& place, const SimulationOptions& options, double margin) {
  int count = 0;
  for (const PlannedLine& line : options.lines) {
    const double length = (line.end - line.start).norm();
    const Eigen::Vector2d course = (line.end - line.start) / length;
    const Eigen::Vector2d from_start = place - line.start;
    const double along = from_start.dot(course);
    const double aside = std::abs(from_start.x() * course.y() - from_start.y() * course.x());
    if (along > margin && along < length - margin && aside < halfSwath(line, options) - margin)
      ++count;
  }
  return count;
}

namespace {

/// Calls \a take with places that suit control, spread over the block; fewer than \a count where
/// there is no room. \param least_upward vertical component of the normal of the ground
template <typename Take>
void spreadPlaces(const Scene& scene, const SimulationOptions& options, int count,
                  double least_upward, Places& places, const Take& take) {
  std::vector<Eigen::Vector2d> taken;
  const auto wanted = static_cast<std::size_t>(count);
  const auto [lower, upper] = plannedRectangle(options);
  double distance = std::sqrt((upper - lower).prod() / std::max<double>(1.0, count));
  constexpr int kTries = 4000;  // after which the points may be closer together
  for (int round = 0; round < 12 && taken.size() < wanted; ++round, distance *= 0.7)
    for (int i = 0; i < kTries && taken.size() < wanted; ++i) {
      const Eigen::Vector2d place = places.next();
      if (!farFromAll(place, taken, distance) || !suitsControl(place, scene, options)) continue;
      if (scene.terrain().normal(place.x(), place.y()).z() < least_upward) continue;
      taken.push_back(place);
      take(place);
    }
}

/// The id of control: "GCP01" and so on.
std::string numbered(const char* kind, std::size_t number) {
  char id[32];
  std::snprintf(id, sizeof id, "%s%02zu", kind, number);
  return id;
}

/// The board lies just above the highest ground under it.
Target targetAt(const Eigen::Vector2d& place, double radius, const Terrain& terrain) {
  constexpr double kClearance = 0.02;  // metres
  constexpr int kAround = 16;
  double highest = terrain.height(place.x(), place.y());
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * kPi * i / kAround;
    highest = std::max(highest, terrain.height(place.x() + radius * std::cos(angle),
                                               place.y() + radius * std::sin(angle)));
  }
  Target target;
  target.disc = {{place.x(), place.y(), highest + kClearance}, radius};
  return target;
}

void appendTargets(const Scene& scene, const SimulationOptions& options,
                   std::vector<ControlPoint>& points) {
  Random random(keyOf({options.seed, 0x7A63}));
  const double sigma = options.noise.control;
  for (std::size_t i = 0; i < scene.targets().size(); ++i) {
    const Disc& disc = scene.targets()[i].disc;
    ControlPoint& point = points.emplace_back();
    point.id = numbered("TGT", i + 1);
    point.kind = ControlPoint::Kind::target;
    point.diameter = 2.0 * disc.radius;
    point.position = options.origin + disc.centre;
    for (int axis = 0; axis < 3; ++axis) point.position[axis] += sigma * random.normal();
    point.sigma = point.sigma_plan = sigma;
  }
}

}  // namespace

std::vector<Target> chooseTargets(const Scene& scene, const SimulationOptions& options) {
  constexpr double kNearlyLevel = 0.9976;  // cosine of 4 degrees
  Places places(options, keyOf({options.seed, 0x7A62}));
  std::vector<Target> targets;
  spreadPlaces(scene, options, options.targets, kNearlyLevel, places,
               [&](const Eigen::Vector2d& place) {
                 targets.push_back(targetAt(place, 0.5 * options.target_diameter, scene.terrain()));
               });
  return targets;
}

std::vector<ControlPoint> chooseControlPoints(const Scene& scene,
                                              const SimulationOptions& options) {
  std::vector<ControlPoint> points;
  Places places(options, keyOf({options.seed, 0xC0}));
  spreadPlaces(scene, options, options.control_points, 0.0, places,
               [&](const Eigen::Vector2d& place) {
                 ControlPoint& point = points.emplace_back();
                 point.id = numbered("GCP", points.size());
                 const double height = scene.terrain().height(place.x(), place.y());
                 point.position = options.origin + Eigen::Vector3d(place.x(), place.y(), height);
                 point.position.z() += options.noise.control * places.random().normal();
                 point.sigma = options.noise.control;
               });
  appendTargets(scene, options, points);
  return points;
}

std::vector<LandCoverSite> chooseSites(const Scene& scene, const SimulationOptions& options,
                                       int per_class, int set) {
  std::vector<LandCoverSite> sites;
  std::map<std::string_view, int> count;
  Places places(options, keyOf({options.seed, 0x517E5, static_cast<std::uint64_t>(set)}));
  constexpr int kClasses = 4;
  const long tries = 2000L * per_class;
  for (long i = 0; i < tries && sites.size() < std::size_t(kClasses) * per_class; ++i) {
    const Eigen::Vector2d place = places.next();
    LandCover cover = LandCover::grass;
    if (swathsOver(place, options, marginOf(options)) < 1 || !uniformCover(place, scene, cover))
      continue;
    if (++count[classNameOf(cover)] > per_class) continue;
    sites.push_back({options.origin.x() + place.x(), options.origin.y() + place.y(), cover});
  }
  return sites;
}

}  // namespace pcl_als::simulation
