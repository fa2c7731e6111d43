// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>

#include <pcl_als/common/error_source.h>
#include <pcl_als/trajectory/bias_evaluator.h>

namespace pcl_als::detail {

/// Displacement of points by known error sources, to first order (SourceEffect).
class SourceCorrection {
 public:
  SourceCorrection(std::shared_ptr<const Trajectory> flight, const ErrorSourceVector& values,
                   const ErrorSourceScale& scale)
      : flight_(std::move(flight)), values_(values), scale_(scale) {}

  /// Adds -displacement (corrected - biased), or with \a invert the displacement, to \a change.
  /// \a points must not be overwritten by \a change. UsageError where a value needs a column that
  /// the points do not have.
  void add(const PointColumns& points, std::size_t count, bool invert,
           const EffectColumns& change) const;

 private:
  void requireColumns(const PointColumns& points) const;

  std::shared_ptr<const Trajectory> flight_;
  ErrorSourceVector values_;
  ErrorSourceScale scale_;
};

}  // namespace pcl_als::detail
