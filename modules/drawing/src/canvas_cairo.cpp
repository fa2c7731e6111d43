// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>
#include <mutex>

#include <cairo-pdf.h>

#include <pcl_als/drawing/canvas.h>

#include "cairo_handles.h"
#include "text_metrics.h"

namespace pcl_als {
namespace {

using detail::CairoContext;
using detail::CairoSurface;
using Element = Canvas::Element;

constexpr double kPointsPerPixel = 0.75;

cairo_font_face_t* faceOf(bool bold) {
  using Face = std::unique_ptr<cairo_font_face_t, detail::CairoRelease>;
  static const Face regular(cairo_toy_font_face_create(detail::kFontFamily, CAIRO_FONT_SLANT_NORMAL,
                                                       CAIRO_FONT_WEIGHT_NORMAL));
  static const Face strong(cairo_toy_font_face_create(detail::kFontFamily, CAIRO_FONT_SLANT_NORMAL,
                                                      CAIRO_FONT_WEIGHT_BOLD));
  return bold ? strong.get() : regular.get();
}

/// Glyphs as the font describes them, on every surface alike.
cairo_font_options_t* fontOptions() {
  static const auto options = [] {
    std::unique_ptr<cairo_font_options_t, detail::CairoRelease> made(cairo_font_options_create());
    cairo_font_options_set_hint_style(made.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(made.get(), CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(made.get(), CAIRO_ANTIALIAS_GRAY);
    return made;
  }();
  return options.get();
}

/// Connected points; one that is not finite begins a new part.
void tracePath(cairo_t* context, const std::vector<Eigen::Vector2d>& points) {
  bool connected = false;
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) {
      connected = false;
      continue;
    }
    connected ? cairo_line_to(context, point.x(), point.y())
              : cairo_move_to(context, point.x(), point.y());
    connected = true;
  }
}

void renderImage(cairo_t* context, const Element& element) {
  const Image& image = *element.image;
  const CairoSurface surface = detail::surfaceOf(image);
  cairo_translate(context, element.box.x, element.box.y);
  cairo_scale(context, element.box.width / image.width, element.box.height / image.height);
  cairo_set_source_surface(context, surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_rectangle(context, 0.0, 0.0, image.width, image.height);
  cairo_fill(context);
}

void renderText(cairo_t* context, const Element& element) {
  cairo_translate(context, element.points[0].x(), element.points[0].y());
  if (element.upward) cairo_rotate(context, -0.5 * M_PI);
  cairo_set_font_face(context, faceOf(element.bold));
  cairo_set_font_size(context, element.size);
  cairo_set_font_options(context, fontOptions());
  cairo_move_to(context, 0.0, 0.0);
  cairo_show_text(context, element.text.c_str());
}

void render(cairo_t* context, const Element& element) {
  cairo_save(context);
  cairo_rectangle(context, element.clip.x, element.clip.y, element.clip.width, element.clip.height);
  cairo_clip(context);
  detail::setColor(context, element.color);
  switch (element.kind) {
    case Element::Kind::area:
      tracePath(context, element.points);
      cairo_fill(context);
      break;
    case Element::Kind::stroke:
      cairo_set_line_width(context, element.size);
      cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
      cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
      tracePath(context, element.points);
      cairo_stroke(context);
      break;
    case Element::Kind::disk:
      detail::fillDisk(context, element.points[0], element.size);
      break;
    case Element::Kind::ring:
      cairo_set_line_width(context, Element::kRingWidth);
      cairo_arc(context, element.points[0].x(), element.points[0].y(),
                0.5 * (element.size - Element::kRingWidth), 0.0, 2.0 * M_PI);
      cairo_stroke(context);
      break;
    case Element::Kind::image:
      renderImage(context, element);
      break;
    case Element::Kind::text:
      renderText(context, element);
      break;
  }
  cairo_restore(context);
}

void renderAll(cairo_t* context, const Canvas& canvas) {
  cairo_set_antialias(context, CAIRO_ANTIALIAS_GOOD);
  for (const Element& element : canvas.elements()) render(context, element);
  detail::requireSuccess(cairo_status(context));
}

/// The drawing in pixels, without alpha where its background has none.
CairoSurface rendered(const Canvas& canvas) {
  const bool opaque = !canvas.elements().empty() && canvas.elements().front().color.a == 255;
  CairoSurface surface(cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32,
                                                  canvas.width(), canvas.height()));
  detail::requireSuccess(cairo_surface_status(surface.get()));
  renderAll(CairoContext(cairo_create(surface.get())).get(), canvas);
  return surface;
}

}  // namespace

void detail::setColor(cairo_t* context, const Color& color) {
  cairo_set_source_rgba(context, color.r / 255.0, color.g / 255.0, color.b / 255.0,
                        color.a / 255.0);
}

void detail::fillDisk(cairo_t* context, const Eigen::Vector2d& center, double diameter) {
  cairo_arc(context, center.x(), center.y(), 0.5 * diameter, 0.0, 2.0 * M_PI);
  cairo_fill(context);
}

double detail::textLength(const std::string& utf8, double size, bool bold) {
  using Font = std::unique_ptr<cairo_scaled_font_t, detail::CairoRelease>;
  static std::mutex mutex;
  static std::map<std::pair<double, bool>, Font> fonts;
  const std::lock_guard<std::mutex> lock(mutex);
  Font& font = fonts[{size, bold}];
  if (font == nullptr) {
    cairo_matrix_t scale, identity;
    cairo_matrix_init_scale(&scale, size, size);
    cairo_matrix_init_identity(&identity);
    font.reset(cairo_scaled_font_create(faceOf(bold), &scale, &identity, fontOptions()));
  }
  cairo_text_extents_t extents{};
  cairo_scaled_font_text_extents(font.get(), utf8.c_str(), &extents);
  return extents.x_advance;
}

Image Canvas::image() const {
  return detail::imageOf(rendered(*this).get());
}

std::vector<std::uint8_t> Canvas::png() const {
  return detail::encodePng(rendered(*this).get());
}

std::string Canvas::pdf() const {
  std::string bytes;
  const CairoSurface surface(cairo_pdf_surface_create_for_stream(
      detail::appendTo<std::string>, &bytes, width_ * kPointsPerPixel, height_ * kPointsPerPixel));
  const CairoContext context(cairo_create(surface.get()));
  cairo_scale(context.get(), kPointsPerPixel, kPointsPerPixel);
  renderAll(context.get(), *this);
  cairo_surface_finish(surface.get());
  detail::requireSuccess(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace pcl_als
