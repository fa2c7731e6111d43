// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// The shapes of houses and trees.
#include <algorithm>
#include <cmath>

#include "layout.h"
#include "random.h"

namespace pcl_als::simulation {

int roofPolygonCount(const Building& building) {
  return building.pitch > 0.0 ? 2 : 1;
}

std::vector<Polygon> polygonsOf(const Building& building) {
  const Eigen::Vector3d along(std::cos(building.azimuth), std::sin(building.azimuth), 0.0);
  const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
  const auto corner = [&](double a, double c, double height) -> Eigen::Vector3d {
    return Eigen::Vector3d(building.centre.x(), building.centre.y(), height) + a * along +
           c * across;
  };
  const double rise = std::tan(building.pitch);
  const double a = 0.5 * building.length, c = 0.5 * building.width;
  const double roof_a = a + building.overhang, roof_c = c + building.overhang;
  const double ridge = building.eaves + c * rise, edge = building.eaves - building.overhang * rise;
  std::vector<Polygon> polygons;
  if (building.pitch > 0.0) {
    for (const double side : {-1.0, 1.0})
      polygons.push_back(
          Polygon({corner(-roof_a, 0.0, ridge), corner(roof_a, 0.0, ridge),
                   corner(roof_a, side * roof_c, edge), corner(-roof_a, side * roof_c, edge)}));
  } else {
    polygons.push_back(Polygon({corner(-roof_a, -roof_c, ridge), corner(roof_a, -roof_c, ridge),
                                corner(roof_a, roof_c, ridge), corner(-roof_a, roof_c, ridge)}));
  }
  const double floor = building.floor, eaves = building.eaves;
  for (const double side : {-1.0, 1.0}) {
    polygons.push_back(Polygon({corner(-a, side * c, floor), corner(a, side * c, floor),
                                corner(a, side * c, eaves), corner(-a, side * c, eaves)}));
    std::vector<Eigen::Vector3d> gable = {corner(side * a, -c, floor), corner(side * a, c, floor),
                                          corner(side * a, c, eaves)};
    if (building.pitch > 0.0) gable.push_back(corner(side * a, 0.0, ridge));
    gable.push_back(corner(side * a, -c, eaves));
    polygons.push_back(Polygon(gable));
  }
  return polygons;
}

void appendBalls(const Tree& tree, double ground, std::vector<Ball>& balls) {
  Random random(tree.key);
  const double radius = std::clamp(0.18 * tree.crown_radius, 0.35, 0.7);
  const double half_depth = 0.5 * tree.crown_depth;
  const Eigen::Vector3d middle(tree.place.x(), tree.place.y(), ground + tree.height - half_depth);
  // A vertical ray meets about 2.5 balls on its way through the crown.
  const double plan_share = tree.crown_radius * tree.crown_radius / (radius * radius);
  const auto count = static_cast<int>(std::lround(2.5 * plan_share));
  for (int placed = 0; placed < count;) {
    const Eigen::Vector3d in_unit(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                  random.uniform(-1.0, 1.0));
    if (in_unit.squaredNorm() > 1.0) continue;
    const Eigen::Vector3d reach(tree.crown_radius - radius, tree.crown_radius - radius,
                                half_depth - radius);
    balls.push_back({middle + in_unit.cwiseProduct(reach), radius * random.uniform(0.75, 1.25)});
    ++placed;
  }
}

}  // namespace pcl_als::simulation
