// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/file_version.h>

#include "temporary_registry.h"

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

// Linux accepts at most about 2 GiB in one call; smaller pieces also keep signals responsive.
constexpr std::size_t kLargestWrite = std::size_t{1} << 30;

fs::path throughLinks(const fs::path& target) {
  std::error_code error;
  if (!fs::is_symlink(target, error)) return target;
  fs::path resolved = fs::weakly_canonical(target, error);
  return error ? target : resolved;
}

fs::path temporaryNameFor(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string tail =
      "." + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".partial";
  const std::size_t room = NAME_MAX - tail.size();
  return target.parent_path() / (target.filename().string().substr(0, room) + tail);
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : requested_(std::move(target)) {
  if (!requested_.has_filename()) throw InputError(requested_.string() + ": is not a file name");
  detail::beginOutput(requested_);
  target_ = throughLinks(requested_);
  struct stat existing {};
  const bool exists = stat(target_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode))
    throw InputError(requested_.string() + ": is a folder; name a file");
  if (exists && !S_ISREG(existing.st_mode))
    throw InputError(requested_.string() + ": is not a regular file; name another output");
  temporary_ = temporaryNameFor(target_);
  if (exists && access(target_.c_str(), W_OK) != 0)
    throw InputError(requested_.string() + ": is read-only");
  slot_ = detail::registerTemporary(fs::absolute(temporary_).string());
  const mode_t mode = exists ? existing.st_mode & 07777U : 0666;
  descriptor_ = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode | 0600U);
  if (descriptor_ < 0) {
    const int error = errno;
    detail::unregisterTemporary(slot_);
    fail("cannot be created", error);
  }
  // The umask took part in the creation; on file systems without permissions this fails,
  // harmlessly.
  if (exists) (void)!fchmod(descriptor_, mode);
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::discard() {
  if (slot_ == nullptr) return;
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  unlink(temporary_.c_str());
  detail::unregisterTemporary(slot_);
  slot_ = nullptr;
}

void AtomicFile::fail(const char* what, int error) const {
  std::string reason = std::strerror(error);
  if (error == ENOENT) reason = "the folder does not exist";
  if (error == ENOSPC || error == EDQUOT) reason = "the disk is full";
  throw InputError(requested_.string() + ": " + what + ": " + reason);
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  const auto* at = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::write(descriptor_, at, std::min(bytes, kLargestWrite));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot be written", errno);
    at += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

void AtomicFile::writeAt(std::uint64_t offset, const void* data, std::size_t bytes) {
  const auto* at = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done =
        pwrite(descriptor_, at, std::min(bytes, kLargestWrite), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot be written", errno);
    at += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
}

void AtomicFile::commit() {
  if (slot_ == nullptr) throw InputError(requested_.string() + ": was already completed");
  detail::listOutput(requested_, temporary_);
  // Network file systems report a full disk only here.
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0 && errno != EINTR) {
    const int error = errno;
    discard();
    fail("cannot be completed", error);
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int error = errno;
    discard();
    fail("cannot be renamed to its final name", error);
  }
  detail::unregisterTemporary(slot_);
  slot_ = nullptr;
  UnchangedInputs::forget(target_);
}

void writeFile(const std::filesystem::path& target, std::string_view text) {
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace pcl_als
