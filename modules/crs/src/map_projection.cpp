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

const std::string kGeodetic = "EPSG:4979";  // WGS 84 with ellipsoidal heights

}  // namespace

struct MapProjection::State {
  ProjContext context = quietProjContext();
  ProjObject transformation;
  ProjObject to_geodetic;  ///< of a geocentric source
  std::string crs;
  CrsKind source_kind = CrsKind::geographic;
  Eigen::Vector3d source_metres = Eigen::Vector3d::Ones();  ///< length of a unit of the source
  Eigen::Vector3d metres = Eigen::Vector3d::Ones();  ///< length of a unit of what PROJ returns
  bool needs_geoid = false;

  void inspect();
  void inspectSource(const std::string& source);
  ProjObject between(const std::string& from, const std::string& to) const;
  Eigen::Vector3d map(const Eigen::Vector3d& position) const;
  Eigen::Vector3d geodetic(const Eigen::Vector3d& geocentric) const;
};

/// Refuses what is not a map; finds out its units and whether its heights are above a geoid.
void MapProjection::State::inspect() {
  const CrsDescription description = describeCrs(crs);
  if (description.kind == CrsKind::unknown && description.name.empty())
    throw InputError(nameOf(crs) + ": PROJ does not know it", Hint::crs);
  if (description.kind != CrsKind::projected || !description.horizontal)
    throw InputError(nameOf(crs) + ": is not a projected CRS", Hint::crs);
  needs_geoid = openCrs(context.get(), crs).vertical != nullptr;
  metres.head<2>().setConstant(description.horizontal->metres);
  // Without a vertical axis PROJ hands the ellipsoidal height through, in metres.
  if (description.vertical) metres.z() = description.vertical->metres;
}

void MapProjection::State::inspectSource(const std::string& source) {
  const CrsDescription description = describeCrs(source);
  source_kind = description.kind;
  const bool usable = source_kind == CrsKind::geographic || source_kind == CrsKind::geocentric ||
                      (source_kind == CrsKind::projected && description.horizontal);
  if (!usable) {
    throw InputError(nameOf(source) + (description.name.empty()
                                           ? ": PROJ does not know it"
                                           : ": is not a geographic, geocentric or projected CRS"));
  }
  if (source_kind != CrsKind::projected) return;
  needs_geoid = needs_geoid && openCrs(context.get(), source).vertical == nullptr;
  source_metres.head<2>().setConstant(description.horizontal->metres);
  if (description.vertical) source_metres.z() = description.vertical->metres;
}

ProjObject MapProjection::State::between(const std::string& from, const std::string& to) const {
  const ProjObject authority_order(
      proj_create_crs_to_crs(context.get(), from.c_str(), to.c_str(), nullptr));
  ProjObject made;
  if (authority_order) {
    made.reset(proj_normalize_for_visualization(context.get(), authority_order.get()));
  }
  if (!made) {
    throw InputError(nameOf(to) + ": PROJ has no way to it from " +
                     (from == kGeodetic ? std::string("WGS 84") : nameOf(from)));
  }
  return made;
}

Eigen::Vector3d MapProjection::State::geodetic(const Eigen::Vector3d& geocentric) const {
  const PJ_COORD result =
      proj_trans(to_geodetic.get(), PJ_FWD,
                 proj_coord(geocentric.x(), geocentric.y(), geocentric.z(), HUGE_VAL));
  return {result.xyzt.y * kRadiansPerDegree, result.xyzt.x * kRadiansPerDegree, result.xyzt.z};
}

Eigen::Vector3d MapProjection::State::map(const Eigen::Vector3d& position) const {
  PJ_COORD source = proj_coord(position.y() / kRadiansPerDegree, position.x() / kRadiansPerDegree,
                               position.z(), HUGE_VAL);
  if (source_kind == CrsKind::projected) {
    const Eigen::Vector3d units = position.cwiseQuotient(source_metres);
    source = proj_coord(units.x(), units.y(), units.z(), HUGE_VAL);
  }
  const PJ_COORD mapped = proj_trans(transformation.get(), PJ_FWD, source);
  return Eigen::Vector3d(mapped.xyzt.x, mapped.xyzt.y, mapped.xyzt.z).cwiseProduct(metres);
}

