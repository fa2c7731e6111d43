// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "dot_layer.h"

namespace pcl_als::detail {

DotLayer::DotLayer(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)),
      context_(cairo_create(surface_.get())) {
  requireSuccess(cairo_status(context_.get()));
}

void DotLayer::add(const Eigen::Vector2d& at, double diameter, const Color& color) {
  setColor(context_.get(), color);
  fillDisk(context_.get(), at, diameter);
}

}  // namespace pcl_als::detail
