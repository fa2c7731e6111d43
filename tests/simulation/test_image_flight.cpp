// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <map>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/image_flight.h>
#include <pcl_als/simulation/simulator.h>

#include "blocks.h"

namespace pcl_als::simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Reduced image coordinates of a ground point by rotations of Eigen; the depth as third.
Vector3d imageOf(const ImageOrientation& image, const FrameCamera& camera, const Vector3d& ground) {
  const Eigen::Matrix3d rotation = (AngleAxisd(image.angles.x(), Vector3d::UnitX()) *
                                    AngleAxisd(image.angles.y(), Vector3d::UnitY()) *
                                    AngleAxisd(image.angles.z(), Vector3d::UnitZ()))
                                       .toRotationMatrix();
  const Vector3d p = rotation.transpose() * (ground - image.position);
  const Vector2d at = -camera.focal_length * p.head<2>() / p.z();
  return {at.x(), at.y(), -p.z()};
}

SimulatedImages fly(const Simulator& simulator, const SimulationOptions& options, double noise) {
  ImageFlightOptions flight;
  flight.height = 800.0;
  flight.noise = flight.line_noise = noise;
  return simulateImages(simulator.scene(), options, flight, simulator.controlPoints());
}

std::map<std::string, ImageOrientation> byName(const std::vector<ImageOrientation>& images) {
  std::map<std::string, ImageOrientation> map;
  for (const ImageOrientation& image : images) map[image.id] = image;
  return map;
}

TEST(ImageFlight, CoordinatesWithoutNoiseAreExact) {
  const SimulationOptions options = test::oneLine();
  const Simulator simulator(options);
  const SimulatedImages images = fly(simulator, options, 0.0);
  ASSERT_GE(images.truth.size(), 4U);
  const auto truth = byName(images.truth);
  std::map<std::string, Vector3d> points;
  for (const ControlPoint& point : images.true_points) points[point.id] = point.position;
  std::map<std::string, ObjectLine> ridges;
  for (const ObjectLine& ridge : images.ridges) ridges[ridge.id] = ridge;
  std::size_t on_points = 0, on_lines = 0;
  for (const ImageMeasurement& m : images.measurements) {
    const Vector2d at = images.camera.reduced(m.position);
    const ImageOrientation& image = truth.at(m.image);
    if (m.kind == ImageMeasurement::Kind::point) {
      // The distortion is inverted to rounding; ground coordinates of 5e6 m have 1e-9 m.
      EXPECT_LT((imageOf(image, images.camera, points.at(m.feature)).head<2>() - at).norm(), 1e-8);
      ++on_points;
      continue;
    }
    const ObjectLine& ridge = ridges.at(m.feature);
    const Vector2d from = imageOf(image, images.camera, ridge.start).head<2>();
    const Vector2d to = imageOf(image, images.camera, ridge.end).head<2>();
    const Vector2d along = (to - from).normalized(), off = at - from;
    EXPECT_LT(std::abs(along.x() * off.y() - along.y() * off.x()), 1e-8);
    EXPECT_GT(along.dot(off), 0.0);
    EXPECT_LT(along.dot(off), (to - from).norm());
    ++on_lines;
  }
  EXPECT_GT(on_points, 50U);
  EXPECT_GT(on_lines, 50U);
}

/// Whether nothing is between an image and a place.
bool isFree(const Scene& scene, const SimulationOptions& options, const ImageOrientation& image,
            const Vector3d& place) {
  const Vector3d ray = place - image.position;
  std::vector<SurfaceHit> hits;
  scene.trace(image.position - options.origin, ray.normalized(), hits);
  return !hits.empty() && hits.front().range > ray.norm() - 0.1;
}

