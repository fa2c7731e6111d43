// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_header.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als {

/// What a new LAS file is to be.
struct LasWriterOptions {
  int version_minor = 4;
  int point_format = 6;  ///< 1.2: 0-3, 1.3: 0-5, 1.4: 0-10, 1.5: 6-10
  Eigen::Vector3d scale = Eigen::Vector3d::Constant(0.001);  ///< per step, unit of crs
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();          ///< unit of crs
  std::string crs;  ///< WKT or "EPSG:…"; empty: no record
  TimeKind time_kind = TimeKind::adjusted_standard;
  /// 1.5: adjusted standard times are stored as GPS seconds less this many million seconds.
  std::optional<std::uint16_t> time_offset{};
  std::uint16_t file_source_id = 0;         ///< flight line number, 0 for none or several
  std::vector<LasExtraField> extra_fields;  ///< name, type, scale, offset, description
  std::vector<LasVlr> vlrs;                 ///< further records
  std::string system_id = "OTHER";          ///< of the sensor or "MODIFICATION", …
  std::string generating_software = "pcl_als";
};

/** \brief Creates a LAS file (LAZ by extension): append points, finish().
 *
 * Points are given in metres and stored in the unit of the CRS (unitsOfCrs()): with a CRS in feet
 * the coordinates in the file are feet.
 *
 * Counts, returns by number and the bounding box are fixed by finish(); without it no file appears
 * (see AtomicFile). Constant memory.
 * \code
 * LasWriter writer("out.las", options);
 * writer.append(chunk, {reflectance});   // one column of doubles per extra field
 * writer.finish();
 * \endcode
 */
class LasWriter {
 public:
  LasWriter(const std::filesystem::path& path, const LasWriterOptions& options);
  ~LasWriter();
  LasWriter(LasWriter&&) noexcept;
  LasWriter& operator=(LasWriter&&) = delete;

  const LasHeader& header() const;
  const LasRecordLayout& layout() const;
  const LinearUnits& units() const;                       ///< that the coordinates are stored in
  const std::vector<LasExtraField>& extraFields() const;  ///< with their positions

  /// Appends points and one column of values per extra field (none: zeros). InputError names the
  /// first point that the format cannot carry.
  void append(const PointChunk& chunk, const std::vector<std::vector<double>>& extra_columns = {});
  /// Appends raw records of header().record_length bytes.
  void appendRecords(const std::byte* records, std::size_t count);
  std::uint64_t pointCount() const;
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
