// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/picture/section_files.h>

namespace pcl_als {
namespace {

/// Points that a search for places uses: classes may exclude what is no surface.
enum class Searched { surfaces, ground };

bool isSearched(const PictureSource::Point& point, Searched searched) {
  constexpr std::uint8_t kGround = 2, kLowNoise = 7, kWater = 9, kHighNoise = 18;
  if (point.chunk->number_of_returns[point.index] > 1) return false;
  const std::uint8_t code = point.chunk->classification[point.index];
  if (searched == Searched::ground) return code == kGround;
  const bool vegetation = code >= 3 && code <= 5, wires = code >= 13 && code <= 16;
  return !vegetation && !wires && code != kWater && code != kLowNoise && code != kHighNoise;
}

std::vector<SectionSearch::Place> placesAmong(const PictureSource& source,
                                              const std::vector<bool>& chosen, std::size_t count,
                                              Searched searched) {
  SectionSearch search(source.minimum().head<2>(), source.maximum().head<2>(),
                       source.sectionCell(chosen), chosen.size());
  source.read([&](const PictureSource::Point& point) {
    const auto strip = static_cast<std::size_t>(point.strip);
    if (chosen[strip] && isSearched(point, searched)) search.add(point.position, strip);
  });
  return search.find(count);
}

}  // namespace

std::vector<SectionSearch::Place> findSections(const PictureSource& source,
                                               const std::vector<bool>& chosen, std::size_t count,
                                               double width) {
  auto places = placesAmong(source, chosen, count, Searched::surfaces);
  if (places.empty()) {
    // In a forest without numbers of returns only the ground is smooth. It has no roofs.
    places = placesAmong(source, chosen, count, Searched::ground);
    for (auto& place : places) {
      if (place.kind == SectionSearch::Place::Kind::gable)
        place.kind = SectionSearch::Place::Kind::opposite_slopes;
    }
  }
  for (auto& place : places) {
    if (width > 0.0) place.line.half_width = 0.5 * width;
  }
  return places;
}

std::vector<SectionPoints> collectSections(const PictureSource& source,
                                           const std::vector<SectionSearch::Place>& places,
                                           const std::vector<std::string>& names,
                                           const std::vector<bool>& chosen) {
  std::vector<int> strip_of;
  for (const std::string& name : source.strips()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw InputError("strip " + name + " is not among the strips before");
    }
    strip_of.push_back(static_cast<int>(found - names.begin()));
  }
  std::vector<SectionPoints> sections;
  for (const SectionSearch::Place& place : places) sections.emplace_back(place.line);
  source.read([&](const PictureSource::Point& point) {
    const int strip = strip_of[static_cast<std::size_t>(point.strip)];
    if (!chosen[static_cast<std::size_t>(strip)]) return;
    for (SectionPoints& section : sections) section.add(point.position, strip);
  });
  return sections;
}

}  // namespace pcl_als
