// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string_view>

namespace pcl_als {

/** \brief An output file that appears under its name only when it is complete.
 *
 * Writing goes to a temporary file in the same folder; commit() flushes and renames it. Destroyed
 * without commit (an exception, an early return), or when the process is ended by SIGINT, SIGTERM
 * or SIGHUP, the temporary is removed and an existing file of that name is untouched. Every failure
 * (folder missing, read-only, disk full) is an InputError naming the file.
 */
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  int descriptor() const { return descriptor_; }  ///< for code that writes by itself (pwrite, mmap)
  const std::filesystem::path& temporaryPath() const { return temporary_; }
  void write(const void* data, std::size_t bytes);  ///< appends
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
};

}  // namespace pcl_als