MapProjection::MapProjection(const std::string& crs, const std::string& source)
    : state_(std::make_unique<State>()) {
  state_->crs = crs;
  state_->inspect();
  if (source.empty()) {
    state_->transformation = state_->between(kGeodetic, crs);
    return;
  }
  state_->inspectSource(source);
  const bool geocentric = state_->source_kind == CrsKind::geocentric;
  if (geocentric) state_->to_geodetic = state_->between(source, kGeodetic);
  state_->transformation = state_->between(geocentric ? kGeodetic : source, crs);
}

MapProjection::Result MapProjection::project(double latitude, double longitude,
                                             double height) const {
  return project(Eigen::Vector3d(latitude, longitude, height));
}

MapProjection::Result MapProjection::project(const Eigen::Vector3d& position) const {
  // proj_factors() takes 3 to 10 ms per call on a CRS (PROJ 9.1) and refuses compound ones, so the
  // direction of north is a difference of the transformation itself, which includes the datum's
  // turn. Half a step is 11 m: the error is the third derivative of the meridian's image, under
  // 1e-11 rad; rounding adds 1e-9 m / 22 m.
  const bool map = state_->source_kind == CrsKind::projected;
  const Eigen::Vector3d place =
      state_->source_kind == CrsKind::geocentric ? state_->geodetic(position) : position;
  const Eigen::Vector3d step =
      map ? Eigen::Vector3d(0.0, 11.0, 0.0) : Eigen::Vector3d(1e-4 * kRadiansPerDegree, 0.0, 0.0);
  Result result;
  result.position = state_->map(place);
  const Eigen::Vector3d north = state_->map(place + step) - state_->map(place - step);
  result.north_azimuth = std::atan2(north.x(), north.y());
  // A height that is the ellipsoidal one to rounding of its unit was handed through.
  if (state_->needs_geoid && std::abs(result.position.z() - place.z()) < 1e-7) {
    throw InputError(
        nameOf(state_->crs) +
        ": the geoid grid of its heights is not installed for PROJ; if the points have "
        "ellipsoidal heights, give the CRS of plan only");
  }
  return result;
}

Eigen::Vector3d MapProjection::unproject(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d units = position.cwiseQuotient(state_->metres);
  const PJ_COORD back = proj_trans(state_->transformation.get(), PJ_INV,
                                   proj_coord(units.x(), units.y(), units.z(), HUGE_VAL));
  return {back.xyzt.y * kRadiansPerDegree, back.xyzt.x * kRadiansPerDegree, back.xyzt.z};
}

struct GeoidGrid::State {
  ProjContext context = quietProjContext();
  ProjObject shift;
};

GeoidGrid::GeoidGrid(const std::string& path) : state_(std::make_unique<State>()) {
  const std::string definition = "+proj=vgridshift +multiplier=1 +grids=" + path;
  if (path.find_first_of(" \t,") == std::string::npos)
    state_->shift.reset(proj_create(state_->context.get(), definition.c_str()));
  if (!state_->shift) throw InputError(path + ": is not a grid of a geoid that PROJ reads");
}

double GeoidGrid::undulation(double latitude, double longitude) const {
  const PJ_COORD result =
      proj_trans(state_->shift.get(), PJ_FWD, proj_coord(longitude, latitude, 0.0, HUGE_VAL));
  return result.xyzt.z;
}

#else

struct MapProjection::State {};

struct GeoidGrid::State {};

MapProjection::MapProjection(const std::string& /*crs*/, const std::string& /*source*/) {
  throw InputError(
      "an SBET needs PROJ, which this build lacks (PCL_ALS_WITH_PROJ=OFF); convert the trajectory "
      "to CSV");
}

MapProjection::Result MapProjection::project(double /*latitude*/, double /*longitude*/,
                                             double /*height*/) const {
  return {Eigen::Vector3d::Constant(std::nan("")), 0.0};
}

MapProjection::Result MapProjection::project(const Eigen::Vector3d& /*position*/) const {
  return {Eigen::Vector3d::Constant(std::nan("")), 0.0};
}

Eigen::Vector3d MapProjection::unproject(const Eigen::Vector3d& /*position*/) const {
  return Eigen::Vector3d::Constant(std::nan(""));
}

GeoidGrid::GeoidGrid(const std::string& path) {
  throw InputError(path + ": a geoid needs PROJ, which this build lacks (PCL_ALS_WITH_PROJ=OFF)");
}

double GeoidGrid::undulation(double /*latitude*/, double /*longitude*/) const {
  return std::nan("");
}

#endif

MapProjection::~MapProjection() = default;
GeoidGrid::~GeoidGrid() = default;

}  // namespace pcl_als
