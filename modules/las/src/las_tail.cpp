// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_tail.h"

#include <algorithm>

#include <pcl_als/las/unclaimed_bytes.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
constexpr std::size_t kWaveformStart = 227, kEvlrStart = 235, kEvlrCount = 243;

/// Bytes [begin, end) of the input.
struct Range {
  std::uint64_t begin = 0, end = 0;
};

/// Where the bytes behind the points begin. Where the end of compressed points is not known, only
/// what the header refers to can be told from them.
std::uint64_t tailOf(const LasFile& input) {
  const LasHeader& h = input.header();
  if (!h.compressed && input.isTruncated()) return input.fileSize();
  if (!h.compressed) return input.pointsEnd();
  const std::uint64_t points_end = input.pointsEnd();
  std::uint64_t tail = points_end > 0 ? points_end : input.fileSize();
  if (h.evlr_count > 0) tail = std::min(tail, h.evlr_start);
  if (h.waveform_start > h.offset_to_points) tail = std::min(tail, h.waveform_start);
  return tail;
}

/// The extended VLRs that do not hold for the output, in the order of the file.
std::vector<Range> droppedRecords(const LasFile& input, bool extended_records) {
  const bool compressed = input.header().compressed;
  std::vector<Range> dropped;
  for (const LasVlrEntry& vlr : input.vlrs()) {
    if (!vlr.extended) continue;
    if ((compressed && describesChunks(vlr.user_id, vlr.record_id)) ||
        (extended_records && describesExtraBytes(vlr.user_id, vlr.record_id)))
      dropped.push_back({vlr.position - kLasEvlrHeader, vlr.position + vlr.length});
  }
  return dropped;
}

class Tail {
 public:
  Tail(const LasFile& input, LasOutput& output, bool extended_records)
      : input_(input),
        output_(output),
        from_(tailOf(input)),
        to_(output.endPoints()),
        dropped_(droppedRecords(input, extended_records)) {}

  void copy() {
    std::uint64_t at = from_;
    for (const Range& range : dropped_) {
      copy({at, range.begin});
      at = range.end;
    }
    copy({at, input_.fileSize()});
    storePositions();
  }

 private:
  /// Position in the output of a byte of the tail, or of the next byte that is kept.
  std::uint64_t moved(std::uint64_t position) const {
    std::uint64_t at = position;
    for (const Range& range : dropped_)
      if (range.begin < position) at -= std::min(range.end, position) - range.begin;
    return at - from_ + to_;
  }

  void copy(const Range& range) {
    std::vector<std::byte> buffer(kBlockBytes);
    for (std::uint64_t at = range.begin; at < range.end;) {
      const std::size_t bytes = std::min<std::uint64_t>(buffer.size(), range.end - at);
      input_.readBytes(at, bytes, buffer.data());
      output_.put(moved(at), buffer.data(), bytes);
      at += bytes;
    }
  }

  void storePositions() {
    const LasHeader& h = input_.header();
    if (h.version_minor >= 3 && h.waveform_start >= from_)
      store(kWaveformStart, moved(h.waveform_start));
    if (h.version_minor < 4 || (h.evlr_count == 0 && !input_.isTruncated())) return;
    const auto left = h.evlr_count - static_cast<std::uint32_t>(dropped_.size());
    store(kEvlrStart, left == 0 ? 0 : moved(h.evlr_start));
    store(kEvlrCount, left);
  }

  template <typename T>
  void store(std::size_t field, T value) {
    output_.put(field, reinterpret_cast<const std::byte*>(&value), sizeof value);
  }

  const LasFile& input_;
  LasOutput& output_;
  const std::uint64_t from_, to_;
  const std::vector<Range> dropped_;
};

}  // namespace

void copyLasTail(const LasFile& input, LasOutput& output, bool extended_records) {
  Tail(input, output, extended_records).copy();
}

std::vector<std::string> remarksOf(const LasFile& input, const std::string& wrong_box,
                                   const WaveformCopy& waveforms) {
  std::vector<std::string> remarks = input.remarks();
  if (!wrong_box.empty()) remarks.push_back(wrong_box);
  if (!waveforms.remark().empty()) remarks.push_back(waveforms.remark());
  const UnclaimedBytes unclaimed = unclaimedBytes(input);
  if (unclaimed.any()) remarks.push_back(unclaimed.describeCopy());
  return remarks;
}

}  // namespace pcl_als::detail
