// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>

namespace pcl_als {

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
  // Without O_NONBLOCK a FIFO would be waited for, and only then refused.
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) {
    const char* reason = errno == ENOENT ? "there is no such file" : std::strerror(errno);
    throw InputError(name_ + ": cannot be opened: " + reason);
  }
  struct stat status {};
  if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(descriptor_);
    throw InputError(name_ + ": is not a regular file (point files are read several times)");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  posix_fadvise(descriptor_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void InputFile::read(std::uint64_t position, std::size_t bytes, void* out) const {
  auto* at = static_cast<char*>(out);
  while (bytes > 0) {
    const ssize_t done =
        pread(descriptor_, at, std::min(bytes, std::size_t{1} << 30), static_cast<off_t>(position));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw InputError(name_ + ": cannot be read: " + std::strerror(errno));
    if (done == 0)
      throw InputError(name_ + ": ends at byte " + std::to_string(position) +
                       "; was it cut short while being read?");
    at += done;
    position += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
}

void refuseRepeated(const std::vector<std::string>& inputs) {
  std::set<std::filesystem::path> seen;
  for (const std::string& input : inputs) {
    std::error_code error;
    std::filesystem::path path = std::filesystem::canonical(input, error);
    if (error) path = input;
    if (!seen.insert(path).second) throw UsageError(input + " is given twice");
  }
}

}  // namespace pcl_als
