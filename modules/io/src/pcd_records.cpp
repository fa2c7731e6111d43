// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>

#include "lzf.h"
#include "pcd_file.h"

namespace pcl_als::detail {
namespace {

class BinaryRecords : public PcdRecords {
 public:
  BinaryRecords(const InputFile& file, const PcdHeader& header)
      : file_(file), position_(header.data_position), record_length_(header.record_length) {}
  void next(std::size_t count, std::byte* out) override {
    file_.read(position_, count * record_length_, out);
    position_ += count * record_length_;
  }

 private:
  const InputFile& file_;
  std::uint64_t position_;
  std::size_t record_length_;
};

/// Compressed data holds one field of all points after the other.
class CompressedRecords : public PcdRecords {
 public:
  CompressedRecords(const InputFile& file, const PcdHeader& header) : header_(header) {
    const std::uint64_t room = file.size() - header.data_position;
    std::uint32_t sizes[2] = {0, 0};
    if (room < sizeof sizes) fail(file, "ends before its compressed data");
    file.read(header.data_position, sizeof sizes, sizes);
    if (sizes[0] > room - sizeof sizes)
      fail(file, "ends inside its compressed data (truncated copy?)");
    if (sizes[1] != header.points * header.record_length)
      fail(file, "its compressed data are not of the size that its header declares");
    if (sizes[1] / kLzfMostExpansion > sizes[0]) fail(file, "its compressed data are corrupt");
    std::vector<std::byte> packed(sizes[0]);
    file.read(header.data_position + sizeof sizes, packed.size(), packed.data());
    columns_.resize(sizes[1]);
    if (!decompressLzf(packed.data(), packed.size(), columns_.data(), columns_.size()))
      fail(file, "its compressed data are corrupt");
  }

  void next(std::size_t count, std::byte* out) override {
    for (const PcdField& field : header_.fields) {
      const std::size_t size = field.size * field.count;
      const std::byte* from = columns_.data() + field.offset * header_.points + first_ * size;
      for (std::size_t i = 0; i < count; ++i)
        std::memcpy(out + i * header_.record_length + field.offset, from + i * size, size);
    }
    first_ += count;
  }

 private:
  [[noreturn]] static void fail(const InputFile& file, const char* what) {
    throw InputError(file.name() + ": " + what);
  }
  const PcdHeader& header_;
  std::vector<std::byte> columns_;
  std::uint64_t first_ = 0;
};

template <typename T>
bool putToken(std::string_view token, std::byte* out) {
  const auto value = valueIn<T>(token);
  if (value) std::memcpy(out, &*value, sizeof(T));
  return value.has_value();
}

bool putReal(std::string_view token, std::size_t size, std::byte* out) {
  const auto value = valueIn<double>(token);
  if (!value) return false;
  const float single = static_cast<float>(*value);
  if (size == 4)
    std::memcpy(out, &single, 4);
  else
    std::memcpy(out, &*value, 8);
  return true;
}

/// Stores one ASCII element in the form of its field; false when it is none.
bool putElement(std::string_view token, const PcdField& field, std::byte* out) {
  if (field.type == 'F') return putReal(token, field.size, out);
  const bool with_sign = field.type == 'I';
  switch (field.size) {
    case 1:
      return with_sign ? putToken<std::int8_t>(token, out) : putToken<std::uint8_t>(token, out);
    case 2:
      return with_sign ? putToken<std::int16_t>(token, out) : putToken<std::uint16_t>(token, out);
    case 4:
      return with_sign ? putToken<std::int32_t>(token, out) : putToken<std::uint32_t>(token, out);
    default:
      return with_sign ? putToken<std::int64_t>(token, out) : putToken<std::uint64_t>(token, out);
  }
}

class AsciiRecords : public PcdRecords {
 public:
  AsciiRecords(const InputFile& file, const PcdHeader& header)
      : file_(file), header_(header), position_(header.data_position) {}

  void next(std::size_t count, std::byte* out) override {
    for (std::size_t i = 0; i < count; ++i, ++point_) {
      std::byte* record = out + i * header_.record_length;
      for (const PcdField& field : header_.fields)
        for (std::size_t k = 0; k < field.count; ++k)
          readElement(field, record + field.offset + k * field.size);
    }
  }

 private:
  void readElement(const PcdField& field, std::byte* out) {
    const std::string_view token = nextToken();
    if (token.empty())
      throw InputError(file_.name() + ": ends at point " + std::to_string(point_) + " of " +
                       std::to_string(header_.points) + " (truncated copy?)");
    if (!putElement(token, field, out))
      throw InputError(file_.name() + ": point " + std::to_string(point_) + ", field " +
                       field.name + ": '" + printable(token, kLongestQuotation) +
                       "' is no value of its type");
  }

  static bool isBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  std::string_view nextToken() {
    skipBlanks();
    std::size_t end = at_;
    while (true) {
      while (end < text_.size() && !isBlank(text_[end])) ++end;
      if (end < text_.size() || !refill(end)) break;
    }
    const std::string_view token(text_.data() + at_, end - at_);
    at_ = end;
    return token;
  }

  void skipBlanks() {
    do {
      while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
      if (at_ < text_.size()) return;
      std::size_t end = at_;
      if (!refill(end)) return;
    } while (true);
  }

  /// Drops what was used and reads on; \a end is moved along. False at the end of the file.
  bool refill(std::size_t& end) {
    const std::size_t bytes = std::min<std::uint64_t>(kBuffer, file_.size() - position_);
    if (bytes == 0 || end - at_ > kLongestToken) return false;
    text_.erase(0, at_);
    end -= at_;
    at_ = 0;
    const std::size_t kept = text_.size();
    text_.resize(kept + bytes);
    file_.read(position_, bytes, &text_[kept]);
    position_ += bytes;
    return true;
  }

  static constexpr std::size_t kBuffer = std::size_t{1} << 20, kLongestToken = 4096;
  const InputFile& file_;
  const PcdHeader& header_;
  std::uint64_t position_;
  std::string text_;
  std::size_t at_ = 0;
  std::uint64_t point_ = 0;
};

}  // namespace

std::unique_ptr<PcdRecords> openPcdRecords(const InputFile& file, const PcdHeader& header) {
  if (header.data == PcdData::binary) return std::make_unique<BinaryRecords>(file, header);
  if (header.data == PcdData::ascii) return std::make_unique<AsciiRecords>(file, header);
  return std::make_unique<CompressedRecords>(file, header);
}

}  // namespace pcl_als::detail
