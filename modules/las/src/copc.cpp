// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "copc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kEntryBytes = 32;
constexpr std::size_t kEntriesAtOnce = 4096;
constexpr int kDeepest = 30;  ///< coordinates of nodes are 32-bit numbers
constexpr std::int32_t kPage = -1;
constexpr std::size_t kMostOthersVisited = 1024;

using Key = std::array<std::int32_t, 4>;  ///< level, x, y, z

/// An entry of a page: a node, or another page.
struct Entry {
  Key key{};
  std::uint64_t offset = 0;
  std::int32_t bytes = 0, points = 0;
};

Entry parseEntry(const std::byte* at) {
  Entry entry;
  for (std::size_t i = 0; i < 4; ++i) entry.key[i] = loadLas<std::int32_t>(at + 4 * i);
  entry.offset = loadLas<std::uint64_t>(at + 16);
  entry.bytes = loadLas<std::int32_t>(at + 24);
  entry.points = loadLas<std::int32_t>(at + 28);
  return entry;
}

std::string nameOf(const Key& key) {
  std::string text = "node";
  for (std::size_t i = 0; i < 4; ++i) text += (i == 0 ? " " : "-") + std::to_string(key[i]);
  return text;
}
std::string nameOf(const Entry& entry) {
  return nameOf(entry.key);
}

class Hierarchy {
 public:
  Hierarchy(const CopcInfo& info, const CopcFile& file, const LasWindow& window)
      : info_(info), file_(file), deepest_(deepestLevel(info, window)) {
    if (!window.bounds) return;
    const Eigen::Vector2d margin =
        Eigen::Vector2d::Constant(file.scale.head<2>().cwiseAbs().maxCoeff());
    bounds_ = Eigen::AlignedBox2d(window.bounds->min() - margin, window.bounds->max() + margin);
  }

  std::vector<CopcNode> nodes() {
    addPage(info_.root_offset, info_.root_size, "the root page");
    while (!pages_.empty()) {
      const Page page = pages_.back();
      pages_.pop_back();
      readPage(page);
    }
    checkParents();
    std::uint64_t points = 0;
    for (const CopcNode& node : nodes_) points += node.points;
    if (points != file_.points)
      refuse("the nodes of its octree hold " + std::to_string(points) + " of the " +
             std::to_string(file_.points) + " points of the file");
    checkPlaces();
    return std::move(nodes_);
  }

 private:
  struct Page {
    std::uint64_t offset = 0, bytes = 0;
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(file_.name + ": " + what +
                     " (damaged COPC hierarchy; a conversion without bounds makes a file without)");
  }

  /// The first level whose points are close enough together.
  static int deepestLevel(const CopcInfo& info, const LasWindow& window) {
    if (!(window.resolution > 0.0)) return kDeepest;
    int level = 0;
    while (level < kDeepest && std::ldexp(info.spacing, -level) > window.resolution) ++level;
    return level;
  }

  void addPage(std::uint64_t offset, std::uint64_t bytes, const std::string& name) {
    if (bytes == 0 || bytes % kEntryBytes != 0 || bytes > file_.size || offset > file_.size - bytes)
      refuse(name + " of " + std::to_string(bytes) + " bytes at byte " + std::to_string(offset) +
             " is not within the file of " + std::to_string(file_.size) + " bytes");
    page_bytes_ += bytes;
    if (!known_pages_.insert(offset).second || page_bytes_ > file_.size)
      refuse(name + " at byte " + std::to_string(offset) + " is referred to more than once");
    pages_.push_back({offset, bytes});
  }

  void readPage(const Page& page) {
    std::vector<std::byte> buffer(kEntriesAtOnce * kEntryBytes);
    for (std::uint64_t done = 0; done < page.bytes;) {
      const std::size_t part = std::min<std::uint64_t>(buffer.size(), page.bytes - done);
      file_.read(page.offset + done, part, buffer.data());
      for (std::size_t at = 0; at < part; at += kEntryBytes) take(parseEntry(&buffer[at]));
      done += part;
    }
  }

  void take(const Entry& entry) {
    checkKey(entry);
    if (entry.points != kPage && !keys_.insert(entry.key).second)
      refuse(nameOf(entry) + " stands there twice");
    if (entry.points == 0) return;
    if (entry.points < kPage || entry.bytes <= 0)
      refuse(nameOf(entry) + " has " + std::to_string(entry.points) + " points in " +
             std::to_string(entry.bytes) + " bytes");
    const auto bytes = static_cast<std::uint64_t>(entry.bytes);
    if (entry.points == kPage) return addPage(entry.offset, bytes, "the page of " + nameOf(entry));
    if (bytes > file_.size || entry.offset > file_.size - bytes)
      refuse(nameOf(entry) + ", " + std::to_string(bytes) + " bytes at byte " +
             std::to_string(entry.offset) + ", is not within the file of " +
             std::to_string(file_.size) + " bytes");
    nodes_.push_back(
        {entry.offset, bytes, static_cast<std::uint64_t>(entry.points), wanted(entry)});
    cubes_.push_back(entry.key);
  }

