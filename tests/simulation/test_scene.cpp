// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <pcl_als/simulation/scene.h>

namespace {

using namespace pcl_als::simulation;

const Scene& suburb() {
  static const Scene scene({-300.0, -250.0}, {300.0, 250.0}, SceneOptions(), 3);
  return scene;
}

struct Ray {
  Eigen::Vector3d origin, direction;
};

/// From 600 m, at most 30 degrees from the vertical, to a place of the scene.
Ray rayTo(const Eigen::Vector3d& target, std::mt19937& engine) {
  std::uniform_real_distribution<double> slope(-0.4, 0.4);
  const Eigen::Vector3d up(slope(engine), slope(engine), 1.0);
  const Eigen::Vector3d origin = target + 600.0 * up;
  return {origin, (target - origin).normalized()};
}

Eigen::Vector3d randomTarget(std::mt19937& engine) {
  std::uniform_real_distribution<double> x(-290.0, 290.0), y(-240.0, 240.0), choice(0.0, 1.0);
  const Scene& scene = suburb();
  const double draw = choice(engine);
  if (draw < 0.3) {  // houses and trees are a tenth of the area: look there more often
    const auto& b = scene.buildings()[engine() % scene.buildings().size()];
    std::normal_distribution<double> near(0.0, 6.0);
    return {b.centre.x() + near(engine), b.centre.y() + near(engine), b.eaves};
  }
  if (draw < 0.6) return scene.balls()[engine() % scene.balls().size()].centre;
  const double px = x(engine), py = y(engine);
  return {px, py, scene.terrain().height(px, py)};
}

/// All surfaces tried one after the other, without the grid.
std::vector<std::pair<double, std::uint32_t>> bruteForce(const Scene& scene, const Ray& ray) {
  std::vector<std::pair<double, std::uint32_t>> all;
  const double ground = scene.terrain().intersect(ray.origin, ray.direction);
  std::uint32_t object = 0;
  double opaque = ground;
  for (const Polygon& polygon : scene.polygons()) {
    if (const auto range = polygon.intersect(ray.origin, ray.direction))
      all.emplace_back(*range, object), opaque = std::min(opaque, *range);
    ++object;
  }
  for (const Ball& ball : scene.balls()) {
    if (const auto range = ball.intersect(ray.origin, ray.direction))
      all.emplace_back(*range, object);
    ++object;
  }
  all.emplace_back(ground, SurfaceHit::kGround);
  all.erase(std::remove_if(all.begin(), all.end(), [&](auto& h) { return h.first > opaque; }),
            all.end());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Scene, TraceEqualsBruteForce) {
  std::mt19937 engine(11);
  std::vector<SurfaceHit> hits;
  std::size_t on_polygons = 0, on_balls = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = rayTo(randomTarget(engine), engine);
    if (!suburb().trace(ray.origin, ray.direction, hits)) continue;
    const auto expected = bruteForce(suburb(), ray);
    ASSERT_EQ(hits.size(), expected.size()) << "ray " << i;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].range, expected[k].first);
      EXPECT_EQ(hits[k].object, expected[k].second);
      const bool ground = hits[k].object == SurfaceHit::kGround;
      (hits[k].object < suburb().polygons().size() ? on_polygons : on_balls) += ground ? 0 : 1;
    }
  }
  EXPECT_GT(on_polygons, 400U);
  EXPECT_GT(on_balls, 1000U);
}

TEST(Scene, VerticalRayMeetsTheRoofWhereItsPitchSays) {
  int checked = 0;
  std::vector<SurfaceHit> hits;
  for (const Building& b : suburb().buildings()) {
    // A quarter of the width from the ridge.
    const Eigen::Vector2d across(-std::sin(b.azimuth), std::cos(b.azimuth));
    const Eigen::Vector2d p = b.centre + 0.25 * b.width * across;
    ASSERT_TRUE(suburb().trace({p.x(), p.y(), 500.0}, {0.0, 0.0, -1.0}, hits));
    if (hits.front().cover == LandCover::tree) continue;
    const double expected = b.eaves + 0.25 * b.width * std::tan(b.pitch);
    EXPECT_NEAR(500.0 - hits.front().range, expected, 1e-9);
    EXPECT_NEAR(hits.front().normal.z(), std::cos(b.pitch), 1e-12);
    EXPECT_EQ(hits.front().cover, LandCover::building);
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

TEST(Scene, HouseStandsOnTheGround) {
  for (const Building& b : suburb().buildings()) {
    const double ground = suburb().terrain().height(b.centre.x(), b.centre.y());
    EXPECT_LT(b.floor, ground);
    EXPECT_GT(b.eaves, ground + 2.0);
    EXPECT_LT(b.eaves, ground + 20.0);
  }
}

TEST(Scene, RoofsHaveManyAzimuthsAndPitches) {
  std::set<int> azimuths, pitches;
  std::size_t flat = 0;
  for (const Building& b : suburb().buildings()) {
    azimuths.insert(static_cast<int>(std::floor(b.azimuth * 180.0 / M_PI / 20.0)));
    pitches.insert(static_cast<int>(b.pitch * 180.0 / M_PI / 10.0));
    flat += b.pitch == 0.0 ? 1 : 0;
  }
  EXPECT_GE(azimuths.size(), 6U);
  EXPECT_GE(pitches.size(), 4U);
  EXPECT_GT(flat, 0U);
  EXPECT_LT(flat, suburb().buildings().size() / 2);
}

TEST(Scene, NormalsFaceTheRay) {
  std::mt19937 engine(12);
  std::vector<SurfaceHit> hits;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = rayTo(randomTarget(engine), engine);
    if (!suburb().trace(ray.origin, ray.direction, hits)) continue;
    for (const SurfaceHit& hit : hits) {
      EXPECT_NEAR(hit.normal.norm(), 1.0, 1e-6);  // a ball's is a difference at 1000 m over 0.3 m
      EXPECT_LE(hit.normal.dot(ray.direction), 1e-6);
      EXPECT_GT(hit.reflectance, 0.03F);
      EXPECT_LT(hit.reflectance, 0.9F);
    }
    EXPECT_EQ(hits.back().opacity, 1.0);
  }
}

TEST(Scene, OpenMeansThatNothingStandsNear) {
  std::mt19937 engine(13);
  std::vector<SurfaceHit> hits;
  std::size_t open = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = rayTo(randomTarget(engine), engine);
    const double ground = suburb().terrain().intersect(ray.origin, ray.direction);
    if (!suburb().isOpen(ray.origin, ray.direction, ground, 0.5)) continue;
    ++open;
    for (const Eigen::Vector3d& aside : {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0, -0.5, 0)})
      if (suburb().trace(ray.origin + aside, ray.direction, hits)) {
        EXPECT_EQ(hits.front().object, SurfaceHit::kGround);
      }
  }
  EXPECT_GT(open, 300U);
}

