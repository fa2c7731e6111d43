// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_version.h>

namespace pcl_als::detail {

/// Points that were read, as columns and, of a LAS file, as raw records.
struct PointBlock {
  const PointChunk& chunk;
  const LasFile* file = nullptr;
  std::byte* records = nullptr;
};

/// An output file of a conversion.
class PointSink {
 public:
  virtual ~PointSink() = default;
  /// Appends the rows [from, to) of a block.
  virtual void append(const PointBlock& block, std::size_t from, std::size_t to) = 0;
  virtual std::uint64_t pointCount() const = 0;
  virtual void finish() = 0;
  /// After finish(): what was copied besides points, or is not in the output.
  virtual std::vector<std::string> remarks() const { return {}; }
};

struct SinkOptions {
  bool records = false;        ///< all points come with raw records, which are kept in a LAS file
  bool keep_readable = false;  ///< PointWindow::keep_readable
  std::string strip;           ///< name of the strip of all points; empty: several, or not known
  int threads = 0;
  LasVersion las_version{};  ///< of a LAS file without raw records
  bool ascii_ply = false;
};

/// The output at a path, by its extension, for points like those of \a first, the first file that
/// gives points to it.
std::unique_ptr<PointSink> openSink(const std::filesystem::path& path,
                                    const std::filesystem::path& first, const PointFileInfo& info,
                                    const SinkOptions& options);

/// Whether a file is LAS or LAZ by its name.
bool isLas(const std::filesystem::path& path);

/// Whether a file is a PCD by its name.
bool isPcd(const std::filesystem::path& path);

/// Fields of a LAS file that are lost in a file of another format, as a remark; empty where there
/// are none.
std::string fieldsWithoutColumn(const LasFile& file, const std::filesystem::path& output);

}  // namespace pcl_als::detail
