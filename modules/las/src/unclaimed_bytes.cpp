// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <vector>

#include <pcl_als/common/number_text.h>
#include <pcl_als/las/unclaimed_bytes.h>

namespace pcl_als {
namespace {

using Range = std::pair<std::uint64_t, std::uint64_t>;  // begin, end in the file

/// The record of waveform packets that the header refers to; its length is in its own header.
Range waveformRecord(const LasFile& file, std::uint64_t points_end) {
  constexpr std::uint64_t kLengthAt = 20;
  const std::uint64_t begin = file.header().waveform_start;
  if (begin < points_end || begin > file.fileSize() || file.fileSize() - begin < kLasEvlrHeader)
    return {0, 0};
  std::byte length[sizeof(std::uint64_t)];
  file.readBytes(begin + kLengthAt, sizeof length, length);
  const std::uint64_t room = file.fileSize() - begin - kLasEvlrHeader;
  return {begin, begin + kLasEvlrHeader + std::min(room, loadLas<std::uint64_t>(length))};
}

}  // namespace

std::string UnclaimedBytes::describe() const {
  std::string text;
  if (bytes > 0) {
    text = grouped(bytes) + (bytes == 1 ? " byte" : " bytes") +
           " behind the points belong to no record";
    if (records > 0)
      text += "; they have the size of " + counted(records, "further point") + " of " +
              std::to_string(record_length) + " bytes, which the header does not count";
  }
  if (surplus_points > 0)
    text += (text.empty() ? "" : "; ") + grouped(surplus_points) +
            " bytes of compressed points lie behind those that the header counts";
  return text;
}

std::string UnclaimedBytes::describeCopy() const {
  const char* fate = "; they are copied as they are";
  if (surplus_points > 0)
    fate = bytes > 0 ? "; only the former are copied" : "; they are not copied";
  return describe() + fate;
}

UnclaimedBytes unclaimedBytes(const LasFile& file) {
  UnclaimedBytes found;
  found.record_length = file.header().record_length;
  found.surplus_points = file.surplusPointBytes();
  const std::uint64_t points_end = file.pointsEnd();
  if (points_end == 0 || points_end >= file.fileSize()) return found;
  std::vector<Range> claimed{waveformRecord(file, points_end), {file.fileSize(), file.fileSize()}};
  for (const LasVlrEntry& vlr : file.vlrs())
    if (vlr.extended)
      claimed.emplace_back(vlr.position - kLasEvlrHeader, vlr.position + vlr.length);
  std::sort(claimed.begin(), claimed.end());
  std::uint64_t at = points_end;
  for (const auto& [begin, end] : claimed) {
    const std::uint64_t gap = begin > at ? begin - at : 0;
    if (at == points_end && gap % found.record_length == 0 && !file.header().compressed)
      found.records = gap / found.record_length;
    found.bytes += gap;
    at = std::max(at, end);
  }
  return found;
}

}  // namespace pcl_als
