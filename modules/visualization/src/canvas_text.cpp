// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkVersionMacros.h>

#include <pcl_als/visualization/canvas.h>

#if VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION < 2
#include <vtkUnicodeString.h>
#define PCL_ALS_VTK_UNICODE 1
#endif

namespace pcl_als {
namespace {

#ifdef PCL_ALS_VTK_UNICODE
// Before 9.2 a vtkStdString loses all that is not ASCII, and only this deprecated type does not.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
vtkUnicodeString vtkText(const std::string& utf8) {
  return vtkUnicodeString::from_utf8(utf8);
}
#else
vtkStdString vtkText(const std::string& utf8) {
  return vtkStdString(utf8);
}
#endif

/// DejaVu, which Debian installs with fontconfig; empty where no such file is: then VTK's own font,
/// which has ASCII only.
std::string fontFile(bool bold) {
  static const auto find = [](const char* name) -> std::string {
    std::array<std::string, 4> folders = {"", "/usr/share/fonts/truetype/dejavu/",
                                          "/usr/share/fonts/dejavu-sans-fonts/",
                                          "/usr/share/fonts/TTF/"};
    if (const char* own = std::getenv("PCL_ALS_FONTS")) folders[0] = std::string(own) + "/";
    for (const std::string& folder : folders) {
      if (!folder.empty() && std::filesystem::exists(folder + name)) return folder + name;
    }
    return {};
  };
  static const std::string regular = find("DejaVuSans.ttf"), strong = find("DejaVuSans-Bold.ttf");
  return bold && !strong.empty() ? strong : regular;
}

std::string asciiOf(std::string text) {
  static const std::array<std::pair<const char*, const char*>, 16> replacements = {{
      {"°", " deg"},
      {"−", "-"},
      {"–", "-"},
      {"—", "-"},
      {"±", "+/-"},
      {"×", "x"},
      {"σ", "sigma"},
      {"²", "2"},
      {"″", "\""},
      {"…", "..."},
      {"·", "*"},
      {"→", "->"},
      {"≤", "<="},
      {"≥", ">="},
      {"µ", "u"},
      {"Δ", "d"},
  }};
  for (const auto& [from, to] : replacements) {
    const std::string pattern = from;
    for (std::size_t at; (at = text.find(pattern)) != std::string::npos;) {
      text.replace(at, pattern.size(), to);
    }
  }
  return text;
}

constexpr int kDotsPerInch = 72;  // a point is a pixel

void setStyle(vtkTextProperty* property, const TextStyle& style) {
  const std::string file = fontFile(style.bold);
  if (file.empty()) {
    property->SetFontFamilyToArial();
    property->SetBold(style.bold ? 1 : 0);
  } else {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(file.c_str());
  }
  property->SetFontSize(static_cast<int>(std::lround(style.size)));
  property->SetColor(0.0, 0.0, 0.0);
}

vtkFreeTypeTools* freeType() {
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->ScaleToPowerTwoOff();
  return tools;
}

/// Offset from the anchor to the low end of an extent.
double shift(Align align, double extent) {
  return align == Align::low ? 0.0 : align == Align::center ? -0.5 * extent : -extent;
}

}  // namespace

Eigen::Vector2d Canvas::textSize(const std::string& utf8, const TextStyle& style) {
  if (utf8.empty()) return Eigen::Vector2d::Zero();
  vtkNew<vtkTextProperty> property;
  setStyle(property, style);
  std::array<int, 4> box{};
  const std::string text = fontFile(false).empty() ? asciiOf(utf8) : utf8;
  freeType()->GetBoundingBox(property, vtkText(text), kDotsPerInch, box.data());
  return {box[1] - box[0] + 1.0, box[3] - box[2] + 1.0};
}

PixelBox Canvas::text(const std::string& utf8, const Eigen::Vector2d& at, const TextStyle& style) {
  if (utf8.empty()) return {at.x(), at.y(), 0.0, 0.0};
  vtkNew<vtkTextProperty> property;
  setStyle(property, style);
  vtkNew<vtkImageData> glyphs;
  std::array<int, 2> dimensions{};
  const std::string text = fontFile(false).empty() ? asciiOf(utf8) : utf8;
  freeType()->RenderString(property, vtkText(text), kDotsPerInch, glyphs, dimensions.data());
  const int* size = glyphs->GetDimensions();
  const int across = size[0], down = size[1];
  const int box_width = style.upward ? down : across, box_height = style.upward ? across : down;
  const int left = static_cast<int>(std::lround(at.x() + shift(style.horizontal, box_width)));
  const int top = static_cast<int>(std::lround(at.y() + shift(style.vertical, box_height)));
  const auto* rgba = static_cast<const std::uint8_t*>(glyphs->GetScalarPointer());
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < across; ++column, rgba += 4) {
      // VTK's rows run up from the lower left corner.
      const int x = style.upward ? down - 1 - row : column;
      const int y = style.upward ? across - 1 - column : down - 1 - row;
      blend(left + x, top + y, style.color, rgba[3] / 255.0);
    }
  }
  texts_.push_back({utf8,
                    {static_cast<double>(left), static_cast<double>(top),
                     static_cast<double>(box_width), static_cast<double>(box_height)}});
  return texts_.back().box;
}

}  // namespace pcl_als
