// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace pcl_als {

/// Properties of a file that differ after a program wrote to the file or replaced it.
struct FileVersion {
  std::uint64_t device = 0, inode = 0;
  std::uint64_t size = 0;     ///< bytes
  std::int64_t modified = 0;  ///< time of the last modification, nanoseconds

  bool operator==(const FileVersion& other) const {
    return device == other.device && inode == other.inode && size == other.size &&
           modified == other.modified;
  }
  bool operator!=(const FileVersion& other) const { return !(*this == other); }

  /// The version of an open file; all zero where the system does not tell.
  static FileVersion of(int descriptor);
};

/// Throws the InputError that \a file was changed while it was read.
[[noreturn]] void refuseChangedFile(const std::string& file);

/** \brief While an object of this class exists, a file that is opened again by InputFile must have
 * the version that it had when it was opened first; otherwise it is an InputError.
 *
 * Jobs that read a file several times create one at their beginning. Objects may be nested and may
 * exist in several threads: the versions are forgotten with the last one. Files that AtomicFile
 * replaces meanwhile are forgotten, because the program itself changed them.
 */
class UnchangedInputs {
 public:
  UnchangedInputs();
  ~UnchangedInputs();
  UnchangedInputs(const UnchangedInputs&) = delete;
  UnchangedInputs& operator=(const UnchangedInputs&) = delete;

  /// Compares a file that was opened with its earlier version, or records its version.
  static void check(const std::filesystem::path& path, const FileVersion& version);
  /// Forgets a file that this program has written.
  static void forget(const std::filesystem::path& path);
};

}  // namespace pcl_als
