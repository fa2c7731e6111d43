// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace pcl_als {

namespace detail {
struct TemporarySlot;
}

/** \brief An output file that appears under its name only when it is complete.
 *
 * Writing goes to a temporary file in the same folder; commit() flushes and renames it. Destroyed
 * without commit (an exception, an early return), the temporary is removed and an existing file of
 * that name is untouched. Every failure (folder missing, read-only, disk full) is an InputError
 * naming the file. A signal that ends the process can leave `NAME.….partial` behind, never a
 * half-written NAME; see removeUnfinishedFiles().
 *
 * commit() does not fsync: it guards against failures of the program and of the file system's
 * space, not against a power cut. A symbolic link as target is written through, the permissions of
 * an existing target are kept, and a target that is no regular file (a folder, a device) or that is
 * protected (FileProtection) is refused.
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
  /// Writes at a position; may be called by several threads at once, unlike write().
  void writeAt(std::uint64_t offset, const void* data, std::size_t bytes);
  void commit();

 private:
  [[noreturn]] void fail(const char* what, int error) const;
  void discard();

  std::filesystem::path requested_;  ///< as the caller named it, for messages
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  detail::TemporarySlot* slot_ = nullptr;
};

/** \brief Removes the temporary files of all AtomicFiles of this process that are not complete.
 *
 * Async-signal-safe: for the signal handler of a program. The library installs no handlers.
 */
void removeUnfinishedFiles() noexcept;

/// A whole file that holds \a text.
void writeFile(const std::filesystem::path& target, std::string_view text);

}  // namespace pcl_als