TEST(Scene, AllCoversOccurAndRoadsAreOnTheGround) {
  std::set<LandCover> covers;
  for (double y = -240.0; y < 240.0; y += 2.0)
    for (double x = -290.0; x < 290.0; x += 2.0) covers.insert(suburb().topCover(x, y));
  EXPECT_EQ(covers.size(), 5U);
  EXPECT_EQ(classNameOf(LandCover::road), "built-up");
  EXPECT_EQ(asprsClassOf(LandCover::road), 11);
  EXPECT_EQ(asprsClassOf(LandCover::building), 6);
  EXPECT_EQ(asprsClassOf(LandCover::tree), 5);
  EXPECT_EQ(asprsClassOf(LandCover::soil), 2);
}

TEST(Scene, MissesOutsideItsRectangle) {
  std::vector<SurfaceHit> hits;
  EXPECT_FALSE(suburb().trace({301.0, 0.0, 500.0}, {0.0, 0.0, -1.0}, hits));
  EXPECT_TRUE(hits.empty());
}

TEST(Scene, CanBeEmptyAndFlat) {
  SceneOptions options;
  options.relief = options.buildings = options.trees = 0.0;
  const Scene scene({-100.0, -100.0}, {100.0, 100.0}, options, 1);
  EXPECT_TRUE(scene.polygons().empty());
  EXPECT_TRUE(scene.balls().empty());
  std::vector<SurfaceHit> hits;
  ASSERT_TRUE(scene.trace({0.0, 0.0, 500.0}, {0.0, 0.6, -0.8}, hits) == false);  // 375 m north
  ASSERT_TRUE(scene.trace({0.0, -300.0, 500.0}, {0.0, 0.6, -0.8}, hits));
  EXPECT_NEAR(hits.front().range, 625.0, 1e-9);
}

// Rays that meet grass end on a blade of up to 0.2 m (longest ones of 0.3 to 1 of it, met at all
// heights); other ground is where it was.
TEST(Scene, GrassIsMetAboveTheGround) {
  SceneOptions options;
  options.relief = options.buildings = options.trees = 0.0;
  options.grass = 0.2;
  const Scene scene({-100.0, -100.0}, {100.0, 100.0}, options, 1);
  const Eigen::Vector3d direction = Eigen::Vector3d(0.3, 0.0, -1.0).normalized();
  std::vector<SurfaceHit> hits;
  double sum = 0.0, highest = 0.0;
  int rays = 0;
  for (double x = -99.0; x < 90.0; x += 1.3)
    for (double y = -99.0; y < 99.0; y += 1.7) {
      const Eigen::Vector3d origin = Eigen::Vector3d(x, y, 0.0) - 500.0 * direction;
      ASSERT_TRUE(scene.trace(origin, direction, hits));
      const double height = (origin + hits.front().range * direction).z();
      if (hits.front().cover != LandCover::grass) {
        EXPECT_NEAR(height, 0.0, 1e-9);
        continue;
      }
      ++rays;
      EXPECT_GE(height, -1e-9);
      sum += height;
      highest = std::max(highest, height);
    }
  ASSERT_GT(rays, 1000);
  EXPECT_GT(highest, 0.15);
  EXPECT_LT(highest, 0.2);
  EXPECT_NEAR(sum / rays, 0.5 * 0.65 * 0.2, 0.01);
}

TEST(Scene, SeedDecidesEverything) {
  const Scene again({-300.0, -250.0}, {300.0, 250.0}, SceneOptions(), 3);
  const Scene other({-300.0, -250.0}, {300.0, 250.0}, SceneOptions(), 4);
  ASSERT_EQ(again.balls().size(), suburb().balls().size());
  EXPECT_EQ(again.balls().back().centre, suburb().balls().back().centre);
  EXPECT_EQ(again.terrain().height(10.0, 20.0), suburb().terrain().height(10.0, 20.0));
  EXPECT_NE(other.terrain().height(10.0, 20.0), suburb().terrain().height(10.0, 20.0));
}

}  // namespace
