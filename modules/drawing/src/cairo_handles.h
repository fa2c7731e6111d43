// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <Eigen/Core>
#include <cairo.h>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als::detail {

struct CairoRelease {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
  void operator()(cairo_font_face_t* face) const { cairo_font_face_destroy(face); }
  void operator()(cairo_scaled_font_t* font) const { cairo_scaled_font_destroy(font); }
};
using CairoContext = std::unique_ptr<cairo_t, CairoRelease>;
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoRelease>;

/// Throws std::bad_alloc or Error where Cairo reports a failure.
void requireSuccess(cairo_status_t status);

/// For streams of Cairo: appends to a std::string or a vector of bytes.
template <typename Bytes>
cairo_status_t appendTo(void* bytes, const unsigned char* data, unsigned int length) {
  auto& all = *static_cast<Bytes*>(bytes);
  all.insert(all.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void setColor(cairo_t* context, const Color& color);
void fillDisk(cairo_t* context, const Eigen::Vector2d& center, double diameter);

/// The bytes of a PNG file: RGB, or RGBA of a surface with alpha.
std::vector<std::uint8_t> encodePng(cairo_surface_t* surface);

/// A surface with the pixels of an image, and back.
CairoSurface surfaceOf(const Image& image);
Image imageOf(cairo_surface_t* surface);

}  // namespace pcl_als::detail
