// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/// The points of one point source id in one file.
struct PointSource {
  std::uint16_t id = 0;
  std::uint64_t points = 0;
  /// Smallest and largest GPS time other than 0, which means "no time"; seconds. 0: all have none.
  double first_time = 0.0, last_time = 0.0;
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();  ///< metres, ground frame
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  std::uint64_t without_time = 0;  ///< points of GPS time 0 or none

  bool hasTimes() const { return without_time < points; }
  /// Takes in other points of the same id; both must hold some.
  void merge(const PointSource& other);
};

/// A point file and the ids in it, ascending.
struct PointFileSources {
  PointFileInfo info;  ///< with the number and the box of the points that were read
  std::vector<PointSource> sources;
  std::string damage{};      ///< PointReader::damage()
  std::string box_remark{};  ///< PointReader::boxRemark(), with the name of the file

  /// Of all sources whose coordinates are numbers.
  Eigen::AlignedBox3d box() const;
};

/// Reads a file once and returns its ids. Constant memory. \a also gets every chunk, too.
PointFileSources surveySources(const std::filesystem::path& path,
                               const std::function<void(const PointChunk&)>& also = {});
/// The same of points that are read already, from the first one.
PointFileSources surveySources(PointReader& reader,
                               const std::function<void(const PointChunk&)>& also = {});

/** \brief Assigns the points of a set of files to strips, and names these.
 *
 * - A point source id other than 0 is the strip's number: points of that id in all files are one
 *   strip, called by the number (tiles of one strip are joined).
 * - Id 0 identifies no strip (LAS: "originated in this file"): such points are a strip of their
 * file, called by the file's stem.
 * - Where every one of several files holds one and the same id only, a constant that a program
 *   wrote into one file per line is likelier than tiles: each file is a strip, called by its stem,
 *   unless the files' times follow each other without a gap of more than kLargestGap, as those of
 *   tiles do and those of flight lines (turns take longer) do not.
 *
 * A stem that is also another strip's name is replaced by the file name or, if need be, the path.
 */
class StripNaming {
 public:
  /// Seconds between tiles of one strip, at most.
  static constexpr double kLargestGap = 20.0;

  explicit StripNaming(const std::vector<PointFileSources>& files);

  /// The strip of the points of \a id in the file of that index; UsageError for an id not in it.
  const std::string& nameOf(std::size_t file, std::uint16_t id) const;
  /// All strips, in order of first appearance (files in order, ids ascending).
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::pair<std::size_t, std::uint16_t>, std::string> strips_;
  std::vector<std::string> names_;
};

}  // namespace pcl_als