TEST(ImageFlight, WhatIsHiddenIsNotMeasured) {
  SimulationOptions options = test::oneLine();
  options.scene.high_rises = 0.5;  // of up to 90 m
  const Simulator simulator(options);
  ImageFlightOptions flight;  // wide angle, so that blocks hide the ground behind them
  flight.camera.focal_length = 40.0;
  flight.height = 500.0;
  flight.tie_spacing = 8.0;
  const SimulatedImages images =
      simulateImages(simulator.scene(), options, flight, simulator.controlPoints());
  std::multiset<std::pair<std::string, std::string>> measured;
  for (const ImageMeasurement& m : images.measurements) measured.emplace(m.image, m.feature);
  const Vector2d inner = 0.5 * images.camera.format.array() - 1.0;  // mm, clear of the border
  std::size_t points = 0, hidden = 0;
  for (const ControlPoint& point : images.true_points) {
    for (const ImageOrientation& image : images.truth) {
      const Vector3d at = imageOf(image, images.camera, point.position);
      if ((at.head<2>().array().abs() > inner.array()).any()) continue;
      const bool free = isFree(simulator.scene(), options, image, point.position);
      EXPECT_EQ(free, measured.count({image.id, point.id}) > 0) << image.id << " " << point.id;
      ++(free ? points : hidden);
    }
  }
  EXPECT_GT(points, 500U);
  // Parts of ridges.
  std::size_t whole = 0;
  for (const ObjectLine& ridge : images.ridges) {
    for (const ImageOrientation& image : images.truth) {
      bool inside = true, free = true;
      for (int i = 0; i <= 40; ++i) {
        const Vector3d place = ridge.start + i / 40.0 * (ridge.end - ridge.start);
        const Vector3d at = imageOf(image, images.camera, place);
        inside = inside && (at.head<2>().array().abs() < inner.array()).all();
        free = free && isFree(simulator.scene(), options, image, place);
      }
      if (!inside) continue;
      const std::size_t places = measured.count({image.id, ridge.id});
      if (free) {
        EXPECT_EQ(places, 4U) << image.id << " " << ridge.id;
      }
      ++(places < 4U ? hidden : whole);
    }
  }
  EXPECT_GT(hidden, 20U) << "beside " << points << " points and " << whole << " ridges";
  EXPECT_GT(whole, 20U);
}

TEST(ImageFlight, OverAPlaneNothingIsHidden) {
  const SimulationOptions options = test::overPlane();
  const Simulator simulator(options);
  const SimulatedImages images = fly(simulator, options, 0.0);
  EXPECT_TRUE(images.ridges.empty());
  std::set<std::pair<std::string, std::string>> measured;
  for (const ImageMeasurement& m : images.measurements) measured.emplace(m.image, m.feature);
  const Vector2d inner = 0.5 * images.camera.format.array() - 1.0;
  for (const ControlPoint& point : images.true_points) {
    for (const ImageOrientation& image : images.truth) {
      const Vector3d at = imageOf(image, images.camera, point.position);
      if ((at.head<2>().array().abs() > inner.array()).any()) continue;
      EXPECT_EQ(measured.count({image.id, point.id}), 1U) << image.id << " " << point.id;
    }
  }
}

TEST(ImageFlight, NoiseAndApproximateOrientationsAreAsStated) {
  const SimulationOptions options = test::oneLine();
  const Simulator simulator(options);
  const SimulatedImages exact = fly(simulator, options, 0.0), noisy = fly(simulator, options, 0.5);
  const auto truth = byName(noisy.truth);
  std::map<std::string, Vector3d> points;
  for (const ControlPoint& point : noisy.true_points) points[point.id] = point.position;
  double squares = 0.0, count = 0.0;
  for (const ImageMeasurement& m : noisy.measurements) {
    if (m.kind != ImageMeasurement::Kind::point) continue;
    EXPECT_NEAR(m.sigma, 0.5 * noisy.camera.pixel_size, 1e-12);
    const Vector2d at = noisy.camera.reduced(m.position);
    squares += (imageOf(truth.at(m.image), noisy.camera, points.at(m.feature)).head<2>() - at)
                   .squaredNorm();
    count += 2.0;
  }
  // Some hundred values: 10 % is twice the standard deviation of their RMS.
  EXPECT_NEAR(std::sqrt(squares / count) / noisy.camera.pixel_size, 0.5, 0.05);
  double moved = 0.0;
  for (std::size_t i = 0; i < noisy.truth.size(); ++i)
    moved += (noisy.truth[i].position - noisy.approximate[i].position).squaredNorm();
  EXPECT_NEAR(std::sqrt(moved / (3.0 * static_cast<double>(noisy.truth.size()))), 0.5, 0.25);
  EXPECT_EQ(exact.truth.size(), noisy.truth.size());
}

TEST(ImageFlight, BelowTheTerrainIsRefused) {
  const SimulationOptions options = test::oneLine();
  const Simulator simulator(options);
  ImageFlightOptions flight;
  flight.height = simulator.scene().terrain().highest();
  EXPECT_THROW(simulateImages(simulator.scene(), options, flight, {}), UsageError);
}

}  // namespace
}  // namespace pcl_als::simulation
