// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_channel.h>
#include <pcl_als/las/las_compatibility.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief Reads the points of a .las or .laz as columns, with their raw records beside them.
 *
 * Of a file in LAS 1.4 compatibility mode the columns have the values of LAS 1.4
 * (LasCompatibility), the records are as they are stored.
 *
 * As PointReader::open() of such a file; for jobs that also need what a PointChunk has no columns
 * for.
 */
class LasPointReader : public PointReader {
 public:
  /// What a PointChunk has columns for; the layers of other fields of a .laz are not decoded.
  static constexpr unsigned kColumns = kLazZ | kLazClassification | kLazFlags | kLazIntensity |
                                       kLazScanAngle | kLazUserData | kLazPointSource | kLazGpsTime;

  /// \param fields LazField bits that records() are to have.
  LasPointReader(const std::filesystem::path& path, const PointWindow& window,
                 OtherCoordinates other, unsigned fields = kColumns);

  const PointFileInfo& info() const override { return info_; }
  std::string damage() const override;
  std::string boxRemark(const Eigen::AlignedBox3d& points) const override;
  bool read(PointChunk& chunk) override;

  const LasFile& file() const { return file_; }
  /// The raw records of the points that read() gave last; they may be changed.
  std::byte* records() { return buffer_.data() + given_ * file_.header().record_length; }

 private:
  void fillExtra(PointChunk& chunk);
  bool fetch();
  std::size_t readBlock();
  std::size_t readNodes();
  std::size_t keepInside(std::size_t count);

  LasFile file_;
  std::optional<LasCompatibility> compatibility_;
  PointWindow window_;
  PointFileInfo info_;
  LasScaling scaling_;
  std::vector<LasRecordRange> ranges_;  ///< to be read: the whole file, or nodes of an octree
  bool whole_ = true;                   ///< ranges_ is the whole file
  std::optional<LasChannel> channel_;   ///< none: that of the point format
  std::optional<LasExtraField> extra_field_;
  std::size_t range_ = 0;             ///< of those, the next one
  std::uint64_t position_ = 0;        ///< of a whole file, the next record
  std::vector<std::byte> buffer_;     ///< records that were read and lie inside
  std::size_t held_ = 0;              ///< their number
  std::size_t given_ = 0, next_ = 0;  ///< rows that read() gave last begin and end here
};

}  // namespace pcl_als
