// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/drawing/pixel_thinning.h>

namespace pcl_als {

OrthographicCamera::OrthographicCamera(double azimuth_deg, double elevation_deg)
    : azimuth_(azimuth_deg), elevation_(elevation_deg) {
  if (!(elevation_deg >= 0.0 && elevation_deg <= 90.0)) {
    throw UsageError("camera elevation " + std::to_string(elevation_deg) +
                     ": must be 0 (level) to 90 (straight down) degrees");
  }
  if (!std::isfinite(azimuth_deg)) throw UsageError("camera azimuth is no finite number");
  const double a = azimuth_deg * kRadiansPerDegree, e = elevation_deg * kRadiansPerDegree;
  // Straight down is exact: no residue of cos(90 degrees) tilts the picture.
  const double sin_e = elevation_deg == 90.0 ? 1.0 : std::sin(e);
  const double cos_e = elevation_deg == 90.0 ? 0.0 : std::cos(e);
  const Eigen::Vector3d ahead(std::sin(a), std::cos(a), 0.0), vertical(0.0, 0.0, 1.0);
  right_ = {std::cos(a), -std::sin(a), 0.0};
  up_ = sin_e * ahead + cos_e * vertical;
  to_camera_ = sin_e * vertical - cos_e * ahead;
}

void OrthographicCamera::add(const Eigen::Vector3d& ground, ViewExtent& extent) const {
  if (!ground.allFinite()) return;
  const Eigen::Vector3d offset = ground - extent.reference;
  const Eigen::Vector3d seen(right_.dot(offset), up_.dot(offset), to_camera_.dot(offset));
  extent.low = extent.low.cwiseMin(seen);
  extent.high = extent.high.cwiseMax(seen);
}

void OrthographicCamera::frame(const Eigen::Vector3d& minimum, const Eigen::Vector3d& maximum,
                               int width, int height, double zoom) {
  ViewExtent extent;
  extent.reference = 0.5 * (minimum + maximum);
  for (int corner = 0; corner < 8; ++corner) {
    add({(corner & 1) != 0 ? maximum.x() : minimum.x(),
         (corner & 2) != 0 ? maximum.y() : minimum.y(),
         (corner & 4) != 0 ? maximum.z() : minimum.z()},
        extent);
  }
  frame(extent, width, height, zoom);
}

void OrthographicCamera::frame(const ViewExtent& extent, int width, int height, double zoom) {
  if (!(zoom > 0.0) || !std::isfinite(zoom)) throw UsageError("camera zoom: must be above 0");
  if (width < 1 || height < 1) throw UsageError("camera: a picture without pixels");
  if (extent.empty()) throw UsageError("camera: the extent is empty");
  width_ = width;
  height_ = height;
  const Eigen::Vector3d middle = 0.5 * (extent.low + extent.high);
  center_ = extent.reference + middle.x() * right_ + middle.y() * up_ + middle.z() * to_camera_;
  const Eigen::Vector3d size = extent.high - extent.low;
  // A rim of a hundredth of a pixel: rounding, ours and the renderer's, leaves the outermost points
  // inside.
  constexpr double kRim = 0.02;
  const double needed = std::max(size.x() / (width - kRim), size.y() / (height - kRim));
  metres_per_pixel_ = (needed > 0.0 ? needed : 1.0 / std::min(width, height)) / zoom;
}

}  // namespace pcl_als
