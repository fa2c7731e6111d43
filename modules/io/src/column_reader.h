// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/strip_loader.h>

#include "column_fields.h"

namespace pcl_als::detail {

/// Reads the points of a file with the fields besides those of PointLidar that are wanted.
class ColumnReader {
 public:
  /// \param file its number among the files that are loaded together
  ColumnReader(const std::filesystem::path& path, std::size_t file, const StripLoading& loading);

  std::size_t file() const { return file_; }
  /// As PointReader::read().
  bool read(PointChunk& chunk);
  /// The fields that are wanted and in the file.
  const std::vector<LasExtraField>& fields() const { return fields_; }
  /// Values of a field of the points that read() gave last.
  const std::vector<double>& values(std::size_t field) const { return values_[field]; }
  /// The names of all fields that the file has, separated by commas.
  const std::string& names() const { return names_; }

 private:
  void chooseFields(const StripLoading& loading);

  std::size_t file_;
  std::unique_ptr<PointReader> reader_;
  LasPointReader* las_ = nullptr;  ///< the reader of a .las or .laz file with wanted fields
  std::vector<LasExtraField> fields_;
  std::vector<std::vector<double>> values_;
  std::string names_;
};

}  // namespace pcl_als::detail
