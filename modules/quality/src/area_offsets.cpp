// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <utility>

#include <pcl_als/common/statistics.h>
#include <pcl_als/quality/area_offsets.h>

namespace pcl_als {
namespace {

constexpr std::size_t kTooFew = 12;                 // points of a strip without a TIN
constexpr std::size_t kExaminedForRoughness = 300;  // triangles for the roughness of plain ground
constexpr double kSteepest = 0.8;  // radians: steeper patches are not compared with control
constexpr double kWall = 0.2;  // vertical component of the normal: steeper planes have no height

/// Elements at equal intervals, at most \a count.
template <typename T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<T> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

/// Height of a plane at a plan position.
double heightOf(const PatchQuality& plane, const Eigen::Vector3d& at) {
  const Eigen::Vector2d from = at.head<2>() - plane.plane_centre.head<2>();
  return plane.plane_centre.z() - plane.plane_normal.head<2>().dot(from) / plane.plane_normal.z();
}

std::int32_t nearestVertex(const Tin::Triangle& triangle, const Eigen::Vector3d& weights) {
  Eigen::Index largest = 0;
  weights.maxCoeff(&largest);
  return triangle.vertex[static_cast<std::size_t>(largest)];
}

}  // namespace

void AreaOffsets::add(int strip, const LidarReturn& point) {
  if (!area_.covers(point.position) || !isSolid(point)) return;
  strips_[static_cast<std::size_t>(strip)].points.push_back(point);
}

std::size_t AreaOffsets::pointCount() const {
  std::size_t count = 0;
  for (const StripPart& part : strips_) count += part.points.size();
  return count;
}

void AreaOffsets::build(const SurfaceLimits& limits, double resolution) {
  limits_ = limits;
  if (std::exchange(built_, true)) return;
  for (StripPart& part : strips_) {
    dropHighVegetation(part.points);
    if (part.points.size() < kTooFew) continue;
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(part.points.size());
    for (const LidarReturn& point : part.points) positions.push_back(point.position);
    part.surface = PatchSurface(Tin(std::move(positions), resolution));
    part.median_edge = typicalPlanEdge(part.surface.tin());
  }
}

void AreaOffsets::release() {
  built_ = false;
  for (StripPart& part : strips_) {
    part.surface = PatchSurface();
    part.places = {};
  }
}

std::vector<std::int32_t> AreaOffsets::sampledTriangles(const StripPart& part,
                                                        std::size_t count) const {
  std::vector<bool> seen(part.points.size(), false);
  std::vector<std::int32_t> triangles;
  const auto& all = part.surface.tin().triangles();
  for (std::size_t t = 0; t < all.size(); ++t) {
    const std::int32_t point = all[t].vertex[0];
    const LidarReturn& p = part.points[point];
    if (seen[point] || !p.isSingle() || !area_.contains(p.position)) continue;
    seen[point] = true;
    triangles.push_back(static_cast<std::int32_t>(t));
  }
  return thinned(triangles, count);
}

void AreaOffsets::choosePlaces() {
  for (StripPart& part : strips_) choosePlaces(part);
}

void AreaOffsets::choosePlaces(StripPart& part) const {
  constexpr std::size_t kExaminedPerPlace = 4;
  std::vector<Place> level, steep;
  for (const std::int32_t triangle :
       sampledTriangles(part, kExaminedPerPlace * limits_.candidates)) {
    const auto quality = part.surface.suitable(triangle, limits_, part.median_edge);
    if (!quality || quality->plane_normal.z() < kWall) continue;
    Place place;
    place.point = part.surface.tin().triangles()[triangle].vertex[0];
    place.position = part.points[place.point].position;
    place.position.z() = heightOf(*quality, place.position);
    place.normal = quality->plane_normal;
    (place.normal.z() > std::cos(limits_.level_slope) ? level : steep).push_back(place);
  }
  part.places = thinned(level, limits_.candidates);
  const std::vector<Place> more = thinned(steep, limits_.candidates);
  part.places.insert(part.places.end(), more.begin(), more.end());
}

std::vector<double> AreaOffsets::roughness() const {
  std::vector<double> values;
  for (const StripPart& part : strips_) {
    if (part.surface.tin().triangles().empty()) continue;
    for (const std::int32_t triangle : sampledTriangles(part, kExaminedForRoughness)) {
      const PatchQuality quality = part.surface.quality(triangle);
      if (limits_.isSound(quality, part.median_edge) && quality.slope < kGentleSlope)
        values.push_back(quality.roughness);
    }
  }
  return values;
}

double AreaOffsets::repeatedShare(int strip) const {
  const StripPart& one = part(strip);
  if (one.points.empty()) return 0.0;
  return static_cast<double>(one.surface.tin().mergedPoints()) /
         static_cast<double>(one.points.size());
}

std::vector<OffsetSample> AreaOffsets::offsets(int a, int b) const {
  std::vector<OffsetSample> found;
  measure(part(a), part(b), 1.0, found);
  measure(part(b), part(a), -1.0, found);
  return found;
}

void AreaOffsets::measure(const StripPart& from, const StripPart& to, double sign,
                          std::vector<OffsetSample>& found) const {
  if (from.surface.tin().triangles().empty() || to.surface.tin().triangles().empty()) return;
  std::int32_t hint = Tin::kNone;
  for (const Place& place : from.places) {
    OffsetSample sample;
    if (measureAt(from, place, to, sign, hint, sample)) found.push_back(sample);
  }
}

bool AreaOffsets::measureAt(const StripPart& from, const Place& place, const StripPart& to,
                            double sign, std::int32_t& hint, OffsetSample& sample) const {
  const LidarReturn& point = from.points[place.point];
  sample.position = place.position;
  // Height of the surface of the strip above that of the other one around a patch.
  const auto compare = [&](const PatchMatch& match, const PatchQuality& quality) {
    const Tin::Triangle& triangle = to.surface.tin().triangles()[match.triangle];
    const LidarReturn& other = to.points[nearestVertex(triangle, match.weights)];
    const bool forward = sign > 0.0;
    sample.normal = (place.normal + quality.plane_normal).normalized();
    sample.slope = static_cast<float>(std::acos(std::min(1.0, sample.normal.z())));
    sample.time_a = forward ? point.time : other.time;
    sample.time_b = forward ? other.time : point.time;
    sample.scan_angle_a = forward ? point.scan_angle : other.scan_angle;
    sample.scan_angle_b = forward ? other.scan_angle : point.scan_angle;
    sample.identical = other.position == point.position && other.time == point.time;
    return sign * (place.position.z() - heightOf(quality, place.position));
  };
  const auto usable = [&](std::int32_t triangle) {
    auto quality = to.surface.suitable(triangle, limits_, to.median_edge);
    if (quality && quality->plane_normal.z() < kWall) quality.reset();
    return quality;
  };
  const auto closest = to.surface.closest(place.position, limits_.maximum_distance, hint);
  std::optional<PatchQuality> quality;
  if (closest) {
    quality = usable(closest->triangle);
    if (quality) {
      sample.normal_distance = compare(*closest, *quality) * sample.normal.z();
      sample.conjugate = std::abs(sample.normal_distance) <= limits_.maximum_distance;
    }
  }
  const auto below = to.surface.vertical(place.position);
  if (!below) return sample.conjugate;
  if (!closest || closest->triangle != below->triangle) quality = usable(below->triangle);
  if (!quality) return sample.conjugate;
  const Eigen::Vector3d normal = (place.normal + quality->plane_normal).normalized();
  if (normal.z() > std::cos(limits_.level_slope)) {
    const double above = compare(*below, *quality);
    if (std::abs(above) <= limits_.maximum_distance) {
      sample.level = true;
      sample.vertical = above;
    }
  }
  return sample.level || sample.conjugate;
}

std::optional<AreaOffsets::Height> AreaOffsets::heightAt(int strip,
                                                         const Eigen::Vector3d& point) const {
  const StripPart& one = part(strip);
  const auto match = one.surface.vertical(point);
  if (!match || !(match->normal.z() > 0.0)) return std::nullopt;
  const PatchQuality quality = one.surface.quality(match->triangle);
  Height height;
  height.above = -match->signed_normal_distance / match->normal.z();
  height.slope = static_cast<float>(std::acos(std::min(1.0, quality.plane_normal.z())));
  height.roughness = quality.roughness;
  height.normal = quality.plane_normal;
  height.slope_std = quality.spread > 0.0F ? quality.roughness / quality.spread : kSteepest;
  if (quality.on_hull || quality.longest_edge > limits_.edge_factor * one.median_edge) {
    height.unfit = "at the edge of the strip or of a void";
  } else if (height.slope > kSteepest) {
    height.unfit = "on a wall";
  }
  return height;
}

}  // namespace pcl_als
