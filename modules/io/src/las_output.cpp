// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_output.h"

#include <algorithm>
#include <cctype>

#include <sys/stat.h>

namespace pcl_als::detail {

bool wantsLaz(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".laz";
}

LasOutput::LasOutput(const std::filesystem::path& path, const std::vector<std::byte>& head,
                     const LasHeader& header)
    : file_(path),
      offset_to_points_(header.offset_to_points),
      record_length_(header.record_length) {
  if (wantsLaz(path))
    laz_ = createLazWriter(file_.temporaryPath().string(), head, header, path.string());
  else
    file_.write(head.data(), head.size());
}

void LasOutput::append(const std::byte* records, std::size_t count) {
  if (laz_)
    laz_->write(records, count);
  else
    file_.write(records, count * record_length_);
}

void LasOutput::putAt(std::uint64_t first, const std::byte* records, std::size_t count) {
  file_.writeAt(offset_to_points_ + first * record_length_, records, count * record_length_);
}

std::uint64_t LasOutput::endOfPoints() {
  if (laz_) laz_->finish();
  laz_.reset();
  struct stat status {};
  fstat(file_.descriptor(), &status);
  return static_cast<std::uint64_t>(status.st_size);
}

void LasOutput::finish(const LasHeader& header) {
  endOfPoints();
  // Only what became known at the end: LASzip has changed other fields of the header.
  const std::vector<std::byte> bytes = serialiseLasHeader(header);
  constexpr std::size_t counts = 107, counts_end = 131, tail = 235;
  file_.writeAt(counts, &bytes[counts], counts_end - counts);
  file_.writeAt(kLasBoxPosition, &bytes[kLasBoxPosition], 48);
  if (header.version_minor >= 4) file_.writeAt(tail, &bytes[tail], 375 - tail);
  file_.commit();
}

}  // namespace pcl_als::detail
