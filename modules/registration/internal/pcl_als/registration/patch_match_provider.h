// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl/types.h>

#include <pcl_als/registration/cloud_surface.h>

namespace pcl_als {

/// Provides the patches of source points to a rejector and to a transformation estimation, so that
/// these do not search them again.
class PatchMatchProvider {
 public:
  virtual ~PatchMatchProvider() = default;
  /// The target's patches; null before the first search.
  virtual CloudSurface::ConstPtr getSurface() const = 0;
  /// The match of a source point in the latest search; null where it has none.
  virtual const PatchMatch* findMatch(pcl::index_t source_point) const = 0;
  /// Called by a transformation estimation that has used the matches of the latest search.
  virtual void markTransformationEstimated() const = 0;
};

}  // namespace pcl_als