  /// Every wanted node is read anyway; others are visited in equal steps.
  void checkPlaces() const {
    const std::size_t every = nodes_.size() / kMostOthersVisited + 1;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].wanted || i % every == 0) checkPlace(nodes_[i], cubes_[i]);
  }

  /// A chunk begins with its first point, not compressed.
  void checkPlace(const CopcNode& node, const Key& key) const {
    std::array<std::byte, 3 * sizeof(std::int32_t)> record;
    if (node.bytes < record.size()) refuse(nameOf(key) + " is too short for a point");
    file_.read(node.offset, record.size(), record.data());
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = loadLas<std::int32_t>(&record[static_cast<std::size_t>(4 * axis)]);
    point = point.cwiseProduct(file_.scale) + file_.offset;
    const Eigen::Vector3d margin =
        2.0 * file_.scale.cwiseAbs();  // positions may have been rounded twice
    const Eigen::AlignedBox3d cube = cubeOf(key);
    if (!Eigen::AlignedBox3d(cube.min() - margin, cube.max() + margin).contains(point))
      refuse("the first point of " + nameOf(key) + " lies outside its cube");
  }

  Eigen::AlignedBox3d cubeOf(const Key& key) const {
    const double size = std::ldexp(2.0 * info_.half_size, -key[0]);
    const Eigen::Vector3d low = (info_.centre.array() - info_.half_size).matrix() +
                                size * Eigen::Vector3d(key[1], key[2], key[3]);
    return {low, (low.array() + size).matrix()};
  }

  /// A reader that descends from the root does not find a node without its parent.
  void checkParents() const {
    for (const Key& key : keys_) {
      if (key[0] == 0) continue;
      const Key parent{key[0] - 1, key[1] >> 1, key[2] >> 1, key[3] >> 1};
      if (keys_.count(parent) == 0) refuse("the parent of " + nameOf(key) + " is missing");
    }
  }

  void checkKey(const Entry& entry) const {
    const std::int32_t level = entry.key[0];
    bool valid = level >= 0 && level <= kDeepest;
    for (std::size_t i = 1; valid && i < 4; ++i)
      valid = entry.key[i] >= 0 && entry.key[i] < (std::int32_t{1} << level);
    if (!valid) refuse(nameOf(entry) + " is no node of an octree");
  }

  bool wanted(const Entry& entry) const {
    if (entry.key[0] > deepest_) return false;
    if (bounds_.isEmpty()) return true;
    const Eigen::AlignedBox3d cube = cubeOf(entry.key);
    return bounds_.intersects(Eigen::AlignedBox2d(cube.min().head<2>(), cube.max().head<2>()));
  }

  const CopcInfo& info_;
  const CopcFile& file_;
  const int deepest_;
  Eigen::AlignedBox2d bounds_;  ///< empty: everywhere
  std::vector<Page> pages_;     ///< to be read
  std::set<std::uint64_t> known_pages_;
  std::uint64_t page_bytes_ = 0;
  std::set<Key> keys_;
  std::vector<CopcNode> nodes_;
  std::vector<Key> cubes_;  ///< of nodes_
};

}  // namespace

CopcInfo parseCopcInfo(const std::vector<std::byte>& payload, const CopcFile& file) {
  if (payload.size() < kCopcInfoBytes)
    throw InputError(file.name + ": its record copc 1 has " + std::to_string(payload.size()) +
                     " bytes instead of " + std::to_string(kCopcInfoBytes));
  CopcInfo info;
  for (int axis = 0; axis < 3; ++axis)
    info.centre[axis] = loadLas<double>(&payload[static_cast<std::size_t>(8 * axis)]);
  info.half_size = loadLas<double>(&payload[24]);
  info.spacing = loadLas<double>(&payload[32]);
  info.root_offset = loadLas<std::uint64_t>(&payload[40]);
  info.root_size = loadLas<std::uint64_t>(&payload[48]);
  const auto possible = [](double length) { return std::isfinite(length) && length > 0.0; };
  if (!info.centre.allFinite() || !possible(info.half_size) || !possible(info.spacing))
    throw InputError(file.name +
                     ": the cube or the spacing in its record copc 1 are no positive numbers");
  return info;
}

std::vector<CopcNode> copcNodes(const CopcInfo& info, const CopcFile& file,
                                const LasWindow& window) {
  return Hierarchy(info, file, window).nodes();
}

}  // namespace pcl_als::detail
