// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_als {

/// 8 bit per channel, sRGB; alpha 255 is opaque.
struct Color {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;

  static Color rgb(std::uint32_t hex) {  ///< 0xRRGGBB
    return {static_cast<std::uint8_t>(hex >> 16U), static_cast<std::uint8_t>(hex >> 8U),
            static_cast<std::uint8_t>(hex), 255};
  }
  Color withAlpha(std::uint8_t alpha) const { return {r, g, b, alpha}; }
  bool operator==(const Color& o) const { return r == o.r && g == o.g && b == o.b && a == o.a; }
  bool operator!=(const Color& o) const { return !(*this == o); }
};

/// Colours that every picture shares.
namespace ink {
inline const Color black{0x1a, 0x1a, 0x1a}, gray{0x66, 0x66, 0x66}, faint{0xe2, 0xe2, 0xe2},
    white{0xff, 0xff, 0xff}, ground{0xf4, 0xf4, 0xf2};
/// Text on a coloured ground, the same in every theme.
inline const Color on_light{0x14, 0x14, 0x14}, on_dark{0xfd, 0xfd, 0xfd};
/// "as delivered" and "corrected", in every plot: vermilion and blue of Okabe and Ito.
inline const Color before{0xd5, 0x5e, 0x00}, after{0x00, 0x72, 0xb2};
}  // namespace ink

/// Linear mix in sRGB; \a t = 0 gives a, 1 gives b.
Color mix(const Color& a, const Color& b, double t);

/** \brief Maps [0, 1] to colours that readers with any colour vision order the same way.
 *
 * viridis and cividis rise in lightness; diverging goes blue - white - vermilion, for signed
 * values; gray is for intensity.
 */
class ColorMap {
 public:
  /// viridis, cividis, diverging or gray; UsageError for any other name.
  static ColorMap named(const std::string& name);
  static const std::vector<std::string>& names();

  Color operator()(double t) const;  ///< t outside [0, 1] is clamped; NaN gives gray 0x99

 private:
  std::vector<Color> stops_;
};

/// The i-th of a set of colours for categories, distinguishable with any colour vision for the
/// first eight (Okabe and Ito); later ones repeat darker, then lighter.
Color categoryColor(std::size_t i);

/// Colour of an ASPRS class code, vegetation by lightness too.
Color classColor(int code);

}  // namespace pcl_als
