// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "random.h"

namespace pcl_als::simulation {

namespace {

constexpr double kMeshWidth = 110.0;   ///< metres between long streets
constexpr double kMeshLength = 330.0;  ///< metres between cross streets
constexpr double kRoadWidth = 7.0;
constexpr double kSetback = 18.0;  ///< from the middle of the street to that of the house
constexpr double kLot = 26.0;      ///< metres of street per house
constexpr double kSteepestLot = 0.22;

/// Keeps objects apart: circles in plan, indexed by cells.
class Occupancy {
 public:
  bool free(const Eigen::Vector2d& centre, double radius) const {
    const auto [column, row] = cellOf(centre);
    for (long j = row - 1; j <= row + 1; ++j)
      for (long i = column - 1; i <= column + 1; ++i) {
        const auto cell = cells_.find({i, j});
        if (cell == cells_.end()) continue;
        for (const auto& [other, other_radius] : cell->second)
          if ((other - centre).norm() < radius + other_radius) return false;
      }
    return true;
  }
  void take(const Eigen::Vector2d& centre, double radius) {
    cells_[cellOf(centre)].emplace_back(centre, radius);
  }

 private:
  static constexpr double kCell = 100.0;  ///< metres, more than two largest radii
  static std::pair<long, long> cellOf(const Eigen::Vector2d& place) {
    return {std::lround(std::floor(place.x() / kCell)), std::lround(std::floor(place.y() / kCell))};
  }
  std::map<std::pair<long, long>, std::vector<std::pair<Eigen::Vector2d, double>>> cells_;
};

/// From the lattice (u across the long streets, v along them) to the ground.
class Warp {
 public:
  explicit Warp(std::uint64_t seed) {
    Random random(keyOf({seed, 0x3A9}));
    const double turn = random.uniform(0.0, kPi);
    along_ = {std::cos(turn), std::sin(turn)};
    for (double& phase : phase_) phase = random.uniform(0.0, 2.0 * kPi);
  }
  Eigen::Vector2d operator()(double u, double v) const {
    const double x =
        u + 55.0 * std::sin(v / 85.0 + phase_[0]) + 18.0 * std::sin(v / 37.0 + phase_[1]);
    const double y = v + 30.0 * std::sin(u / 95.0 + phase_[2]);
    return {along_.x() * x - along_.y() * y, along_.y() * x + along_.x() * y};
  }

 private:
  Eigen::Vector2d along_;
  double phase_[3];
};

enum class Use { houses, hall, wood, open, blocks };

class Planner {
 public:
  Planner(const Terrain& terrain, const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
          const SceneOptions& options, std::uint64_t seed, CoverMap& cover)
      : terrain_(terrain),
        minimum_(minimum),
        maximum_(maximum),
        options_(options),
        seed_(seed),
        cover_(cover),
        warp_(seed) {}

  Layout run() {
    const double reach = std::max(minimum_.norm(), maximum_.norm()) + 120.0;
    const long meshes_across = std::lround(std::ceil(reach / kMeshWidth));
    const long meshes_along = std::lround(std::ceil(reach / kMeshLength));
    const auto eachMesh = [&](const auto& action) {
      for (long row = -meshes_along; row <= meshes_along; ++row)
        for (long column = -meshes_across; column <= meshes_across; ++column)
          if (reachesScene(column, row)) action(column, row);
    };
    eachMesh([&](long column, long row) { paintStreets(column, row); });
    eachMesh([&](long column, long row) { build(column, row); });
    eachMesh([&](long column, long row) { plant(column, row); });
    return std::move(layout_);
  }

 private:
  Random randomOf(long column, long row, std::uint64_t purpose) const {
    return Random(keyOf(
        {seed_, purpose, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)}));
  }
  Use useOf(long column, long row) const {
    if (randomOf(column, row, 0xC17).chance(options_.high_rises)) return Use::blocks;
    const double draw = randomOf(column, row, 0x05E).uniform();
    return draw < 0.52   ? Use::houses
           : draw < 0.62 ? Use::hall
           : draw < 0.71 ? Use::wood
                         : Use::open;
  }
  /// False for a mesh that is wholly outside: its middle is further away than it is long.
  bool reachesScene(long column, long row) const {
    return inside(warp_(kMeshWidth * (static_cast<double>(column) + 0.5),
                        kMeshLength * (static_cast<double>(row) + 0.5)),
                  -kMeshLength);
  }
  bool inside(const Eigen::Vector2d& place, double margin) const {
    return (place - minimum_).minCoeff() > margin && (maximum_ - place).minCoeff() > margin;
  }

