// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "dot_layer.h"

#include <cmath>

namespace pcl_als::detail {

DotLayer::DotLayer(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)),
      context_(cairo_create(surface_.get())) {
  requireSuccess(cairo_status(context_.get()));
}

void DotLayer::add(const Eigen::Vector2d& at, double diameter, const Color& color) {
  cairo_set_source_rgba(context_.get(), color.r / 255.0, color.g / 255.0, color.b / 255.0,
                        color.a / 255.0);
  cairo_arc(context_.get(), at.x(), at.y(), 0.5 * diameter, 0.0, 2.0 * M_PI);
  cairo_fill(context_.get());
}

}  // namespace pcl_als::detail
