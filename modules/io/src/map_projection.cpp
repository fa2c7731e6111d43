// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "map_projection.h"

#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>

#ifdef PCL_ALS_HAVE_PROJ
#include <proj.h>
#endif

namespace pcl_als::detail {

#ifdef PCL_ALS_HAVE_PROJ
namespace {

struct FreeContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct FreeObject {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Object = std::unique_ptr<PJ, FreeObject>;

/// "EPSG:32611" as it is; of a long WKT its beginning.
std::string nameOf(const std::string& crs) {
  constexpr std::size_t kLongest = 60;
  return "CRS '" + (crs.size() > kLongest ? crs.substr(0, kLongest) + "..." : crs) + "'";
}

/// Whether the first axis of a CRS counts in metres; \a unit receives what it counts in.
bool inMetres(PJ_CONTEXT* context, const PJ* crs, std::string& unit) {
  const Object system(proj_crs_get_coordinate_system(context, crs));
  double metres = 0.0;
  const char* name = nullptr;
  if (!system || proj_cs_get_axis_info(context, system.get(), 0, nullptr, nullptr, nullptr, &metres,
                                       &name, nullptr, nullptr) == 0) {
    return false;
  }
  unit = name == nullptr ? "an unknown unit" : name;
  return metres == 1.0;
}

/// The CRS without what PROJ wraps around it: a datum shift to WGS 84.
Object unbound(PJ_CONTEXT* context, Object crs) {
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS) {
    return Object(proj_get_source_crs(context, crs.get()));
  }
  return crs;
}

}  // namespace

struct MapProjection::State {
  std::unique_ptr<PJ_CONTEXT, FreeContext> context{proj_context_create()};
  Object transformation;
  std::string crs;
  bool needs_geoid = false;

  void inspect();
  Eigen::Vector3d map(double latitude, double longitude, double height) const;
};

/// Refuses what is not a map in metres; finds out whether its heights are above a geoid.
void MapProjection::State::inspect() {
  PJ_CONTEXT* ctx = context.get();
  Object object = unbound(ctx, Object(proj_create(ctx, crs.c_str())));
  if (!object) throw InputError(nameOf(crs) + ": PROJ does not know it; give one with -crs");
  std::string unit;
  if (proj_get_type(object.get()) == PJ_TYPE_COMPOUND_CRS) {
    const Object vertical = unbound(ctx, Object(proj_crs_get_sub_crs(ctx, object.get(), 1)));
    if (vertical && !inMetres(ctx, vertical.get(), unit)) {
      throw InputError(nameOf(crs) + ": its heights are in " + unit + "; metres are needed");
    }
    needs_geoid = vertical != nullptr;
    object = unbound(ctx, Object(proj_crs_get_sub_crs(ctx, object.get(), 0)));
  }
  if (!object || proj_get_type(object.get()) != PJ_TYPE_PROJECTED_CRS) {
    throw InputError(nameOf(crs) + ": is not a projected CRS; give one with -crs");
  }
  if (!inMetres(ctx, object.get(), unit)) {
    throw InputError(nameOf(crs) + ": counts in " + unit + "; metres are needed");
  }
}

Eigen::Vector3d MapProjection::State::map(double latitude, double longitude, double height) const {
  const PJ_COORD geodetic =
      proj_coord(longitude / kRadiansPerDegree, latitude / kRadiansPerDegree, height, HUGE_VAL);
  const PJ_COORD mapped = proj_trans(transformation.get(), PJ_FWD, geodetic);
  return {mapped.xyzt.x, mapped.xyzt.y, mapped.xyzt.z};
}

MapProjection::MapProjection(const std::string& crs) : state_(std::make_unique<State>()) {
  PJ_CONTEXT* context = state_->context.get();
  proj_log_level(context, PJ_LOG_NONE);
  state_->crs = crs;
  state_->inspect();
  const Object authority_order(proj_create_crs_to_crs(context, "EPSG:4979", crs.c_str(), nullptr));
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
  if (state_->needs_geoid && result.position.z() == height) {
    throw InputError(
        nameOf(state_->crs) +
        ": the geoid grid of its heights is not installed for PROJ; if the points have "
        "ellipsoidal heights, give the CRS of plan only with -crs");
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

}  // namespace pcl_als::detail
