// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cstdint>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/class_maps.h>

namespace pcl_als {
namespace {

using Colour = std::array<std::uint8_t, 3>;

/// The colour itself, or one that no class has yet.
Colour freeColour(const Colour& wanted, const std::vector<CodeMeaning>& legend) {
  const auto taken = [&](const Colour& colour) {
    return std::any_of(legend.begin(), legend.end(),
                       [&](const CodeMeaning& entry) { return entry.colour == colour; });
  };
  if (!taken(wanted)) return wanted;
  for (const Colour& colour : spareColours())
    if (!taken(colour)) return colour;
  return wanted;
}

/// The code of a class in the common legend, to which new classes are added.
std::uint8_t commonCode(const CodeMeaning& entry, std::vector<CodeMeaning>& legend,
                        const std::filesystem::path& path) {
  for (const CodeMeaning& known : legend)
    if (known.name == entry.name) return known.value;
  if (legend.size() == 255)
    throw InputError(path.string() + ": together with the other map it has more than 255 classes");
  const auto code = static_cast<std::uint8_t>(legend.size() + 1);
  legend.push_back({code, entry.name, freeColour(entry.colour, legend)});
  return code;
}

[[noreturn]] void refuseWithoutNames(const std::filesystem::path& path) {
  throw InputError(
      path.string() +
      ": has no names of classes; maps of pcl_als_classify have them as items CLASS_1, "
      "CLASS_2, …");
}

}  // namespace

const std::vector<Colour>& spareColours() {
  static const std::vector<Colour> colours{
      {0xE6, 0x9F, 0x00}, {0x56, 0xB4, 0xE9}, {0x00, 0x9E, 0x73}, {0xF0, 0xE4, 0x42},
      {0x00, 0x72, 0xB2}, {0xD5, 0x5E, 0x00}, {0xCC, 0x79, 0xA7}};
  return colours;
}

ClassMaps readClassMaps(const std::vector<TitledMap>& maps, int largest_side) {
  ClassMaps result;
  for (const TitledMap& map : maps) {
    CodeRaster raster = readCodeRaster(map.raster, largest_side);
    if (raster.legend.empty()) refuseWithoutNames(map.raster);
    std::array<std::uint8_t, 256> codes{};
    for (const CodeMeaning& entry : raster.legend)
      codes[entry.value] = commonCode(entry, result.legend, map.raster);
    for (std::uint8_t& value : raster.values) value = codes[value];
    result.maps.push_back(std::move(raster));
  }
  for (CodeRaster& raster : result.maps) raster.legend = result.legend;
  return result;
}

void requireClassMap(const std::filesystem::path& path) {
  const RasterReader reader(path);
  if (reader.layout().type != RasterLayout::Type::byte || reader.layout().legend.empty())
    refuseWithoutNames(path);
}

}  // namespace pcl_als
