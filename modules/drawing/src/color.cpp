// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/color.h>

namespace pcl_als {
namespace {

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// viridis and cividis (van der Walt, Smith; Nuñez, Anderton, Renslow 2018), sampled at tenths.
const std::vector<Color>& stopsOf(const std::string& name) {
  const auto table = [](std::initializer_list<std::uint32_t> values) {
    std::vector<Color> colors;
    for (const std::uint32_t value : values) colors.push_back(Color::rgb(value));
    return colors;
  };
  static const std::vector<Color> viridis =
      table({0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58,
             0xb5de2b, 0xfde725});
  static const std::vector<Color> cividis =
      table({0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173, 0x8a8678, 0xa59c74, 0xc3b369,
             0xe1cc55, 0xfee838});
  static const std::vector<Color> diverging =
      table({0x053d66, 0x0072b2, 0x6fb1d8, 0xf2f2f2, 0xeca36a, 0xd55e00, 0x7d3200});
  static const std::vector<Color> gray = table({0x101010, 0xfafafa});
  if (name == "viridis") return viridis;
  if (name == "cividis") return cividis;
  if (name == "diverging") return diverging;
  if (name == "gray") return gray;
  throw UsageError("color map '" + name + "' is none of viridis, cividis, diverging, gray");
}

// Ground earth-coloured, vegetation green by height, buildings vermilion, water blue.
constexpr std::array<std::uint32_t, 19> kClassColors = {
    0x8c8c8c, 0xb8b8b8, 0xc8a465, 0xbfe3a0, 0x5fb564, 0x0b6e3f, 0xd55e00,
    0xff00c8, 0xf0e442, 0x0072b2, 0x5a2d82, 0x4d4d4d, 0xdadada, 0xcc79a7,
    0xe69f00, 0x8b1a4b, 0xf5c7de, 0x56b4e9, 0xb4009e};

}  // namespace

Color mix(const Color& a, const Color& b, double t) {
  const auto blend = [t](std::uint8_t from, std::uint8_t to) {
    return channel(from + t * (static_cast<double>(to) - from));
  };
  return {blend(a.r, b.r), blend(a.g, b.g), blend(a.b, b.b), blend(a.a, b.a)};
}

ColorMap ColorMap::named(const std::string& name) {
  ColorMap map;
  map.stops_ = stopsOf(name);
  return map;
}

const std::vector<std::string>& ColorMap::names() {
  static const std::vector<std::string> names = {"viridis", "cividis", "diverging", "gray"};
  return names;
}

Color ColorMap::operator()(double t) const {
  if (std::isnan(t)) return {0x99, 0x99, 0x99};
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops_.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops_.size() - 2);
  return mix(stops_[low], stops_[low + 1], at - static_cast<double>(low));
}

Color categoryColor(std::size_t i) {
  static const std::array<std::uint32_t, 8> okabe_ito = {0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7,
                                                         0x56b4e9, 0xd55e00, 0xf0e442, 0x444444};
  const Color base = Color::rgb(okabe_ito[i % okabe_ito.size()]);
  const std::size_t round = i / okabe_ito.size() % 3;
  if (round == 0) return base;
  return mix(base, round == 1 ? ink::black : ink::white, 0.4);
}

Color classColor(int code) {
  const auto at = static_cast<std::size_t>(std::abs(code));
  if (code == 26) return Color::rgb(0x6d5f4b);  // civil structure, in AHN
  return at < kClassColors.size() ? Color::rgb(kClassColors[at]) : categoryColor(at);
}

}  // namespace pcl_als
