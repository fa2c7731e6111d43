// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_als {

/** \brief A regular file read at positions; several threads may read at once.
 *
 * pread into a buffer, not mmap: as fast here (see modules/las/README.md), and a file that another
 * program cuts short is an InputError instead of a bus error.
 */
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }
  int descriptor() const { return descriptor_; }
  void read(std::uint64_t position, std::size_t bytes, void* out) const;

 private:
  std::string name_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
};

/// UsageError where a file is given twice: its points would be counted twice.
void refuseRepeated(const std::vector<std::string>& files);

}  // namespace pcl_als
