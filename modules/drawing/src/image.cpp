// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdint>
#include <new>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/canvas.h>

#include "cairo_handles.h"

namespace pcl_als {
namespace {

/// Cairo's pixels are native 32 bit numbers with colours multiplied by alpha.
std::uint32_t packed(const Color& color) {
  const auto scaled = [&](std::uint8_t channel) {
    return static_cast<std::uint32_t>((channel * color.a + 127) / 255);
  };
  return static_cast<std::uint32_t>(color.a) << 24U | scaled(color.r) << 16U |
         scaled(color.g) << 8U | scaled(color.b);
}

Color unpacked(std::uint32_t pixel) {
  const std::uint32_t alpha = pixel >> 24U;
  if (alpha == 0) return {0, 0, 0, 0};
  const auto channel = [&](unsigned bits) {
    return static_cast<std::uint8_t>(
        std::min(255U, (((pixel >> bits) & 255U) * 255U + alpha / 2) / alpha));
  };
  return {channel(16), channel(8), channel(0), static_cast<std::uint8_t>(alpha)};
}

}  // namespace

namespace detail {

void requireSuccess(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  throw Error(std::string("a picture cannot be drawn: ") + cairo_status_to_string(status));
}

std::vector<std::uint8_t> encodePng(cairo_surface_t* surface) {
  using Bytes = std::vector<std::uint8_t>;
  Bytes bytes;
  requireSuccess(cairo_surface_write_to_png_stream(surface, appendTo<Bytes>, &bytes));
  return bytes;
}

CairoSurface surfaceOf(const Image& image) {
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(),
                                  [](const Color& color) { return color.a == 255; });
  CairoSurface surface(cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32,
                                                  image.width, image.height));
  requireSuccess(cairo_surface_status(surface.get()));
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface.get()) +
                                                 static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < image.width; ++x) row[x] = packed(image.at(x, y));
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Image imageOf(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const bool opaque = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_RGB24;
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        cairo_image_surface_get_data(surface) + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = unpacked(opaque ? row[x] | 0xff000000U : row[x]);
  }
  return image;
}

}  // namespace detail

std::vector<std::uint8_t> encodePng(const Image& image) {
  if (image.width < 1 || image.height < 1) throw UsageError("an image without pixels");
  return detail::encodePng(detail::surfaceOf(image).get());
}

void writePng(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encodePng(image);
  writeFile(path, std::string(bytes.begin(), bytes.end()));
}

}  // namespace pcl_als
