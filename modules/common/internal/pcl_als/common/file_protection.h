// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pcl_als {

/** \brief Files that no AtomicFile of the process replaces while the object exists.
 *
 * A job that reads files and writes others holds one of its inputs: an output that is one of them,
 * by whatever path, symbolic or hard link, is a UsageError before its first byte is written.
 *
 * In a folder where the program chooses the names (reports, pictures, corrected copies), guard()
 * keeps all files but those that an earlier run wrote there and nobody changed since. They are
 * listed in the folder's file kList with their size and a digest of their content.
 */
class FileProtection {
 public:
  FileProtection();
  explicit FileProtection(const std::vector<std::filesystem::path>& inputs);
  explicit FileProtection(const std::vector<std::string>& inputs);
  ~FileProtection();
  FileProtection(FileProtection&&) noexcept;
  FileProtection(const FileProtection&) = delete;
  FileProtection& operator=(const FileProtection&) = delete;

  /// UsageError where a file to be written is one of those that are read, for jobs that refuse it
  /// before their work.
  void check(const std::filesystem::path& output) const;

  /// A file that is read. One that does not exist needs no protection.
  void keep(const std::filesystem::path& input);
  /// A folder for files of the program, which the first of them makes where it is missing.
  void guard(const std::filesystem::path& folder);
  /// A file whose name the user chose: it is replaced in a guarded folder, too.
  void allow(const std::filesystem::path& output);

  static constexpr const char* kList = ".pcl_als_files";

 private:
  struct Files;
  friend struct ProtectionRegistry;
  std::shared_ptr<Files> files_;
};

/// Whether a file can be written in its folder without harm: it does not exist, or an earlier run
/// wrote it there (guard()) and it was not changed since.
bool isReplaceable(const std::filesystem::path& file);

/// UsageError for the first file that is not.
void refuseForeign(const std::vector<std::filesystem::path>& files);

/// The path in a form that is the same for all spellings of a file that may not exist yet.
std::filesystem::path normalizedPath(const std::filesystem::path& path);

namespace detail {
/// UsageError where the file is protected; makes a guarded folder that is missing.
void beginOutput(const std::filesystem::path& file);
/// Enters a file into the list of a guarded folder; \a complete: its content, under another name.
void listOutput(const std::filesystem::path& file, const std::filesystem::path& complete);
}  // namespace detail

}  // namespace pcl_als
