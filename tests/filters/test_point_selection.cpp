// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/impl/overlap_selection.hpp>
#include <pcl_als/filters/impl/surface_selection.hpp>

#include "filter_checks.h"
#include "own_point.h"

namespace pcl_als {
namespace {

using test::frameAt;
using test::kNaN;
using test::setOf;
using Cloud = pcl::PointCloud<PointLidar>;

/// Uniformly over a rectangle, relative to its corner.
Cloud::Ptr scattered(std::size_t count, float width, float height, unsigned seed) {
  Cloud::Ptr cloud(new Cloud);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  for (std::size_t i = 0; i < count; ++i)
    cloud->emplace_back(width * share(random), height * share(random), 0.0F);
  return cloud;
}

/// Two strips of 40 m by 100 m that overlap by 10 m, in different frames, about map coordinates.
struct Pair {
  Cloud::Ptr a = scattered(4000, 40.0F, 100.0F, 1), b = scattered(2000, 40.0F, 100.0F, 2);
  LocalFrame frame_a = frameAt(432000.0, 5450000.0), frame_b = frameAt(432030.0, 5450000.0);

  OverlapSelection<PointLidar> filter(bool removed = false) const {
    OverlapSelection<PointLidar> overlap(removed);
    overlap.setInputCloud(a);
    overlap.setLocalFrame(frame_a);
    overlap.addOtherStrip(b, frame_b);
    overlap.setCellSize(3.0);
    return overlap;
  }
  /// Whether at least \a least points of b lie in the cell of a point of a, tried one by one.
  bool covered(std::size_t i, double cell, int least) const {
    const Eigen::Vector3d p = frame_a.toGround((*a)[i].getVector3fMap());
    int found = 0;
    for (const PointLidar& other : *b) {
      const Eigen::Vector3d q = frame_b.toGround(other.getVector3fMap());
      if (std::floor(p.x() / cell) == std::floor(q.x() / cell) &&
          std::floor(p.y() / cell) == std::floor(q.y() / cell))
        ++found;
    }
    return found >= least;
  }
};

TEST(OverlapSelection, EqualsTryingAllPoints) {
  const Pair pair;
  for (const int least : {1, 5}) {
    OverlapSelection<PointLidar> overlap = pair.filter();
    overlap.setMinimumPoints(static_cast<std::size_t>(least));
    pcl::Indices indices;
    overlap.filter(indices);
    const std::set<int> selected = setOf(indices);
    for (std::size_t i = 0; i < pair.a->size(); ++i)
      EXPECT_EQ(selected.count(static_cast<int>(i)) > 0, pair.covered(i, 3.0, least)) << i;
    EXPECT_GT(selected.size(), 300U);
    EXPECT_LT(selected.size(), 1500U);
  }
}

TEST(OverlapSelection, AFrameThatWasNotSetIsNamed) {
  const Pair pair;
  OverlapSelection<PointLidar> overlap = pair.filter();
  overlap.setLocalFrame(LocalFrame());
  pcl::Indices indices;
  try {
    overlap.filter(indices);
    FAIL() << "5467 km";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("5467 km"), std::string::npos) << text;
    EXPECT_NE(text.find("setLocalFrame"), std::string::npos) << text;
  }
  // A strip elsewhere is no overlap, and no error.
  overlap.setLocalFrame(frameAt(532000.0, 5450000.0));
  overlap.filter(indices);
  EXPECT_TRUE(indices.empty());
}

TEST(OverlapSelection, FollowsThePclRules) {
  const Pair pair;
  pair.a->at(10).x = kNaN;
  pair.a->is_dense = false;
  OverlapSelection<PointLidar> overlap = pair.filter(true);
  pcl::Indices selected, inverted;
  overlap.filter(selected);
  const std::set<int> removed = setOf(*overlap.getRemovedIndices());
  EXPECT_EQ(selected.size() + removed.size(), pair.a->size());
  EXPECT_EQ(removed.count(10), 1U);
  overlap.setNegative(true);
  overlap.filter(inverted);
  EXPECT_EQ(selected.size() + inverted.size() + 1, pair.a->size());  // without the NaN
  EXPECT_EQ(setOf(inverted).count(10), 0U);

  // Indices limit both sides and keep their order.
  overlap.setNegative(false);
  const pcl::IndicesPtr some(new pcl::Indices{selected[5], inverted[0], 10, selected[2]});
  overlap.setIndices(some);
  pcl::Indices of_some;
  overlap.filter(of_some);
  EXPECT_EQ(of_some, (pcl::Indices{selected[5], selected[2]}));
  EXPECT_EQ(*overlap.getRemovedIndices(), (pcl::Indices{inverted[0], 10}));
}

TEST(OverlapSelection, KeepsTheCloudOrganizedOrCutsIt) {
  const Pair pair;
  OverlapSelection<PointLidar> overlap = pair.filter(true);
  pcl::Indices selected;
  overlap.filter(selected);
  Cloud cut, organized;
  overlap.filter(cut);
  ASSERT_EQ(cut.size(), selected.size());
  EXPECT_EQ(cut[7].x, (*pair.a)[static_cast<std::size_t>(selected[7])].x);
  overlap.setKeepOrganized(true);
  overlap.filter(organized);
  ASSERT_EQ(organized.size(), pair.a->size());
  const std::set<int> kept = setOf(selected);
  for (std::size_t i = 0; i < organized.size(); ++i)
    EXPECT_EQ(std::isfinite(organized[i].x), kept.count(static_cast<int>(i)) > 0);
}

TEST(OverlapSelection, TakesSeveralStripsEmptyOnesAndOtherPointTypes) {
  const Pair pair;
  Strip<PointLidar> none, other;
  other.cloud = pair.b;
  other.frame = pair.frame_b;
  OverlapSelection<PointLidar> overlap = pair.filter();
  pcl::Indices one, several;
  overlap.filter(one);
  overlap.setOtherStrips({none, other, other});
  overlap.filter(several);
  EXPECT_EQ(one, several);
  overlap.setInputCloud(Cloud::Ptr(new Cloud));
  overlap.filter(several);
  EXPECT_TRUE(several.empty());

  OverlapSelection<test::OwnPoint> own;
  own.setInputCloud(test::cloudOf<test::OwnPoint>(*pair.a));
  own.setLocalFrame(pair.frame_a);
  own.addOtherStrip(test::cloudOf<test::OwnPoint>(*pair.b), pair.frame_b);
  own.setCellSize(3.0);
  own.filter(several);
  EXPECT_EQ(one, several);
}

TEST(OverlapSelection, RefusesWhatIsMissingOrImpossible) {
  OverlapSelection<PointLidar> overlap;
  EXPECT_THROW(overlap.setCellSize(0.0), UsageError);
  EXPECT_THROW(overlap.setMinimumPoints(0), UsageError);
  EXPECT_THROW(overlap.addOtherStrip(nullptr, LocalFrame()), UsageError);
  overlap.setInputCloud(scattered(10, 1.0F, 1.0F, 1));
  pcl::Indices indices;
  EXPECT_THROW(overlap.filter(indices), UsageError);
}

/// 80 m by 60 m, a point every half metre with 1 cm of noise: level ground, a gable roof of 30
/// degrees from x = 20 to 40 m, and the leaves of a tree about (60, 30) m.
struct Scene {
  enum class Part { ground, roof, tree };
  Cloud::Ptr cloud{new Cloud};
  std::vector<Part> parts;

