// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/markup.h>

namespace pcl_als {
namespace {

using Element = Canvas::Element;

/// A colour of namespace ink, its name in the style sheet, and its counterpart on a dark ground.
struct ThemeColor {
  Color light;
  const char* name;
  const char* dark;
};

const std::array<ThemeColor, 7>& themeColors() {
  static const std::array<ThemeColor, 7> colors = {{{ink::black, "black", "#e8e8e6"},
                                                    {ink::gray, "gray", "#a9a9a9"},
                                                    {ink::faint, "faint", "#3a3d40"},
                                                    {ink::white, "white", "#1b1d1f"},
                                                    {ink::ground, "ground", "#25282b"},
                                                    {ink::before, "before", "#f0803c"},
                                                    {ink::after, "after", "#56b4e9"}}};
  return colors;
}

/// With one decimal, without a trailing ".0".
std::string coordinate(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string hexadecimal(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

/// The attributes of a fill or stroke.
std::string paint(const char* kind, const Color& color) {
  std::string text;
  for (const ThemeColor& theme : themeColors()) {
    if (theme.light == color.withAlpha(255))
      text = fmt::format(" class=\"{}-{}\"", kind, theme.name);
  }
  if (text.empty()) text = fmt::format(" {}=\"{}\"", kind, hexadecimal(color));
  if (color.a != 255) text += fmt::format(" {}-opacity=\"{:.2f}\"", kind, color.a / 255.0);
  return text;
}

std::string pathData(const std::vector<Eigen::Vector2d>& points) {
  std::string data;
  char command = 'M';
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) {
      command = 'M';
      continue;
    }
    data += command + coordinate(point.x()) + " " + coordinate(point.y());
    command = 'L';
  }
  return data;
}

std::string circle(const Element& element, double diameter, const std::string& attributes) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n",
                     coordinate(element.points[0].x()), coordinate(element.points[0].y()),
                     fmt::format("{:.2f}", 0.5 * diameter), attributes);
}

std::string imageElement(const Element& element) {
  const PixelBox& box = element.box;
  return fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
      "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
      coordinate(box.x), coordinate(box.y), coordinate(box.width), coordinate(box.height),
      base64(encodePng(*element.image)));
}

std::string textElement(const Element& element) {
  const std::string x = coordinate(element.points[0].x()), y = coordinate(element.points[0].y());
  return fmt::format(
      "<text x=\"{0}\" y=\"{1}\" font-size=\"{2}\"{3}{4} textLength=\"{5:.1f}\" "
      "lengthAdjust=\"spacingAndGlyphs\"{6}>{7}</text>\n",
      x, y, coordinate(element.size), element.bold ? " font-weight=\"bold\"" : "",
      element.upward ? fmt::format(" transform=\"rotate(-90 {} {})\"", x, y) : "", element.length,
      paint("fill", element.color), escapeHtml(element.text));
}

std::string svgOf(const Element& element) {
  switch (element.kind) {
    case Element::Kind::area:
      return fmt::format("<path d=\"{}Z\"{}/>\n", pathData(element.points),
                         paint("fill", element.color));
    case Element::Kind::stroke:
      return fmt::format("<path d=\"{}\" fill=\"none\" stroke-width=\"{:.1f}\"{}/>\n",
                         pathData(element.points), element.size, paint("stroke", element.color));
    case Element::Kind::disk:
      return circle(element, element.size, paint("fill", element.color));
    case Element::Kind::ring:
      return circle(element, element.size - Element::kRingWidth,
                    fmt::format(" fill=\"none\" stroke-width=\"{}\"", Element::kRingWidth) +
                        paint("stroke", element.color));
    case Element::Kind::image:
      return imageElement(element);
    case Element::Kind::text:
      return textElement(element);
  }
  return {};
}

}  // namespace

std::string Canvas::themeStyle() {
  std::string light, dark, variables, dark_variables;
  const auto append = [](const std::string& name, const std::string& color, std::string& classes,
                         std::string& values) {
    classes += fmt::format(".fill-{0}{{fill:{1}}}.stroke-{0}{{stroke:{1}}}", name, color);
    values += fmt::format("--{}:{};", name, color);
  };
  for (const ThemeColor& color : themeColors()) {
    append(color.name, hexadecimal(color.light), light, variables);
    append(color.name, color.dark, dark, dark_variables);
  }
  return ":root{" + variables + "}" + light +
         "\n@media screen and (prefers-color-scheme:dark){:root{" + dark_variables + "}" + dark +
         "}\n";
}

std::string Canvas::svg(const std::string& description) const {
  return svgElement("",
                    description.empty() ? "" : "<title>" + escapeHtml(description) + "</title>\n");
}

std::string Canvas::svgElement(const std::string& attributes, const std::string& head) const {
  std::string out = fmt::format(
      "<svg{2} width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\" font-family=\"DejaVu Sans,Verdana,sans-serif\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\">\n{3}",
      width_, height_, attributes, head);
  const PixelBox whole{0.0, 0.0, static_cast<double>(width_), static_cast<double>(height_)};
  // Elements that are cut off at one box are in an inner picture of that box.
  PixelBox clip = whole;
  for (const Element& element : elements_) {
    if (element.clip != clip) {
      if (clip != whole) out += "</svg>\n";
      clip = element.clip;
      if (clip != whole) {
        const std::string box = fmt::format("{} {} {} {}", clip.x, clip.y, clip.width, clip.height);
        out += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"{}\">\n",
                           clip.x, clip.y, clip.width, clip.height, box);
      }
    }
    out += svgOf(element);
  }
  if (clip != whole) out += "</svg>\n";
  return out + "</svg>\n";
}

}  // namespace pcl_als
