// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <vector>

#include <unistd.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/external_waveforms.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr std::uint16_t kFirstDescriptor = 100, kLastDescriptor = 354, kPacketsRecord = 65535;
constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
constexpr std::size_t kKernelBytes = std::size_t{1} << 30;
const char* const kPacketExtensions[] = {".wdp", ".WDP", ".wdz", ".WDZ"};
const char* const kPointExtensions[] = {".las", ".LAS", ".laz", ".LAZ"};

bool hasRecord(const LasFile& las, std::uint16_t first, std::uint16_t last) {
  const auto& vlrs = las.vlrs();
  return std::any_of(vlrs.begin(), vlrs.end(), [&](const LasVlrEntry& vlr) {
    return vlr.user_id == kLasSpecUser && vlr.record_id >= first && vlr.record_id <= last;
  });
}

bool refersToOtherFile(const LasFile& las) {
  const LasHeader& h = las.header();
  if (las.layout().waveform < 0) return false;
  if ((h.global_encoding & kLasWaveformExternal) != 0) return true;
  if ((h.global_encoding & kLasWaveformInternal) != 0 || h.waveform_start > 0) return false;
  return hasRecord(las, kFirstDescriptor, kLastDescriptor) &&
         !hasRecord(las, kPacketsRecord, kPacketsRecord);
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code absent;
  return fs::equivalent(a, b, absent);
}

bool sameBytes(const fs::path& a, const fs::path& b) {
  const InputFile first(a), second(b);
  if (first.size() != second.size()) return false;
  std::vector<std::byte> left(kBlockBytes), right(kBlockBytes);
  for (std::uint64_t at = 0; at < first.size(); at += kBlockBytes) {
    const std::size_t bytes = std::min<std::uint64_t>(kBlockBytes, first.size() - at);
    first.read(at, bytes, left.data());
    second.read(at, bytes, right.data());
    if (std::memcmp(left.data(), right.data(), bytes) != 0) return false;
  }
  return true;
}

/// Whether another LAS file than \a output has packets of the same name.
bool belongsToOther(const fs::path& packets, const fs::path& output) {
  return std::any_of(std::begin(kPointExtensions), std::end(kPointExtensions),
                     [&](const char* extension) {
                       fs::path other = packets;
                       other.replace_extension(extension);
                       std::error_code absent;
                       return fs::exists(other, absent) && !isSameFile(other, output);
                     });
}

/// Copies within the kernel, which shares the blocks where the file system can. \return bytes that
/// were copied; fewer than the file has where this is not supported between the two files.
std::uint64_t copyInKernel(const InputFile& from, const AtomicFile& to) {
  off_t in = 0, out = 0;
  while (static_cast<std::uint64_t>(in) < from.size()) {
    const ssize_t done =
        copy_file_range(from.descriptor(), &in, to.descriptor(), &out, kKernelBytes, 0);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) break;
  }
  return static_cast<std::uint64_t>(out);
}

void copyBytes(const InputFile& from, AtomicFile& to) {
  std::vector<std::byte> buffer(kBlockBytes);
  for (std::uint64_t at = copyInKernel(from, to); at < from.size();) {
    const std::size_t bytes = std::min<std::uint64_t>(buffer.size(), from.size() - at);
    from.read(at, bytes, buffer.data());
    to.writeAt(at, buffer.data(), bytes);
    at += bytes;
  }
  from.requireUnchanged();
}

}  // namespace

bool refersToWaveforms(const LasFile& las) {
  constexpr unsigned kAnywhere = kLasWaveformInternal | kLasWaveformExternal;
  return las.layout().waveform >= 0 &&
         ((las.header().global_encoding & kAnywhere) != 0 || las.header().waveform_start > 0 ||
          hasRecord(las, kFirstDescriptor, kLastDescriptor));
}

ExternalWaveforms ExternalWaveforms::of(const LasFile& las) {
  ExternalWaveforms waveforms;
  waveforms.expected = refersToOtherFile(las);
  if (!waveforms.expected) return waveforms;
  for (const char* extension : kPacketExtensions) {
    fs::path file = las.path();
    file.replace_extension(extension);
    std::error_code absent;
    if (!fs::is_regular_file(file, absent)) continue;
    waveforms.file = file;
    waveforms.size = fs::file_size(file);
    break;
  }
  return waveforms;
}

std::string ExternalWaveforms::describe() const {
  if (!expected) return {};
  if (file.empty()) return "its records refer to waveforms in a .wdp file, which is missing";
  return "waveforms in " + file.filename().string() + ", " + grouped(size) + " bytes";
}

struct WaveformCopy::State {
  std::string input;
  ExternalWaveforms waveforms;
  fs::path target;
  bool needed = false;
  std::optional<AtomicFile> copy;

  void checkTarget(const fs::path& output) {
    std::error_code absent;
    if (isSameFile(waveforms.file, target)) return;
    needed = true;
    if (!fs::exists(target, absent)) return;
    needed = !sameBytes(waveforms.file, target);
    if (needed && (!fs::exists(output, absent) || belongsToOther(target, output)))
      throw InputError(target.string() + ": does not hold the waveforms of " + input +
                       " but has the name of those of the output; name another output");
  }
};

WaveformCopy::WaveformCopy(const LasFile& input, const fs::path& output)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.input = input.path().string();
  s.waveforms = ExternalWaveforms::of(input);
  if (s.waveforms.file.empty()) return;
  s.target = output;
  s.target.replace_extension(s.waveforms.file.extension());
  s.checkTarget(output);
}

WaveformCopy::~WaveformCopy() = default;
WaveformCopy::WaveformCopy(WaveformCopy&&) noexcept = default;

void WaveformCopy::prepare() {
  State& s = *state_;
  if (!s.needed) return;
  s.copy.emplace(s.target);
  copyBytes(InputFile(s.waveforms.file), *s.copy);
}

void WaveformCopy::commit() {
  if (state_->copy) state_->copy->commit();
  state_->copy.reset();
}

std::string WaveformCopy::remark() const {
  const State& s = *state_;
  if (!s.waveforms.expected) return {};
  if (s.waveforms.file.empty()) return s.waveforms.describe();
  return s.waveforms.describe() +
         (s.needed ? ", are copied to " + s.target.string() : ", serve the output as well");
}

}  // namespace pcl_als
