// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>

namespace pcl_als {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20U;

/// What a file is that is no regular file.
const char* kindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe, which can be read only once";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "a socket";
}

/// A descriptor for reading, which the caller closes.
int openedForReading(const std::string& name) {
  // Without O_NONBLOCK a FIFO would be waited for, and only then refused.
  const int descriptor = open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor >= 0) return descriptor;
  const char* reason = errno == ENOENT ? "there is no such file" : std::strerror(errno);
  throw InputError(name + ": cannot be opened: " + reason);
}

std::string inMegabytes(std::uint64_t bytes) {
  return std::to_string((bytes + 999999) / 1000000) + " MB";
}

/// Content that grows block by block and is checked against its limits.
class Content {
 public:
  Content(const std::string& name, const ContentLimits& limits) : name_(name), limits_(limits) {}

  void requireRoom(std::uint64_t bytes) const {
    if (bytes > limits_.bytes)
      throw InputError(name_ + ": has " + inMegabytes(bytes) + ", more than the " +
                       inMegabytes(limits_.bytes) + " that a file of this kind may have");
  }

  void append(const char* block, std::size_t bytes) {
    requireRoom(text_.size() + bytes);
    if (limits_.text && std::memchr(block, 0, bytes) != nullptr)
      throw InputError(name_ +
                       ": is no text, because it has a zero byte (UTF-16 must be saved as UTF-8)");
    if (limits_.line_bytes > 0) checkLines(block, bytes);
    text_.append(block, bytes);
  }

  void reserve(std::uint64_t bytes) { text_.reserve(bytes); }
  std::string take() { return std::move(text_); }

 private:
  /// The beginning of a line is behind the last end of a line; blocks are no longer than lines.
  void checkLines(const char* block, std::size_t bytes) {
    const auto* first = static_cast<const char*>(std::memchr(block, '\n', bytes));
    const std::size_t before = first == nullptr ? bytes : static_cast<std::size_t>(first - block);
    if (text_.size() - line_ + before > limits_.line_bytes)
      throw InputError(name_ + ": is no table, because it has a line of more than " +
                       std::to_string(limits_.line_bytes) + " characters");
    const auto* last = static_cast<const char*>(memrchr(block, '\n', bytes));
    if (last != nullptr) line_ = text_.size() + static_cast<std::size_t>(last - block) + 1;
  }

  const std::string& name_;
  const ContentLimits limits_;
  std::string text_;
  std::size_t line_ = 0;  ///< where the last line begins
};

/// Reads a pipe to its end.
void readPipe(int descriptor, const std::string& name, Content& content) {
  std::vector<char> block(kBlock);
  bool empty = true;
  for (;;) {
    const ssize_t done = ::read(descriptor, block.data(), block.size());
    if (done == 0) break;
    if (done > 0) {
      content.append(block.data(), static_cast<std::size_t>(done));
      empty = false;
      continue;
    }
    if (errno != EAGAIN && errno != EINTR)
      throw InputError(name + ": cannot be read: " + std::strerror(errno));
    pollfd input{descriptor, POLLIN, 0};
    poll(&input, 1, -1);
  }
  if (empty) throw InputError(name + ": is a pipe into which no program writes");
}

bool isPipe(const std::string& name) {
  struct stat status {};
  return stat(name.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path.string()), descriptor_(openedForReading(name_)) {
  try {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0)
      throw InputError(name_ + ": cannot be read: " + std::strerror(errno));
    if (!S_ISREG(status.st_mode))
      throw InputError(name_ + ": is " + kindOf(status.st_mode) + ", not a file");
    version_ = FileVersion::of(descriptor_);
    UnchangedInputs::check(path, version_);
  } catch (...) {
    close(descriptor_);
    throw;
  }
  posix_fadvise(descriptor_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

InputFile::~InputFile() {
  close(descriptor_);
}

void InputFile::requireUnchanged() const {
  if (FileVersion::of(descriptor_) != version_) refuseChangedFile(name_);
}

void InputFile::read(std::uint64_t position, std::size_t bytes, void* out) const {
  auto* at = static_cast<char*>(out);
  while (bytes > 0) {
    const ssize_t done =
        pread(descriptor_, at, std::min(bytes, std::size_t{1} << 30), static_cast<off_t>(position));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw InputError(name_ + ": cannot be read: " + std::strerror(errno));
    if (done == 0) {
      requireUnchanged();
      throw InputError(name_ + ": ends at byte " + std::to_string(position) +
                       ", before its contents do");
    }
    at += done;
    position += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
  requireUnchanged();
}

std::string readWholeFile(const std::filesystem::path& path, const ContentLimits& limits) {
  const std::string name = path.string();
  Content content(name, limits);
  if (isPipe(name)) {
    const int descriptor = openedForReading(name);
    try {
      readPipe(descriptor, name, content);
    } catch (...) {
      close(descriptor);
      throw;
    }
    close(descriptor);
    return content.take();
  }
  const InputFile file(path);
  content.requireRoom(file.size());
  content.reserve(file.size());
  std::vector<char> block(std::min<std::uint64_t>(kBlock, file.size()));
  for (std::uint64_t at = 0; at < file.size(); at += block.size()) {
    block.resize(std::min<std::uint64_t>(block.size(), file.size() - at));
    file.read(at, block.size(), block.data());
    content.append(block.data(), block.size());
  }
  return content.take();
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
