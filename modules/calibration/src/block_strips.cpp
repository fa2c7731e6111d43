// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>

#include "block.h"

namespace pcl_als {
namespace {

constexpr const char* kFixedStrips = "fixed strips";

void addHeldSystem(const BlockStrips::Held& held, StripSystems& systems) {
  if (held.is_reference)
    systems.held.push_back({held.surface.offset, 0.0, held.surface.std, false});
  else
    systems.held.push_back({held.surface.offset, held.surface.offset, 0.0, true});
}

/// Marks the strips of that id or pass as those of the last held surface.
void holdStrip(const std::string& name, BlockStrips& strips) {
  bool found = false;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips.isReference(static_cast<int>(i)) ||
        (strips.ids[i] != name && passOfStrip(strips.ids[i]) != name))
      continue;
    strips.fixed_surface_of[i] = static_cast<int>(strips.held.size()) - 1;
    found = true;
  }
  if (!found) throw UsageError("there is no strip " + name + " to be held fixed");
}

}  // namespace

int BlockStrips::add(const std::string& id) {
  ids.push_back(id);
  used.push_back(true);
  fixed_surface_of.push_back(-1);
  return static_cast<int>(ids.size()) - 1;
}

int BlockStrips::addReference(const ReferenceSurface& surface) {
  if (!(surface.std > 0.0) || !std::isfinite(surface.std) || !(surface.offset >= 0.0))
    throw UsageError("reference surface " + surface.name +
                     ": its standard deviation must be positive");
  if (std::find(ids.begin(), ids.end(), surface.name) != ids.end())
    throw UsageError("reference surface " + surface.name +
                     ": a strip or another surface has this name");
  const int strip = add(surface.name);
  fixed_surface_of.back() = static_cast<int>(held.size());
  held.push_back({surface, true});
  return strip;
}

bool BlockStrips::isReference(int strip) const {
  return isFixed(strip) &&
         held[static_cast<std::size_t>(fixed_surface_of[static_cast<std::size_t>(strip)])]
             .is_reference;
}

std::vector<int> BlockStrips::flown() const {
  std::vector<int> found;
  for (int strip = 0; strip < static_cast<int>(size()); ++strip)
    if (isFlown(strip)) found.push_back(strip);
  return found;
}

std::vector<bool> BlockStrips::corrected() const {
  std::vector<bool> corrected = used;
  for (std::size_t i = 0; i < corrected.size(); ++i)
    corrected[i] = used[i] && !isFixed(static_cast<int>(i));
  return corrected;
}

int BlockStrips::named(const std::string& id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found != ids.end()) return static_cast<int>(found - ids.begin());
  std::string known;
  for (const std::string& name : ids) known += (known.empty() ? "" : ", ") + name;
  throw UsageError("pairs name strip '" + id + "', but the strips are " + known);
}

void holdSurfaces(const CalibrationSettings& settings, BlockStrips& strips, StripSystems& systems) {
  if (!(settings.fixed_sigma >= 0.0))
    throw UsageError("the standard deviation of fixed strips must not be negative");
  if (!settings.fixed.empty())
    strips.held.push_back({{kFixedStrips, settings.noise.range, settings.fixed_sigma}, false});
  for (const std::string& name : settings.fixed) holdStrip(name, strips);
  const int first = systems.count;
  systems.count += static_cast<int>(strips.held.size());
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (strips.fixed_surface_of[i] < 0) continue;
    systems.system[i] = first + strips.fixed_surface_of[i];
    // A surface has no trajectory errors.
    if (strips.isReference(static_cast<int>(i))) systems.pass[i] = static_cast<int>(i);
  }
  for (const BlockStrips::Held& held : strips.held) addHeldSystem(held, systems);
  const auto is_held = [](int held) { return held >= 0; };
  if (!strips.held.empty() &&
      std::all_of(strips.fixed_surface_of.begin(), strips.fixed_surface_of.end(), is_held))
    throw UsageError("all strips are held fixed: there is nothing to calibrate");
}

}  // namespace pcl_als
