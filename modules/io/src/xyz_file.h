// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/input_file.h>
#include <pcl_als/common/lidar_return.h>

#include "pcd_header.h"

namespace pcl_als::detail {

/** \brief The points of a text file with one point per line, in constant memory.
 *
 * Columns are separated by blanks, tabs, commas or semicolons. Their names are those of a header
 * line, which may be a comment (# or //) and must name x, y and z, or are given by the caller. A
 * file of three columns needs neither: they are x, y and z. Lines that begin with # or // are
 * comments. Points without finite coordinates are excluded.
 *
 * InputError with file and line for what is wrong with the file.
 */
class XyzFile {
 public:
  /// \param columns names in their order, "skip" for others; empty: by the header. UsageError where
  /// they lack x, y or z, or name a quantity twice. \param channel_field PointWindow::channel_field
  XyzFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
          const std::string& channel_field);

  /// The next points out of at most \a lines lines; false at the end of the file.
  bool read(std::size_t lines, PointChunk& chunk);
  void rewind();
  bool hasTimes() const { return has(Quantity::gps_time); }
  /// Decimals of the coordinates so far.
  int decimals() const { return decimals_; }
  /// Of the times so far, per second (timeUnitsPerSecond()).
  double timeUnits() const { return time_units_; }
  /// What is not used of the file, and what is assumed of it.
  std::vector<std::string> remarks() const;
  /// CRS, strip and corrections of our comment lines.
  const PcdHeader& comments() const { return comments_; }
  const FileVersion& version() const { return file_.version(); }

 private:
  enum class Quantity {
    x,
    y,
    z,
    gps_time,
    intensity,
    scan_angle,
    point_source_id,
    return_number,
    number_of_returns,
    classification,
    flags,
    user_data,
    channel,
    none
  };
  static constexpr auto kQuantities = static_cast<std::size_t>(Quantity::none);
  using Values = std::array<double, kQuantities>;

  static Quantity quantityOf(const std::string& name);
  bool has(Quantity quantity) const;
  void readHeader();
  bool takeHeader(std::string_view line, bool is_comment);
  void setColumns(const std::vector<std::string>& names);
  std::string lackOf(const std::vector<std::string>& names) const;
  void nameChannel(const std::string& field);
  bool nextLine(std::string_view& line);
  bool refill();
  void takeLine(std::string_view line, PointChunk& chunk);
  void takeField(std::size_t column, std::string_view text, Values& values);
  void append(const Values& values, PointChunk& chunk);
  [[noreturn]] void fail(const std::string& what) const;

  InputFile file_;
  PcdHeader comments_;
  std::vector<std::string> names_;    ///< of the columns
  std::vector<Quantity> quantities_;  ///< of the columns
  bool is_assumed_ = false;           ///< the columns, as there is no header
  std::string channel_name_;          ///< empty: bits of the flags
  std::uint64_t data_position_ = 0;   ///< of the first line of numbers
  std::size_t data_line_ = 0;         ///< the number of the line before it
  std::uint64_t position_ = 0;        ///< in the file, behind text_
  std::string text_;
  std::size_t at_ = 0, line_ = 0;
  int decimals_ = 0;
  double time_units_ = 1.0;
};

}  // namespace pcl_als::detail
