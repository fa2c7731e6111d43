// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

// The extra-bytes descriptor: LAS 1.4 R15, table 25.
namespace pcl_als {
namespace {

constexpr std::size_t kTypeAt = 2, kOptionsAt = 3, kNameAt = 4, kNoDataAt = 40, kScaleAt = 112,
                      kOffsetAt = 136, kDescriptionAt = 160, kTextBytes = 32;
constexpr std::uint8_t kHasNoData = 1, kHasScale = 8, kHasOffset = 16;
constexpr std::uint8_t kLastType = 30;  ///< later ones are reserved, their size is not known
constexpr std::array<std::size_t, 11> kTypeSizes = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

enum class NumberKind { unsigned_integer, signed_integer, floating };

NumberKind kindOf(LasExtraType type) {
  if (type >= LasExtraType::f32) return NumberKind::floating;
  const bool is_signed = static_cast<int>(type) % 2 == 0;
  return is_signed ? NumberKind::signed_integer : NumberKind::unsigned_integer;
}

/// A number of a descriptor, which is as wide as the widest type of its kind.
double loadWide(const std::byte* at, LasExtraType type) {
  switch (kindOf(type)) {
    case NumberKind::unsigned_integer:
      return static_cast<double>(loadLas<std::uint64_t>(at));
    case NumberKind::signed_integer:
      return static_cast<double>(loadLas<std::int64_t>(at));
    case NumberKind::floating:
      break;
  }
  return loadLas<double>(at);
}

void storeWide(std::byte* at, LasExtraType type, double value) {
  switch (kindOf(type)) {
    case NumberKind::unsigned_integer:
      return storeLas(at, static_cast<std::uint64_t>(value));
    case NumberKind::signed_integer:
      return storeLas(at, static_cast<std::int64_t>(value));
    case NumberKind::floating:
      return storeLas(at, value);
  }
}

LasExtraField parseDescriptor(const std::byte* at) {
  LasExtraField field;
  const auto type = loadLas<std::uint8_t>(at + kTypeAt);
  const auto options = loadLas<std::uint8_t>(at + kOptionsAt);
  field.name = detail::textField(at + kNameAt, kTextBytes);
  field.description = detail::textField(at + kDescriptionAt, kTextBytes);
  if (type == 0) {
    field.type = LasExtraType::undocumented;
    field.size = options;
    return field;
  }
  const int base = (type - 1) % 10 + 1;
  field.components = (type - 1) / 10 + 1;
  field.type = static_cast<LasExtraType>(base);
  field.size = kTypeSizes[base] * static_cast<std::size_t>(field.components);
  if ((options & kHasNoData) != 0) field.no_data = loadWide(at + kNoDataAt, field.type);
  if ((options & kHasScale) != 0) field.scale = loadLas<double>(at + kScaleAt);
  if ((options & kHasOffset) != 0) field.offset = loadLas<double>(at + kOffsetAt);
  return field;
}

/// Appends the fields of one payload after the other.
class ExtraBytesJoin {
 public:
  ExtraBytesJoin(std::size_t standard_length, std::size_t record_length)
      : record_length_(record_length) {
    extra_.end = standard_length;
  }

  void add(const std::vector<std::byte>& payload) {
    const std::size_t whole = payload.size() / kLasExtraDescriptor * kLasExtraDescriptor;
    for (std::size_t at = 0; at < whole; at += kLasExtraDescriptor) addField(&payload[at]);
    if (whole < payload.size())
      remark("the last " + counted(payload.size() - whole, "byte") +
             " of an extra-bytes record are no whole descriptor and are ignored");
  }

  LasExtraBytes take() {
    if (!stopped_by_.empty())
      remark(
          stopped_by_ + "; " +
          (ignored_ == 1 ? "it is" : "it and " + std::to_string(ignored_ - 1) + " behind it are") +
          " ignored");
    remarkRepeatedNames();
    return std::move(extra_);
  }

 private:
  void remark(const std::string& text) { extra_.remarks.push_back(text); }

  void addField(const std::byte* descriptor) {
    if (!stopped_by_.empty()) {
      ++ignored_;
      return;
    }
    LasExtraField field = parseDescriptor(descriptor);
    const std::string name = "extra field '" + field.name + "'";
    const auto type = loadLas<std::uint8_t>(descriptor + kTypeAt);
    if (type > kLastType) return stop(name + " has the unknown type " + std::to_string(type));
    if (field.size == 0) return remark(name + " describes no bytes and is ignored");
    if (field.size > record_length_ - extra_.end)
      return stop(name + " of " + counted(field.size, "byte") + " at byte " +
                  std::to_string(extra_.end) + " has no room in records of " +
                  counted(record_length_, "byte"));
    makeUsable(name, field);
    field.position = extra_.end;
    extra_.end += field.size;
    extra_.fields.push_back(std::move(field));
    extra_.descriptors.insert(extra_.descriptors.end(), descriptor,
                              descriptor + kLasExtraDescriptor);
  }

