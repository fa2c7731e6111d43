// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/crs/map_projection.h>

#ifdef PCL_ALS_HAVE_PROJ
#include "proj_object.h"
#endif

namespace pcl_als {

#ifdef PCL_ALS_HAVE_PROJ
namespace {

using detail::openCrs;
using detail::ProjContext;
using detail::ProjObject;
using detail::quietProjContext;

/// "CRS 'EPSG:32611'", of a long WKT its beginning.
std::string nameOf(const std::string& crs) {
  return "CRS '" + shortCrsName(crs) + "'";
}

}  // namespace

struct MapProjection::State {
  ProjContext context = quietProjContext();
  ProjObject transformation;
  std::string crs;
  Eigen::Vector3d metres = Eigen::Vector3d::Ones();  ///< length of a unit of what PROJ returns
  bool needs_geoid = false;

  void inspect();
  Eigen::Vector3d map(double latitude, double longitude, double height) const;
};

/// Refuses what is not a map; finds out its units and whether its heights are above a geoid.
void MapProjection::State::inspect() {
  const CrsDescription description = describeCrs(crs);
  if (description.kind == CrsKind::unknown && description.name.empty())
    throw InputError(nameOf(crs) + ": PROJ does not know it", Remedy::crs);
  if (description.kind != CrsKind::projected || !description.horizontal)
    throw InputError(nameOf(crs) + ": is not a projected CRS", Remedy::crs);
  needs_geoid = openCrs(context.get(), crs).vertical != nullptr;
  metres.head<2>().setConstant(description.horizontal->metres);
  // Without a vertical axis PROJ hands the ellipsoidal height through, in metres.
  if (description.vertical) metres.z() = description.vertical->metres;
}

Eigen::Vector3d MapProjection::State::map(double latitude, double longitude, double height) const {
  const PJ_COORD geodetic =
      proj_coord(longitude / kRadiansPerDegree, latitude / kRadiansPerDegree, height, HUGE_VAL);
  const PJ_COORD mapped = proj_trans(transformation.get(), PJ_FWD, geodetic);
  return Eigen::Vector3d(mapped.xyzt.x, mapped.xyzt.y, mapped.xyzt.z).cwiseProduct(metres);
}

MapProjection::MapProjection(const std::string& crs) : state_(std::make_unique<State>()) {
  PJ_CONTEXT* context = state_->context.get();
  state_->crs = crs;
  state_->inspect();
  const ProjObject authority_order(
      proj_create_crs_to_crs(context, "EPSG:4979", crs.c_str(), nullptr));
  if (authority_order) {
    state_->transformation.reset(proj_normalize_for_visualization(context, authority_order.get()));
  }
  if (!state_->transformation) {
    throw InputError(nameOf(crs) + ": PROJ has no way to it from WGS 84");
  }
}

MapProjection::Result MapProjection::project(double latitude, double longitude,
                                             double height) const {
  // proj_factors() takes 3 to 10 ms per call on a CRS (PROJ 9.1) and refuses compound ones, so the
  // direction of north is a difference of the transformation itself, which includes the datum's
  // turn. Half a step is 11 m: the error is the third derivative of the meridian's image, under
  // 1e-11 rad; rounding adds 1e-9 m / 22 m.
  constexpr double kStep = 1e-4 * kRadiansPerDegree;
  Result result;
  result.position = state_->map(latitude, longitude, height);
  const Eigen::Vector3d north = state_->map(latitude + kStep, longitude, height) -
                                state_->map(latitude - kStep, longitude, height);
  result.north_azimuth = std::atan2(north.x(), north.y());
  // A height that is the ellipsoidal one to rounding of its unit was handed through.
  if (state_->needs_geoid && std::abs(result.position.z() - height) < 1e-7) {
    throw InputError(
        nameOf(state_->crs) +
        ": the geoid grid of its heights is not installed for PROJ; if the points have "
        "ellipsoidal heights, give the CRS of plan only");
  }
  return result;
}

#else

struct MapProjection::State {};

MapProjection::MapProjection(const std::string& /*crs*/) {
  throw InputError(
      "an SBET needs PROJ, which this build lacks (PCL_ALS_WITH_PROJ=OFF); convert the trajectory "
      "to CSV");
}

MapProjection::Result MapProjection::project(double /*latitude*/, double /*longitude*/,
                                             double /*height*/) const {
  return {Eigen::Vector3d::Constant(std::nan("")), 0.0};
}

#endif

MapProjection::~MapProjection() = default;

}  // namespace pcl_als
