// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/file_version.h>

namespace pcl_als {

/** \brief A regular file read at positions; several threads may read at once.
 *
 * pread into a buffer, not mmap: as fast here (see modules/las/README.md), and a file that another
 * program cuts short is an InputError instead of a bus error. So is a file that was changed since
 * it was opened: everything that read() returns is from one version of the file, as far as the
 * times of the file system tell them apart. Folders, FIFOs and devices are refused.
 */
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return version_.size; }
  const FileVersion& version() const { return version_; }
  int descriptor() const { return descriptor_; }  ///< for copies by the kernel
  /// InputError where the file was changed since it was opened; read() checks this itself.
  void requireUnchanged() const;
  void read(std::uint64_t position, std::size_t bytes, void* out) const;

 private:
  std::string name_;
  FileVersion version_;
  int descriptor_ = -1;
};

/// Limits of a file that is read into memory as a whole.
struct ContentLimits {
  std::uint64_t bytes = 0;
  std::size_t line_bytes = 0;  ///< of the longest line; 0: no limit
  bool text = true;            ///< a zero byte is refused
};

/// Tables of text: a trajectory with 1000 records per second has 3 GiB in eight hours.
inline constexpr ContentLimits kTableLimits{std::uint64_t{4} << 30U, std::size_t{1} << 20U, true};
/// Grids of heights in text, whose rows are lines of any length.
inline constexpr ContentLimits kGridLimits{std::uint64_t{4} << 30U, 0, true};
/// JSON, which takes some ten times its size in memory; the calibration of a thousand strips has
/// 20 MiB.
inline constexpr ContentLimits kJsonLimits{std::uint64_t{256} << 20U, 0, true};
/// Binary trajectories: an SBET with 200 records per second has 0.8 GiB in eight hours.
inline constexpr ContentLimits kBinaryLimits{std::uint64_t{4} << 30U, 0, false};

/** \brief The bytes of a file, read once.
 *
 * The kind and the size of the file are looked at before anything is read, so that a device or a
 * sparse file of any size is refused at once. A pipe with a program at its other end (as of a
 * process substitution) is read up to the limit. InputError names the file and the reason.
 */
std::string readWholeFile(const std::filesystem::path& path, const ContentLimits& limits);

/// UsageError where a file is given twice: its points would be counted twice.
void refuseRepeated(const std::vector<std::string>& files);

}  // namespace pcl_als