  void stop(const std::string& reason) {
    stopped_by_ = reason;
    ignored_ = 1;
  }

  void makeUsable(const std::string& name, LasExtraField& field) {
    if (field.scale == 0.0 || !std::isfinite(field.scale)) {
      remark(name + " has a scale of " + shortText(field.scale) + "; 1 is used");
      field.scale = 1.0;
    }
    if (!std::isfinite(field.offset)) {
      remark(name + " has an offset of " + shortText(field.offset) + "; 0 is used");
      field.offset = 0.0;
    }
  }

  void remarkRepeatedNames() {
    std::map<std::string, std::size_t> counts;
    for (const LasExtraField& field : extra_.fields)
      if (field.type != LasExtraType::undocumented) ++counts[field.name];
    for (const auto& [name, count] : counts)
      if (count > 1)
        remark(std::to_string(count) + " extra fields have the same name '" + name + "'");
  }

  std::size_t record_length_;
  LasExtraBytes extra_;
  std::string stopped_by_;  ///< why no field can be placed any more
  std::size_t ignored_ = 0;
};

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

LasExtraBytes joinLasExtraBytes(const std::vector<std::vector<std::byte>>& payloads,
                                std::size_t standard_length, std::size_t record_length) {
  ExtraBytesJoin join(standard_length, record_length);
  for (const std::vector<std::byte>& payload : payloads) join.add(payload);
  return join.take();
}

std::vector<std::byte> serialiseLasExtraFields(const std::vector<LasExtraField>& fields) {
  std::vector<std::byte> bytes(kLasExtraDescriptor * fields.size());
  std::byte* at = bytes.data();
  for (const LasExtraField& field : fields) {
    std::uint8_t options = 0;
    if (field.type == LasExtraType::undocumented) {
      options = static_cast<std::uint8_t>(field.size);
    } else {
      if (field.no_data)
        options |= kHasNoData, storeWide(at + kNoDataAt, field.type, *field.no_data);
      if (field.scale != 1.0) options |= kHasScale, storeLas(at + kScaleAt, field.scale);
      if (field.offset != 0.0) options |= kHasOffset, storeLas(at + kOffsetAt, field.offset);
    }
    const int type = static_cast<int>(field.type) + 10 * (field.components - 1);
    storeLas(at + kTypeAt, static_cast<std::uint8_t>(type));
    storeLas(at + kOptionsAt, options);
    detail::putTextField(at + kNameAt, kTextBytes, field.name);
    detail::putTextField(at + kDescriptionAt, kTextBytes, field.description);
    at += kLasExtraDescriptor;
  }
  return bytes;
}

const LasExtraField* findLasExtraField(const std::vector<LasExtraField>& fields,
                                       const std::string& name, const std::string& file) {
  const LasExtraField* found = nullptr;
  for (const LasExtraField& field : fields) {
    if (field.name != name) continue;
    if (found != nullptr)
      throw InputError(file + ": has several extra fields '" + name + "'; rename all but one");
    found = &field;
  }
  return found;
}

std::size_t lasExtraSize(const LasExtraField& field) {
  if (field.type == LasExtraType::undocumented) return field.size;
  return kTypeSizes[static_cast<std::size_t>(field.type)] *
         static_cast<std::size_t>(field.components);
}

std::string lasExtraTypeName(const LasExtraField& field) {
  static const char* const names[] = {"undocumented", "uint8",  "int8",  "uint16",
                                      "int16",        "uint32", "int32", "uint64",
                                      "int64",        "float",  "double"};
  const std::string name = names[static_cast<std::size_t>(field.type)];
  if (field.type == LasExtraType::undocumented) return name + ", " + counted(field.size, "byte");
  return field.components == 1 ? name : std::to_string(field.components) + " x " + name;
}

void decodeLasExtraField(const std::byte* records, std::size_t count, std::size_t record_length,
                         const LasExtraField& field, std::vector<double>& values) {
  // Undocumented bytes have no values.
  values.assign(count, std::numeric_limits<double>::quiet_NaN());
  if (count == 0) return;  // records may be null
  withType(field.type, [&](auto zero) {
    using Raw = decltype(zero);
    const std::byte* at = records + field.position;
    for (std::size_t i = 0; i < count; ++i, at += record_length)
      values[i] = static_cast<double>(loadLas<Raw>(at)) * field.scale + field.offset;
    if (!field.no_data) return;
    at = records + field.position;
    for (std::size_t i = 0; i < count; ++i, at += record_length)
      if (static_cast<double>(loadLas<Raw>(at)) == *field.no_data)
        values[i] = std::numeric_limits<double>::quiet_NaN();
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
