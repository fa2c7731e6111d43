// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>

namespace fs = std::filesystem;

namespace pcl_als {

struct FileProtection::Files {
  std::set<std::pair<dev_t, ino_t>> inputs;
  std::set<fs::path> folders, allowed;  // normalizedPath()
};

/// All objects of the process.
struct ProtectionRegistry {
  std::mutex mutex;
  std::set<std::shared_ptr<FileProtection::Files>> all;

  static ProtectionRegistry& get() {
    static ProtectionRegistry registry;
    return registry;
  }
  /// UsageError where the file is an input of any object.
  void refuseInput(const fs::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) return;
    const std::lock_guard<std::mutex> lock(mutex);
    for (const auto& files : all)
      if (files->inputs.count({status.st_dev, status.st_ino}) != 0)
        throw UsageError(file.string() + ": is also an input; name another output");
  }
  bool isGuarded(const fs::path& file) {
    const fs::path path = normalizedPath(fs::absolute(file).parent_path()) / file.filename();
    const fs::path resolved = normalizedPath(file);
    const std::lock_guard<std::mutex> lock(mutex);
    const auto any = [this](const auto& meets) {
      return std::any_of(all.begin(), all.end(), meets);
    };
    return any([&](const auto& files) { return files->folders.count(path.parent_path()) != 0; }) &&
           !any([&](const auto& files) { return files->allowed.count(resolved) != 0; });
  }
};

namespace {

constexpr std::size_t kDigestBlock = 16384,
                      kDigestBlocks = 64;  // of the content that a digest is of
constexpr const char* kTitle =
    "# Files that pcl_als wrote into this folder, and may replace: size, digest, name";

/// FNV-1a of the whole content, of large files of blocks that are spread evenly over it, so that
/// point clouds of any size are recognized at once.
std::string digestOf(int descriptor, std::uint64_t size) {
  std::uint64_t digest = 14695981039346656037U;
  std::array<unsigned char, kDigestBlock> block{};
  const std::uint64_t blocks =
      std::min<std::uint64_t>(kDigestBlocks, (size + kDigestBlock - 1) / kDigestBlock);
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const bool sampled = size > kDigestBlock * kDigestBlocks;
    const std::uint64_t at =
        sampled ? (size - kDigestBlock) * i / (kDigestBlocks - 1) : i * kDigestBlock;
    const ssize_t got = pread(descriptor, block.data(), kDigestBlock, static_cast<off_t>(at));
    for (ssize_t b = 0; b < got; ++b)
      digest = (digest ^ block[static_cast<std::size_t>(b)]) * 1099511628211U;
  }
  std::ostringstream text;
  text << size << ' ' << std::hex << digest;
  return text.str();
}

/// "SIZE DIGEST" of a regular file; nothing where it cannot be read.
std::optional<std::string> contentOf(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return std::nullopt;
  struct stat status {};
  std::optional<std::string> content;
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode))
    content = digestOf(descriptor, static_cast<std::uint64_t>(status.st_size));
  close(descriptor);
  return content;
}

fs::path pathOfList(const fs::path& file) {
  return fs::absolute(file).parent_path() / FileProtection::kList;
}

}  // namespace

FileProtection::FileProtection() : files_(std::make_shared<Files>()) {
  ProtectionRegistry& registry = ProtectionRegistry::get();
  const std::lock_guard<std::mutex> lock(registry.mutex);
  registry.all.insert(files_);
}

FileProtection::FileProtection(const std::vector<fs::path>& inputs) : FileProtection() {
  for (const fs::path& input : inputs) keep(input);
}

FileProtection::FileProtection(const std::vector<std::string>& inputs) : FileProtection() {
  for (const std::string& input : inputs) keep(input);
}

FileProtection::FileProtection(FileProtection&&) noexcept = default;

FileProtection::~FileProtection() {
  if (!files_) return;
  ProtectionRegistry& registry = ProtectionRegistry::get();
  const std::lock_guard<std::mutex> lock(registry.mutex);
  registry.all.erase(files_);
}

void FileProtection::check(const fs::path& output) const {
  ProtectionRegistry::get().refuseInput(output);
}

void FileProtection::keep(const fs::path& input) {
  struct stat status {};
  if (stat(input.c_str(), &status) != 0) return;
  const std::lock_guard<std::mutex> lock(ProtectionRegistry::get().mutex);
  files_->inputs.emplace(status.st_dev, status.st_ino);
}

void FileProtection::guard(const fs::path& folder) {
  const std::lock_guard<std::mutex> lock(ProtectionRegistry::get().mutex);
  files_->folders.insert(normalizedPath(folder));
}

void FileProtection::allow(const fs::path& output) {
  const std::lock_guard<std::mutex> lock(ProtectionRegistry::get().mutex);
  files_->allowed.insert(normalizedPath(output));
}

bool isReplaceable(const fs::path& file) {
  std::error_code error;
  if (fs::symlink_status(file, error).type() == fs::file_type::not_found) return true;
  const std::optional<std::string> content = contentOf(file);
  if (!content) return false;
  std::ifstream list(pathOfList(file));
  const std::string entry = *content + ' ' + file.filename().string();
  for (std::string line; std::getline(list, line);)
    if (line == entry) return true;
  return false;
}

void refuseForeign(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    if (isReplaceable(file)) continue;
    throw UsageError(file.string() +
                     ": would be replaced, but is not a file that pcl_als wrote into this folder; "
                     "move it away or name another folder");
  }
}

fs::path normalizedPath(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  fs::path normal = fs::weakly_canonical(absolute, error);
  if (error) normal = absolute.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

namespace detail {

void beginOutput(const fs::path& file) {
  ProtectionRegistry& registry = ProtectionRegistry::get();
  registry.refuseInput(file);
  if (!registry.isGuarded(file)) return;
  refuseForeign({file});
  std::error_code error;  // of a folder that cannot be made, the file reports it
  fs::create_directories(fs::absolute(file).parent_path(), error);
}

void listOutput(const fs::path& file, const fs::path& complete) {
  if (!ProtectionRegistry::get().isGuarded(file)) return;
  const std::optional<std::string> content = contentOf(complete);
  if (!content) return;
  const fs::path path = pathOfList(file);
  std::error_code error;
  std::string entry = fs::exists(path, error) ? "" : std::string(kTitle) + '\n';
  entry += *content + ' ' + file.filename().string() + '\n';
  const int list = open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (list < 0) throw InputError(path.string() + ": cannot be written: " + std::strerror(errno));
  // One call appends it whole, also where several processes write into the folder.
  const ssize_t written = write(list, entry.data(), entry.size());
  const int reason = errno;
  close(list);
  if (written != static_cast<ssize_t>(entry.size()))
    throw InputError(path.string() + ": cannot be written: " + std::strerror(reason));
}

}  // namespace detail
}  // namespace pcl_als
