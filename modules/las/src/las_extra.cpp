// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

// The extra-bytes descriptor: LAS 1.4 R15, table 25. 192 bytes each.
namespace pcl_als {
namespace {

constexpr std::size_t kDescriptor = 192;
constexpr std::uint8_t kHasScale = 8, kHasOffset = 16;
constexpr std::array<std::size_t, 11> kTypeSizes = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

LasExtraField parseDescriptor(const std::byte* at) {
  LasExtraField field;
  const auto type = loadLas<std::uint8_t>(at + 2);
  const auto options = loadLas<std::uint8_t>(at + 3);
  field.name = detail::textField(at + 4, 32);
  field.description = detail::textField(at + 160, 32);
  if (type == 0 || type > 30) {
    field.type = LasExtraType::undocumented;
    field.size = options;
    return field;
  }
  const int base = (type - 1) % 10 + 1;
  field.components = (type - 1) / 10 + 1;
  field.type = static_cast<LasExtraType>(base);
  field.size = kTypeSizes[base] * static_cast<std::size_t>(field.components);
  if ((options & kHasScale) != 0) field.scale = loadLas<double>(at + 112);
  if ((options & kHasOffset) != 0) field.offset = loadLas<double>(at + 136);
  return field;
}

/// Calls visit with a value of the field's raw type.
template <typename Visit>
void withType(LasExtraType type, Visit visit) {
  switch (type) {
    case LasExtraType::u8:
      return visit(std::uint8_t{});
    case LasExtraType::i8:
      return visit(std::int8_t{});
    case LasExtraType::u16:
      return visit(std::uint16_t{});
    case LasExtraType::i16:
      return visit(std::int16_t{});
    case LasExtraType::u32:
      return visit(std::uint32_t{});
    case LasExtraType::i32:
      return visit(std::int32_t{});
    case LasExtraType::u64:
      return visit(std::uint64_t{});
    case LasExtraType::i64:
      return visit(std::int64_t{});
    case LasExtraType::f32:
      return visit(float{});
    case LasExtraType::f64:
      return visit(double{});
    case LasExtraType::undocumented:
      return;
  }
}

template <typename T>
T rawOf(double value, const LasExtraField& field, const std::string& name) {
  if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
  const double nearest = std::nearbyint(value);
  // The limit of a 64-bit type is not a double: the next double above it is excluded.
  const double above = std::ldexp(1.0, std::numeric_limits<T>::digits);
  if (nearest >= static_cast<double>(std::numeric_limits<T>::min()) && nearest < above)
    return static_cast<T>(nearest);
  std::ostringstream text;
  text << name << ": extra field " << field.name << ": " << value * field.scale + field.offset
       << " does not fit its type";
  throw InputError(text.str());
}

}  // namespace

std::vector<LasExtraField> parseLasExtraFields(const std::vector<std::byte>& payload,
                                               std::size_t standard_length,
                                               std::size_t record_length) {
  std::vector<LasExtraField> fields;
  std::size_t position = standard_length;
  for (std::size_t at = 0; at + kDescriptor <= payload.size(); at += kDescriptor) {
    LasExtraField field = parseDescriptor(payload.data() + at);
    field.position = position;
    position += field.size;
    if (position > record_length) break;
    fields.push_back(std::move(field));
  }
  return fields;
}

std::vector<std::byte> serialiseLasExtraFields(const std::vector<LasExtraField>& fields) {
  std::vector<std::byte> bytes(kDescriptor * fields.size());
  std::byte* at = bytes.data();
  for (const LasExtraField& field : fields) {
    std::uint8_t options = 0;
    if (field.type == LasExtraType::undocumented) {
      options = static_cast<std::uint8_t>(field.size);
    } else {
      if (field.scale != 1.0) options |= kHasScale, storeLas(at + 112, field.scale);
      if (field.offset != 0.0) options |= kHasOffset, storeLas(at + 136, field.offset);
    }
    const int type = static_cast<int>(field.type) + 10 * (field.components - 1);
    storeLas(at + 2, static_cast<std::uint8_t>(type));
    storeLas(at + 3, options);
    detail::putTextField(at + 4, 32, field.name);
    detail::putTextField(at + 160, 32, field.description);
    at += kDescriptor;
  }
  return bytes;
}

std::size_t lasExtraSize(const LasExtraField& field) {
  if (field.type == LasExtraType::undocumented) return field.size;
  return kTypeSizes[static_cast<std::size_t>(field.type)] *
         static_cast<std::size_t>(field.components);
}

void decodeLasExtraField(const std::byte* records, std::size_t count, std::size_t record_length,
                         const LasExtraField& field, std::vector<double>& values) {
  values.assign(count, 0.0);
  if (count == 0) return;  // records may be null
  withType(field.type, [&](auto zero) {
    using Raw = decltype(zero);
    const std::byte* at = records + field.position;
    for (std::size_t i = 0; i < count; ++i, at += record_length)
      values[i] = static_cast<double>(loadLas<Raw>(at)) * field.scale + field.offset;
  });
}

void encodeLasExtraField(const std::vector<double>& values, std::size_t record_length,
                         const LasExtraField& field, const std::string& name, std::byte* records) {
  if (values.empty()) return;
  withType(field.type, [&](auto zero) {
    using Raw = decltype(zero);
    std::byte* at = records + field.position;
    for (std::size_t i = 0; i < values.size(); ++i, at += record_length)
      storeLas(at, rawOf<Raw>((values[i] - field.offset) / field.scale, field, name));
  });
}

}  // namespace pcl_als