  Scene() {
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0.0F, 0.01F);
    std::uniform_real_distribution<float> leaf(2.0F, 12.0F);
    for (int row = 0; row < 120; ++row) {
      for (int column = 0; column < 160; ++column) {
        const float x = 0.5F * static_cast<float>(column), y = 0.5F * static_cast<float>(row);
        float z = 0.0F;
        Part part = Part::ground;
        if (x > 20.0F && x < 40.0F && y > 15.0F && y < 45.0F) {
          part = Part::roof;
          z = 12.0F - 0.57735F * std::abs(x - 30.0F);
        } else if (std::hypot(x - 60.0F, y - 30.0F) < 8.0F) {
          part = Part::tree;
          z = leaf(random);
        }
        cloud->emplace_back(x, y, z + noise(random));
        parts.push_back(part);
      }
    }
  }

  /// So far from eaves, ridge, the tree and the border that no neighbourhood reaches them.
  bool isInside(std::size_t i) const {
    const PointLidar& p = (*cloud)[i];
    if (parts[i] == Part::roof)
      return std::abs(p.x - 30.0F) > 2.0F && p.x > 22.0F && p.x < 38.0F && p.y > 17.0F &&
             p.y < 43.0F;
    const bool near_roof = p.x > 18.0F && p.x < 42.0F && p.y > 13.0F && p.y < 47.0F;
    return parts[i] == Part::ground && !near_roof && p.x > 2.0F && p.x < 77.0F && p.y > 2.0F &&
           p.y < 57.0F && std::hypot(p.x - 60.0F, p.y - 30.0F) > 10.0F;
  }
};

