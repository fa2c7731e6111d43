// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <pcl_als/simulation/scene.h>

#include "cover_map.h"
#include "layout.h"
#include "object_grid.h"
#include "random.h"

namespace pcl_als::simulation {

std::string_view classNameOf(LandCover cover) {
  switch (cover) {
    case LandCover::grass:
      return "grass";
    case LandCover::soil:
      return "soil";
    case LandCover::tree:
      return "tree";
    case LandCover::road:
    case LandCover::building:
      break;
  }
  return "built-up";
}

std::uint8_t asprsClassOf(LandCover cover) {
  switch (cover) {
    case LandCover::road:
      return 11;
    case LandCover::building:
      return 6;
    case LandCover::tree:
      return 5;
    case LandCover::grass:
    case LandCover::soil:
      break;
  }
  return 2;
}

struct Scene::State {
  State(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, const SceneOptions& options,
        std::uint64_t scene_seed, std::vector<Target> placed)
      : minimum(lower),
        maximum(upper),
        seed(scene_seed),
        grass(options.grass),
        terrain(lower, upper, options.relief, scene_seed, options.mountains),
        cover(lower, upper, scene_seed),
        targets(std::move(placed)) {
    Layout layout = layOut(terrain, lower, upper, options, scene_seed, cover);
    buildings = std::move(layout.buildings);
    for (const Building& building : buildings) add(building);
    for (const Tree& tree : layout.trees) add(tree);
    tree_count = layout.trees.size();
    for (const Target& target : targets) {
      const Eigen::Vector3d& centre = target.disc.centre;
      const double above = centre.z() - terrain.height(centre.x(), centre.y());
      object_height = std::max(object_height, above + terrain.maximumSlope() * target.disc.radius);
    }
    makeGrid();
  }

  void add(const Building& building);
  void add(const Tree& tree);
  void makeGrid();
  void describe(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                SurfaceHit& hit) const;
  void collect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double ground,
               std::vector<SurfaceHit>& hits) const;
  bool isBall(std::uint32_t object) const {
    return object >= polygons.size() && object < polygons.size() + balls.size();
  }
  std::optional<double> rangeOf(std::uint32_t object, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const;
  /// Range from which a ray that intersects the terrain at a given range can intersect an object.
  double objectsFrom(const Eigen::Vector3d& direction, double ground) const {
    const double sideways = std::hypot(direction.x(), direction.y());
    const double descent = -direction.z() - terrain.maximumSlope() * sideways;
    return descent > 0.05 ? std::max(0.0, ground - object_height / descent) : 0.0;
  }

  Eigen::Vector2d minimum, maximum;
  std::uint64_t seed;
  double grass;  ///< metres, largest height
  Terrain terrain;
  CoverMap cover;
  std::vector<Building> buildings;
  std::vector<Polygon> polygons;
  std::vector<float> polygon_reflectance;
  std::vector<Ball> balls;
  std::vector<float> ball_reflectance;
  std::vector<Target> targets;
  std::size_t tree_count = 0;
  double object_height = 0.0;  ///< bound of the heights of all objects above the ground near them
  ObjectGrid grid;
};

void Scene::State::add(const Building& building) {
  const std::vector<Polygon> parts = polygonsOf(building);
  const auto roofs = static_cast<std::size_t>(roofPolygonCount(building));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    object_height = std::max(object_height, parts[i].maximum().z() - building.floor);
    polygons.push_back(parts[i]);
    polygon_reflectance.push_back(i < roofs ? building.roof_reflectance
                                            : building.wall_reflectance);
  }
}

void Scene::State::add(const Tree& tree) {
  const double ground = terrain.height(tree.place.x(), tree.place.y());
  appendBalls(tree, ground, balls);
  object_height = std::max(object_height, tree.height + terrain.maximumSlope() * tree.crown_radius);
  while (ball_reflectance.size() < balls.size()) {
    const Ball& ball = balls[ball_reflectance.size()];
    const double texture = textureAt(ball.centre.x(), ball.centre.y() + ball.centre.z(), seed);
    ball_reflectance.push_back(static_cast<float>(baseReflectance(LandCover::tree) * texture));
  }
}

void Scene::State::makeGrid() {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> boxes;
  boxes.reserve(polygons.size() + balls.size() + targets.size());
  for (const Polygon& p : polygons)
    boxes.emplace_back(p.minimum().head<2>(), p.maximum().head<2>());
  for (const Ball& b : balls) {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(b.radius);
    boxes.emplace_back(b.centre.head<2>() - reach, b.centre.head<2>() + reach);
  }
  for (const Target& t : targets) {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(t.disc.radius);
    boxes.emplace_back(t.disc.centre.head<2>() - reach, t.disc.centre.head<2>() + reach);
  }
  grid = ObjectGrid(minimum, maximum, boxes);
}