  void paintStreets(long column, long row);
  void build(long column, long row);
  void buildHouse(double street_u, double v, double side, Random& random);
  void buildHall(long column, long row, Random& random);
  void buildBlocks(long column, long row, Random& random);
  bool place(Building& building, double storeys);
  void plant(long column, long row);

  const Terrain& terrain_;
  Eigen::Vector2d minimum_, maximum_;
  const SceneOptions& options_;
  std::uint64_t seed_;
  CoverMap& cover_;
  Warp warp_;
  Occupancy occupied_;
  Layout layout_;
};

void Planner::paintStreets(long column, long row) {
  const double u = kMeshWidth * static_cast<double>(column);
  const double v = kMeshLength * static_cast<double>(row);
  for (int metre = 0; metre < static_cast<int>(kMeshLength); ++metre)
    cover_.paintDisc(warp_(u, v + metre), 0.5 * kRoadWidth, LandCover::road);
  for (int metre = 0; metre < static_cast<int>(kMeshWidth); ++metre)
    cover_.paintDisc(warp_(u + metre, v), 0.5 * kRoadWidth, LandCover::road);
}

void Planner::build(long column, long row) {
  Random random = randomOf(column, row, 0xB17D);
  const Use use = useOf(column, row);
  if (use == Use::hall) buildHall(column, row, random);
  if (use == Use::blocks) buildBlocks(column, row, random);
  if (use != Use::houses) return;
  const double u = kMeshWidth * static_cast<double>(column);
  const double v = kMeshLength * static_cast<double>(row);
  for (int lot = 1; lot < static_cast<int>(kMeshLength / kLot); ++lot) {
    const double along = kLot * lot;
    buildHouse(u, v + along, 1.0, random);
    buildHouse(u + kMeshWidth, v + along + 0.5 * kLot, -1.0, random);
  }
}

void Planner::buildHouse(double street_u, double v, double side, Random& random) {
  // All draws come first: what one lot is does not shift what the next becomes.
  const double lot = random.uniform(), setback = kSetback + random.uniform(-2.0, 3.0);
  const double jitter = 8.0 * kRadiansPerDegree * random.normal();
  const bool turned = random.chance(0.3), flat = random.chance(0.2);
  Building house;
  house.length = random.uniform(10.0, 17.0);
  house.width = random.uniform(7.5, 11.0);
  house.pitch = flat ? 0.0 : random.uniform(15.0, 45.0) * kRadiansPerDegree;
  house.overhang = flat ? 0.0 : random.uniform(0.3, 0.8);
  house.roof_reflectance = static_cast<float>(random.uniform(0.12, 0.32));
  house.wall_reflectance = static_cast<float>(random.uniform(0.2, 0.45));
  const double storeys = random.uniform(2.6, 5.8);
  if (lot > 0.85 * options_.buildings) return;
  house.centre = warp_(street_u + side * setback, v);
  const Eigen::Vector2d street = warp_(street_u, v);
  const Eigen::Vector2d tangent = warp_(street_u, v + 1.0) - warp_(street_u, v - 1.0);
  house.azimuth = std::atan2(tangent.y(), tangent.x()) + jitter + (turned ? 0.5 * kPi : 0.0);
  if (!place(house, storeys)) return;
  const Eigen::Vector2d drive = house.centre - street;
  cover_.paintRectangle(0.5 * (house.centre + street), std::atan2(drive.y(), drive.x()),
                        drive.norm(), 3.0, LandCover::road);
}

void Planner::buildHall(long column, long row, Random& random) {
  Building hall;
  hall.length = random.uniform(35.0, 60.0);
  hall.width = random.uniform(20.0, 32.0);
  hall.overhang = 0.0;
  hall.roof_reflectance = static_cast<float>(random.uniform(0.15, 0.4));
  const double v = kMeshLength * (static_cast<double>(row) + random.uniform(0.3, 0.7));
  const double u = kMeshWidth * (static_cast<double>(column) + 0.5);
  const double storeys = random.uniform(5.0, 11.0);
  const bool ridged = random.chance(0.4);
  hall.pitch = ridged ? random.uniform(6.0, 14.0) * kRadiansPerDegree : 0.0;
  if (random.uniform() > options_.buildings) return;
  hall.centre = warp_(u, v);
  const Eigen::Vector2d tangent = warp_(u, v + 1.0) - warp_(u, v - 1.0);
  hall.azimuth = std::atan2(tangent.y(), tangent.x());
  if (!place(hall, storeys)) return;
  cover_.paintRectangle(hall.centre, hall.azimuth, hall.length + 34.0, hall.width + 26.0,
                        LandCover::road);
}

/// Three rows of blocks with flat roofs along the long streets of a mesh.
void Planner::buildBlocks(long column, long row, Random& random) {
  constexpr double kLowest = 12.0, kHighest = 90.0;
  for (const double aside : {kSetback, 0.5 * kMeshWidth, kMeshWidth - kSetback}) {
    const double u = kMeshWidth * static_cast<double>(column) + aside;
    for (int lot = 1; lot < static_cast<int>(kMeshLength / kLot); ++lot) {
      const double v = kMeshLength * static_cast<double>(row) + kLot * lot;
      Building block;
      block.length = random.uniform(14.0, 20.0);
      block.width = random.uniform(10.0, 15.0);
      block.overhang = 0.0;
      block.roof_reflectance = static_cast<float>(random.uniform(0.12, 0.35));
      block.wall_reflectance = static_cast<float>(random.uniform(0.2, 0.45));
      const double height = kLowest * std::pow(kHighest / kLowest, random.uniform());
      if (random.uniform() > options_.buildings) continue;
      block.centre = warp_(u, v);
      const Eigen::Vector2d tangent = warp_(u, v + 1.0) - warp_(u, v - 1.0);
      block.azimuth = std::atan2(tangent.y(), tangent.x());
      place(block, height);
    }
  }
}

/// Sets a building on the terrain; false where it is too steep or taken.
bool Planner::place(Building& building, double storeys) {
  const double radius = 0.5 * std::hypot(building.length, building.width) + building.overhang;
  if (!inside(building.centre, radius + 1.0) || !occupied_.free(building.centre, radius + 0.7))
    return false;
  const Eigen::Vector2d along(std::cos(building.azimuth), std::sin(building.azimuth));
  const Eigen::Vector2d across(-along.y(), along.x());
  double lowest = 1e30, highest = -1e30;
  constexpr int kSteps = 4;
  for (int i = -kSteps; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Eigen::Vector2d at =
          building.centre + along * (i * (0.5 * building.length + building.overhang) / kSteps) +
          across * (j * (0.5 * building.width + building.overhang) / kSteps);
      Eigen::Vector2d gradient;
      const double height = terrain_.height(at.x(), at.y(), gradient);
      if (gradient.norm() > kSteepestLot || cover_.at(at.x(), at.y()) == LandCover::road)
        return false;
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  building.floor = lowest - 1.0;
  building.eaves = highest + storeys + building.overhang * std::tan(building.pitch);
  occupied_.take(building.centre, radius);
  layout_.buildings.push_back(building);
  return true;
}

void Planner::plant(long column, long row) {
  Random random = randomOf(column, row, 0x73EE);
  const Use use = useOf(column, row);
  const double per_mesh = use == Use::wood ? 380.0 : use == Use::houses ? 26.0 : 12.0;
  const auto count = std::lround(per_mesh * options_.trees);
  for (long i = 0; i < count; ++i) {
    const double u = kMeshWidth * (static_cast<double>(column) + random.uniform());
    const double v = kMeshLength * (static_cast<double>(row) + random.uniform());
    Tree tree;
    tree.place = warp_(u, v);
    tree.crown_radius = random.uniform(1.5, use == Use::wood ? 3.2 : 4.2);
    tree.height = tree.crown_radius * random.uniform(2.4, 4.2) + 1.5;
    tree.crown_depth = random.uniform(0.55, 0.8) * tree.height;
    tree.key = keyOf({seed_, 0x1EAF, static_cast<std::uint64_t>(column),
                      static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(i)});
    if (!inside(tree.place, tree.crown_radius + 1.0) ||
        !occupied_.free(tree.place, tree.crown_radius + 0.5) ||
        cover_.at(tree.place.x(), tree.place.y()) == LandCover::road)
      continue;
    occupied_.take(tree.place, 0.5 * tree.crown_radius);
    layout_.trees.push_back(tree);
  }
}

}  // namespace

Layout layOut(const Terrain& terrain, const Eigen::Vector2d& minimum,
              const Eigen::Vector2d& maximum, const SceneOptions& options, std::uint64_t seed,
              CoverMap& cover) {
  return Planner(terrain, minimum, maximum, options, seed, cover).run();
}

}  // namespace pcl_als::simulation
