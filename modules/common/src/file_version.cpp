// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <map>
#include <mutex>

#include <sys/stat.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>

namespace pcl_als {
namespace {

struct Versions {
  std::mutex mutex;
  std::size_t users = 0;  ///< objects of UnchangedInputs
  std::map<std::string, FileVersion> by_path;
};

Versions& versions() {
  static Versions all;
  return all;
}

std::string keyOf(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path full = std::filesystem::weakly_canonical(path, error);
  return error ? path.string() : full.string();
}

}  // namespace

FileVersion FileVersion::of(int descriptor) {
  FileVersion version;
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return version;
  version.device = status.st_dev;
  version.inode = status.st_ino;
  version.size = static_cast<std::uint64_t>(status.st_size);
  version.modified = std::int64_t{status.st_mtim.tv_sec} * 1000000000 + status.st_mtim.tv_nsec;
  return version;
}

void refuseChangedFile(const std::string& file) {
  throw InputError(file + ": was changed while it was read; repeat this when no program writes it");
}

UnchangedInputs::UnchangedInputs() {
  const std::lock_guard<std::mutex> lock(versions().mutex);
  ++versions().users;
}

UnchangedInputs::~UnchangedInputs() {
  const std::lock_guard<std::mutex> lock(versions().mutex);
  if (--versions().users == 0) versions().by_path.clear();
}

void UnchangedInputs::check(const std::filesystem::path& path, const FileVersion& version) {
  const std::lock_guard<std::mutex> lock(versions().mutex);
  if (versions().users == 0) return;
  const auto [known, is_new] = versions().by_path.emplace(keyOf(path), version);
  if (!is_new && known->second != version) refuseChangedFile(path.string());
}

void UnchangedInputs::forget(const std::filesystem::path& path) {
  const std::lock_guard<std::mutex> lock(versions().mutex);
  versions().by_path.erase(keyOf(path));
}

}  // namespace pcl_als