TEST(SurfaceSelection, TakesPlanesAndLeavesOutTreesEavesAndTheBorder) {
  const Scene scene;
  SurfaceSelection<PointLidar> surfaces(true);
  surfaces.setInputCloud(scene.cloud);
  pcl::Indices indices;
  surfaces.filter(indices);
  const std::set<int> selected = setOf(indices);
  std::size_t inside = 0, found = 0, tree = 0, leaves = 0;
  for (std::size_t i = 0; i < scene.cloud->size(); ++i) {
    const PointLidar& p = (*scene.cloud)[i];
    const bool is_selected = selected.count(static_cast<int>(i)) > 0;
    if (p.x == 0.0F || p.y == 0.0F || p.x == 79.5F || p.y == 59.5F) {
      EXPECT_FALSE(is_selected) << "border";
    }
    if (std::hypot(p.x - 60.0F, p.y - 30.0F) < 7.0F) {
      ++tree;
      if (is_selected) ++leaves;
    }
    if (!scene.isInside(i)) continue;
    ++inside;
    if (is_selected) ++found;
  }
  // Of 20 or so points with 1 cm of noise, an RMS of three times the median is no accident.
  EXPECT_GT(inside, 10000U);
  EXPECT_EQ(found, inside);
  EXPECT_GT(tree, 500U);
  EXPECT_EQ(leaves, 0U);  // heights of metres: none of so many lie on a plane within 3 cm
  EXPECT_EQ(selected.size() + surfaces.getRemovedIndices()->size(), scene.cloud->size());
}

TEST(SurfaceSelection, DependsNeitherOnTheFrameNorOnThreads) {
  const Scene scene;
  SurfaceSelection<PointLidar> one, other;
  one.setInputCloud(scene.cloud);
  other.setInputCloud(scene.cloud);
  one.setNumberOfThreads(1);
  other.setNumberOfThreads(8);
  // By whole squares: the same squares hold the same points.
  other.setLocalFrame(frameAt(432000.0, 5450000.0));
  pcl::Indices first, second;
  one.filter(first);
  other.filter(second);
  EXPECT_EQ(first, second);
}

TEST(SurfaceSelection, KeepsToTheClassesAndReturnsOfThePoints) {
  const Scene scene;
  SurfaceSelection<PointLidar> surfaces;
  surfaces.setInputCloud(scene.cloud);
  pcl::Indices all, less;
  surfaces.filter(all);
  const int multiple = all[100], vegetation = all[200], withheld = all[300], invalid = all[400];
  scene.cloud->at(multiple).number_of_returns = scene.cloud->at(multiple).return_number = 2;
  scene.cloud->at(vegetation).classification = 5;
  scene.cloud->at(withheld).flags = kWithheld;
  scene.cloud->at(invalid).z = kNaN;
  surfaces.filter(less);
  for (const int index : {multiple, vegetation, withheld, invalid})
    EXPECT_EQ(setOf(less).count(index), 0U);
  EXPECT_GT(less.size(), all.size() - 100);
  surfaces.setMultipleReturns(true);
  surfaces.filter(less);
  EXPECT_EQ(setOf(less).count(multiple), 1U);
}

TEST(SurfaceSelection, IndicesLimitWhatIsSelectedAndNotTheSurface) {
  const Scene scene;
  SurfaceSelection<test::OwnPoint> surfaces;
  surfaces.setInputCloud(test::cloudOf<test::OwnPoint>(*scene.cloud));
  pcl::Indices all, some, inverted;
  surfaces.filter(all);
  const pcl::IndicesPtr wanted(new pcl::Indices{all[50], 0, all[70]});
  surfaces.setIndices(wanted);
  surfaces.filter(some);
  EXPECT_EQ(some, (pcl::Indices{all[50], all[70]}));
  surfaces.setNegative(true);
  surfaces.filter(inverted);
  EXPECT_EQ(inverted, (pcl::Indices{0}));
}

TEST(SurfaceSelection, TakesEmptyAndSparseCloudsAndRefusesSettings) {
  SurfaceSelection<PointLidar> surfaces;
  pcl::Indices indices{1, 2};
  surfaces.setInputCloud(Cloud::Ptr(new Cloud));
  surfaces.filter(indices);
  EXPECT_TRUE(indices.empty());
  surfaces.setInputCloud(scattered(20, 5.0F, 5.0F, 1));  // not worth a TIN
  surfaces.filter(indices);
  EXPECT_TRUE(indices.empty());
  SuitablePointsSettings settings;
  settings.area_size = 0.0;
  surfaces.setSettings(settings);
  EXPECT_THROW(surfaces.filter(indices), UsageError);
}

}  // namespace
}  // namespace pcl_als
