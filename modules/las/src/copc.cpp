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

/// An entry of a page: a node, or another page.
struct Entry {
  std::array<std::int32_t, 4> key{};  ///< level, x, y, z
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

std::string nameOf(const Entry& entry) {
  std::string text = "node";
  for (std::size_t i = 0; i < 4; ++i) text += (i == 0 ? " " : "-") + std::to_string(entry.key[i]);
  return text;
}

class Hierarchy {
 public:
  Hierarchy(const CopcInfo& info, const CopcFile& file, const LasWindow& window)
      : info_(info), file_(file), deepest_(deepestLevel(info, window)) {
    if (!window.bounds) return;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(file.step);
    bounds_ = Eigen::AlignedBox2d(window.bounds->min() - margin, window.bounds->max() + margin);
  }

  std::vector<CopcNode> nodes() {
    addPage(info_.root_offset, info_.root_size, "the root page");
    while (!pages_.empty()) {
      const Page page = pages_.back();
      pages_.pop_back();
      readPage(page);
    }
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
    if (entry.points == 0 || !wanted(entry)) return;
    if (entry.points < kPage || entry.bytes <= 0)
      refuse(nameOf(entry) + " has " + std::to_string(entry.points) + " points in " +
             std::to_string(entry.bytes) + " bytes");
    const auto bytes = static_cast<std::uint64_t>(entry.bytes);
    if (entry.points == kPage) return addPage(entry.offset, bytes, "the page of " + nameOf(entry));
    if (bytes > file_.size || entry.offset > file_.size - bytes)
      refuse(nameOf(entry) + ", " + std::to_string(bytes) + " bytes at byte " +
             std::to_string(entry.offset) + ", is not within the file of " +
             std::to_string(file_.size) + " bytes");
    nodes_.push_back({entry.offset, bytes, static_cast<std::uint64_t>(entry.points)});
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
    const double size = std::ldexp(2.0 * info_.half_size, -entry.key[0]);
    const Eigen::Vector2d low = (info_.centre.head<2>().array() - info_.half_size).matrix() +
                                size * Eigen::Vector2d(entry.key[1], entry.key[2]);
    const Eigen::AlignedBox2d box(low, (low.array() + size).matrix());
    return bounds_.intersects(box);
  }

  const CopcInfo& info_;
  const CopcFile& file_;
  const int deepest_;
  Eigen::AlignedBox2d bounds_;  ///< empty: everywhere
  std::vector<Page> pages_;     ///< to be read
  std::set<std::uint64_t> known_pages_;
  std::uint64_t page_bytes_ = 0;
  std::vector<CopcNode> nodes_;
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
