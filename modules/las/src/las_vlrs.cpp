// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_vlrs.h"

#include <array>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/damaged_file.h>

#include "las_bytes.h"

namespace pcl_als::detail {
namespace {

LasVlrEntry parseEntry(const std::byte* at, bool extended) {
  LasVlrEntry entry;
  entry.user_id = textField(at + 2, 16);
  entry.record_id = loadLas<std::uint16_t>(at + 18);
  entry.length = extended ? loadLas<std::uint64_t>(at + 20) : loadLas<std::uint16_t>(at + 20);
  entry.description = textField(at + (extended ? 28 : 22), 32);
  entry.extended = extended;
  return entry;
}

std::string entryName(bool extended, std::uint32_t index, std::uint32_t count) {
  return std::string(extended ? "extended VLR " : "VLR ") + std::to_string(index + 1) + " of " +
         std::to_string(count);
}

/// Walks records from a position up to \a end.
class Walk {
 public:
  Walk(const InputFile& file, bool extended, std::uint64_t position, std::uint64_t end)
      : file_(file), extended_(extended), position_(position), end_(end) {}

  bool hasRoom() const { return position_ <= end_ && end_ - position_ >= headerBytes(); }
  LasVlrEntry next(std::uint32_t index, std::uint32_t count) {
    std::array<std::byte, kLasEvlrHeader> block{};
    file_.read(position_, headerBytes(), block.data());
    LasVlrEntry entry = parseEntry(block.data(), extended_);
    entry.position = position_ + headerBytes();
    if (entry.length > end_ - entry.position)
      throw DamagedFile(file_.name() + ": " + entryName(extended_, index, count) + " (" +
                        entry.user_id + " " + std::to_string(entry.record_id) + ", " +
                        std::to_string(entry.length) + " bytes) reaches past " + limit());
    position_ = entry.position + entry.length;
    return entry;
  }
  const char* limit() const {
    return extended_ ? "the end of the file" : "the beginning of the points";
  }

 private:
  std::size_t headerBytes() const { return extended_ ? kLasEvlrHeader : kLasVlrHeader; }

  const InputFile& file_;
  const bool extended_;
  std::uint64_t position_;
  const std::uint64_t end_;
};

}  // namespace

std::string readVlrs(const InputFile& file, bool keep_intact, LasHeader& header,
                     std::vector<LasVlrEntry>& entries) {
  const std::uint32_t announced = header.vlr_count;
  Walk walk(file, false, header.header_size, header.offset_to_points);
  std::string damage;
  try {
    while (entries.size() < announced && walk.hasRoom())
      entries.push_back(walk.next(static_cast<std::uint32_t>(entries.size()), announced));
  } catch (const DamagedFile& error) {
    if (!keep_intact) throw;
    damage = "; the next one reaches past the beginning of the points";
  }
  header.vlr_count = static_cast<std::uint32_t>(entries.size());
  if (header.vlr_count == announced) return {};
  return "the header announces " + grouped(announced) + (announced == 1 ? " VLR" : " VLRs") +
         ", but there is room for " + std::to_string(header.vlr_count) + " before the points" +
         damage + "; the others are omitted";
}

void readExtendedEntries(const InputFile& file, const LasHeader& header,
                         std::vector<LasVlrEntry>& entries) {
  if (header.evlr_count == 0) return;
  const std::uint64_t points_end =
      header.offset_to_points + (header.compressed ? 0 : header.point_count * header.record_length);
  if (header.evlr_start < points_end)
    throw DamagedFile(file.name() + ": the extended VLRs are said to begin at byte " +
                      std::to_string(header.evlr_start) + ", before the end of the points");
  Walk walk(file, true, header.evlr_start, file.size());
  for (std::uint32_t i = 0; i < header.evlr_count; ++i) {
    if (!walk.hasRoom())
      throw DamagedFile(file.name() + ": " + entryName(true, i, header.evlr_count) +
                        " lies past the end of the file (truncated copy, or the number of VLRs is "
                        "wrong)");
    entries.push_back(walk.next(i, header.evlr_count));
  }
}

std::uint32_t readIntactEntries(const InputFile& file, LasHeader& header,
                                std::vector<LasVlrEntry>& entries) {
  const std::size_t before = entries.size();
  try {
    readExtendedEntries(file, header, entries);
  } catch (const InputError&) {
  }
  const auto found = static_cast<std::uint32_t>(entries.size() - before);
  const std::uint32_t lost = header.evlr_count - found;
  header.evlr_count = found;
  return lost;
}

}  // namespace pcl_als::detail
