// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/quality/checked_points.h>
#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/tin/patch_surface.h>

namespace pcl_als {

/** \brief The points of one area by strip, and the offsets between the strips there.
 *
 * Fill with add() (different strips may be added from different threads); then build(),
 * choosePlaces(), offsets() and release(), from one thread. Memory: 48 bytes per point, 73 to 173
 * more between build() and release().
 */
class AreaOffsets {
 public:
  AreaOffsets(const SurveyArea& area, std::size_t strips) : area_(area), strips_(strips) {}

  /// Keeps points that may be part of a surface (isSolid) inside the area or its margin.
  void add(int strip, const LidarReturn& point);
  const SurveyArea& area() const { return area_; }
  const std::vector<LidarReturn>& points(int strip) const { return part(strip).points; }
  std::size_t pointCount() const;
  /// The points of a strip, for another process; get() replaces those that are there.
  void put(int strip, ByteWriter& out) const { out.putPlain(part(strip).points); }
  void get(int strip, ByteReader& in) {
    in.getPlain(strips_[static_cast<std::size_t>(strip)].points);
  }
  void clear() { strips_.assign(strips_.size(), StripPart()); }  ///< deletes all points

  /// Removes points high in the vegetation (dropHighVegetation()) and builds the TIN of every strip
  /// with enough points, unless there are TINs from another call, with other limits. \a resolution:
  /// metres, step of the coordinates.
  void build(const SurfaceLimits& limits, double resolution);
  void choosePlaces();  ///< the places of offsets(), on surfaces within the limits
  void release();       ///< deletes the TINs and keeps the points

  /// Roughness of the surfaces of all strips on gentle slopes, metres, at up to some hundred
  /// places; determines the limit of smooth surfaces for these data.
  std::vector<double> roughness() const;
  /// Share of a strip's points with exactly the coordinates of another point of the strip.
  double repeatedShare(int strip) const;

  /** \brief Offsets a - b at places of a and of b.
   *
   * A place is the plan position of a single return of one strip. The surface of each strip there
   * is the plane of the vertices around the triangle at that position, without the triangle's own:
   * neither the point that defines the place nor its noise contributes, and both strips are treated
   * alike. Points are not selected by class: a class that depends on height (ground of all strips
   * together) would contain the low points of each strip.
   */
  std::vector<OffsetSample> offsets(int a, int b) const;

  /// Height of a strip above a point of known height, at any distance.
  struct Height {
    double above = 0.0;                    ///< strip - point, metres, vertical
    float slope = 0.0F, roughness = 0.0F;  ///< of the surface around, radians, metres
    std::string unfit;                     ///< reason for which it is not used; empty: it is
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the surface around, unit, upward
    double slope_std = 0.0;                             ///< of the normal, radians
  };
  /// Empty where the strip has no surface above or below the point.
  std::optional<Height> heightAt(int strip, const Eigen::Vector3d& point) const;

 private:
  /// A place of comparison: the plan position of a point, on the surface around it.
  struct Place {
    std::int32_t point = 0;
    Eigen::Vector3d position;  ///< metres; the height is that of the surface
    Eigen::Vector3d normal;    ///< of the surface, unit, upward
  };
  struct StripPart {
    std::vector<LidarReturn> points;
    PatchSurface surface;
    double median_edge = 0.0;  ///< metres, in plan
    std::vector<Place> places;
  };
  const StripPart& part(int strip) const { return strips_[static_cast<std::size_t>(strip)]; }
  /// Triangles of the single-return vertices inside the area, one for each vertex, thinned to a
  /// count.
  std::vector<std::int32_t> sampledTriangles(const StripPart& part, std::size_t count) const;
  void choosePlaces(StripPart& part) const;
  void measure(const StripPart& from, const StripPart& to, double sign,
               std::vector<OffsetSample>& found) const;
  bool measureAt(const StripPart& from, const Place& place, const StripPart& to, double sign,
                 std::int32_t& hint, OffsetSample& sample) const;

  SurveyArea area_;
  std::vector<StripPart> strips_;
  SurfaceLimits limits_;
  bool built_ = false;
};

}  // namespace pcl_als
