// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als::test {

/// What a pair of strips looks at, over 160 m x 160 m.
struct PairScene {
  double relief = 1.0;  ///< factor on the terrain's heights; 0: horizontal
  bool houses = true;   ///< 25 gable roofs, 4 to 7 m high, in all directions
  double trees = 0.03;  ///< share of the points that are up to 8 m above the ground
  double noise = 0.02;  ///< metres, of each coordinate along the beam (vertical)
};

/// A scene's height by formulas of its own; nothing of it is a plane but the roofs.
class PairTerrain {
 public:
  PairTerrain(const PairScene& scene, unsigned seed) : scene_(scene) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 6; ++i)
      waves_.push_back({0.02 + 0.06 * unit(random), 6.3 * unit(random), 6.3 * unit(random)});
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        houses_.push_back({16.0 + 32.0 * i + 6.0 * unit(random),
                           16.0 + 32.0 * j + 6.0 * unit(random), 3.2 * unit(random),
                           4.0 + 3.0 * unit(random), 0.4 + 0.5 * unit(random)});
  }

  double height(double x, double y) const {
    double ground = 0.0;
    for (const Wave& w : waves_)
      ground +=
          std::sin(w.frequency * (x * std::cos(w.course) + y * std::sin(w.course)) + w.phase) /
          (1.0 + 20.0 * w.frequency);
    ground *= 2.5 * scene_.relief;
    if (!scene_.houses) return ground;
    for (const House& h : houses_) {
      const double c = std::cos(h.course), s = std::sin(h.course);
      const double u = c * (x - h.x) + s * (y - h.y), v = -s * (x - h.x) + c * (y - h.y);
      if (std::abs(u) < 7.0 && std::abs(v) < 5.0)
        return std::max(ground, 3.0 + h.eaves - h.pitch * std::abs(v));
    }
    return ground;
  }

 private:
  struct Wave {
    double frequency, course, phase;
  };
  struct House {
    double x, y, course, eaves, pitch;
  };
  PairScene scene_;
  std::vector<Wave> waves_;
  std::vector<House> houses_;
};

/// Points of the scene, new places and noise for every seed.
inline std::vector<Eigen::Vector3d> stripPoints(const PairScene& scene, unsigned scene_seed,
                                                unsigned seed, int count) {
  const PairTerrain terrain(scene, scene_seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> plan(0.0, 160.0), unit(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& p : points) {
    p.x() = plan(random), p.y() = plan(random);
    p.z() = terrain.height(p.x(), p.y()) + scene.noise * noise(random);
    if (unit(random) < scene.trees) p.z() += 8.0 * unit(random);
  }
  return points;
}

/// A motion of \a shift metres in a random direction and up to \a degrees about each axis, about
/// the middle of the scene.
inline Eigen::Affine3d randomMotion(double shift, double degrees, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(-degrees, degrees);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::Vector3d direction(normal(random), normal(random), normal(random));
  direction *= shift / direction.norm();
  const double radians = 0.017453292519943295;
  const Eigen::Vector3d middle(80.0, 80.0, 2.0);
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(middle + direction);
  motion.rotate(Eigen::AngleAxisd(radians * angle(random), Eigen::Vector3d::UnitX()));
  motion.rotate(Eigen::AngleAxisd(radians * angle(random), Eigen::Vector3d::UnitY()));
  motion.rotate(Eigen::AngleAxisd(radians * angle(random), Eigen::Vector3d::UnitZ()));
  motion.translate(-middle);
  return motion;
}

inline std::vector<Eigen::Vector3d> moved(std::vector<Eigen::Vector3d> points,
                                          const Eigen::Affine3d& motion) {
  for (Eigen::Vector3d& p : points) p = motion * p;
  return points;
}

}  // namespace pcl_als::test