std::optional<double> Scene::State::rangeOf(std::uint32_t object, const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const {
  if (object < polygons.size()) return polygons[object].intersect(origin, direction);
  if (isBall(object)) return balls[object - polygons.size()].intersect(origin, direction);
  return targets[object - polygons.size() - balls.size()].disc.intersect(origin, direction);
}

void Scene::State::collect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                           double ground, std::vector<SurfaceHit>& hits) const {
  const auto visit = [&](const std::uint32_t* first, const std::uint32_t* last, double from,
                         double to) {
    for (; first != last; ++first) {
      const auto range = rangeOf(*first, origin, direction);
      if (!range || *range < from || *range >= to) continue;
      SurfaceHit& hit = hits.emplace_back();
      hit.range = *range;
      hit.object = *first;
      hit.opacity = isBall(*first) ? kBallOpacity : 1.0;
    }
  };
  grid.walk(origin, direction, objectsFrom(direction, ground), ground, visit);
  hits.emplace_back().range = ground;
  std::sort(hits.begin(), hits.end(), [](const SurfaceHit& a, const SurfaceHit& b) {
    return a.range != b.range ? a.range < b.range : a.object < b.object;
  });
  const auto opaque = std::find_if(hits.begin(), hits.end(),
                                   [](const SurfaceHit& hit) { return hit.opacity >= 1.0; });
  hits.erase(opaque + 1, hits.end());
}

void Scene::State::describe(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                            SurfaceHit& hit) const {
  const Eigen::Vector3d point = origin + hit.range * direction;
  if (hit.object == SurfaceHit::kGround) {
    hit.normal = terrain.normal(point.x(), point.y());
    hit.cover = cover.at(point.x(), point.y());
    hit.reflectance =
        static_cast<float>(baseReflectance(hit.cover) * textureAt(point.x(), point.y(), seed));
    if (grass > 0.0 && hit.cover == LandCover::grass)
      hit.range += grass * grassHeightAt(point.x(), point.y(), seed) / direction.z();
  } else if (hit.object < polygons.size()) {
    const Eigen::Vector3d& normal = polygons[hit.object].normal();
    hit.normal = normal.dot(direction) < 0.0 ? normal : Eigen::Vector3d(-normal);
    hit.cover = LandCover::building;
    hit.reflectance = static_cast<float>(polygon_reflectance[hit.object] *
                                         textureAt(point.x(), point.y() + point.z(), seed));
  } else if (!isBall(hit.object)) {
    hit.cover = cover.at(point.x(), point.y());
    hit.reflectance = targets[hit.object - polygons.size() - balls.size()].reflectance;
  } else {
    const Ball& ball = balls[hit.object - polygons.size()];
    hit.normal = (point - ball.centre) / ball.radius;
    hit.cover = LandCover::tree;
    hit.reflectance = ball_reflectance[hit.object - polygons.size()];
  }
}

Scene::Scene(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
             const SceneOptions& options, std::uint64_t seed, std::vector<Target> targets)
    : state_(std::make_unique<const State>(minimum, maximum, options, seed, std::move(targets))) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;

const Terrain& Scene::terrain() const {
  return state_->terrain;
}
const std::vector<Building>& Scene::buildings() const {
  return state_->buildings;
}
const std::vector<Polygon>& Scene::polygons() const {
  return state_->polygons;
}
const std::vector<Ball>& Scene::balls() const {
  return state_->balls;
}
const std::vector<Target>& Scene::targets() const {
  return state_->targets;
}
std::size_t Scene::treeCount() const {
  return state_->tree_count;
}
const Eigen::Vector2d& Scene::minimum() const {
  return state_->minimum;
}
const Eigen::Vector2d& Scene::maximum() const {
  return state_->maximum;
}

bool Scene::trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                  std::vector<SurfaceHit>& hits) const {
  hits.clear();
  const double ground = state_->terrain.intersect(origin, direction);
  const Eigen::Vector2d place = (origin + ground * direction).head<2>();
  if ((place - state_->minimum).minCoeff() < 0.0 || (state_->maximum - place).minCoeff() < 0.0)
    return false;
  state_->collect(origin, direction, ground, hits);
  for (SurfaceHit& hit : hits) state_->describe(origin, direction, hit);
  return true;
}

bool Scene::isOpen(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                   double ground_range, double radius) const {
  const double from = state_->objectsFrom(direction, ground_range);
  const Eigen::Vector2d a = (origin + from * direction).head<2>();
  const Eigen::Vector2d b = (origin + ground_range * direction).head<2>();
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius);
  return state_->grid.emptyIn(a.cwiseMin(b) - reach, a.cwiseMax(b) + reach);
}

bool Scene::isOpen(const Eigen::Vector2d& place, double radius) const {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius);
  return state_->grid.emptyIn(place - reach, place + reach);
}

LandCover Scene::groundCover(double x, double y) const {
  return state_->cover.at(x, y);
}

LandCover Scene::topCover(double x, double y) const {
  std::vector<SurfaceHit> hits;
  const Eigen::Vector3d above(x, y, state_->terrain.highest() + state_->object_height + 1.0);
  if (!trace(above, Eigen::Vector3d(0.0, 0.0, -1.0), hits)) return groundCover(x, y);
  return hits.front().cover;
}

}  // namespace pcl_als::simulation
