// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

// Only in builds with PROJ.
#include <memory>
#include <string>

#include <proj.h>

namespace pcl_als::detail {

struct FreeProjContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct FreeProjObject {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, FreeProjContext>;
using ProjObject = std::unique_ptr<PJ, FreeProjObject>;

/// A context of its own, for one thread, that prints nothing.
inline ProjContext quietProjContext() {
  ProjContext context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

/// The CRS without what PROJ wraps around it: a datum shift to WGS 84.
inline ProjObject unboundCrs(PJ_CONTEXT* context, ProjObject crs) {
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
    return ProjObject(proj_get_source_crs(context, crs.get()));
  return crs;
}

/// A CRS and its parts; both null where PROJ does not know the text.
struct ProjCrs {
  ProjObject horizontal;  ///< the whole where it is not compound
  ProjObject vertical;    ///< null where it is not compound
};

inline ProjCrs openCrs(PJ_CONTEXT* context, const std::string& crs) {
  ProjCrs parts;
  ProjObject whole = unboundCrs(context, ProjObject(proj_create(context, crs.c_str())));
  if (!whole || proj_is_crs(whole.get()) == 0) return parts;
  if (proj_get_type(whole.get()) != PJ_TYPE_COMPOUND_CRS) {
    parts.horizontal = std::move(whole);
    return parts;
  }
  const auto part = [&](int index) {
    return unboundCrs(context, ProjObject(proj_crs_get_sub_crs(context, whole.get(), index)));
  };
  parts.horizontal = part(0);
  parts.vertical = part(1);
  return parts;
}

}  // namespace pcl_als::detail
