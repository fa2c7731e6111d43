// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "file_bytes.h"

namespace pcl_als::test {

/// Bytes put together field by field, as the LAS specification's tables list them.
class Bytes {
 public:
  template <typename T>
  Bytes& add(T value) {
    const char* at = reinterpret_cast<const char*>(&value);
    text_.append(at, sizeof value);
    return *this;
  }
  Bytes& u8(unsigned v) { return add(static_cast<std::uint8_t>(v)); }
  Bytes& u16(unsigned v) { return add(static_cast<std::uint16_t>(v)); }
  Bytes& u32(std::uint64_t v) { return add(static_cast<std::uint32_t>(v)); }
  Bytes& u64(std::uint64_t v) { return add(v); }
  Bytes& i16(int v) { return add(static_cast<std::int16_t>(v)); }
  Bytes& i32(int v) { return add(static_cast<std::int32_t>(v)); }
  Bytes& f32(float v) { return add(v); }
  Bytes& f64(double v) { return add(v); }
  Bytes& text(const std::string& value, std::size_t size) {
    std::string field = value.substr(0, size);
    field.resize(size, '\0');
    text_ += field;
    return *this;
  }
  Bytes& raw(const std::string& bytes) {
    text_ += bytes;
    return *this;
  }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

/** \brief A LAS file written by hand from the specification, independent of the library.
 *
 * Point i has values that follow from i in every field, so that a swapped field shows.
 */
struct LasBytes {
  int minor = 4;
  int format = 6;
  unsigned count = 5;
  unsigned extra = 0;  ///< extra bytes per record, 0xA0, 0xA1, …
  double scale = 0.001, offset_x = 85000.0, offset_y = 5400000.0, offset_z = -50.0;
  unsigned encoding = 1;
  unsigned time_offset = 0;                 ///< 1.5
  std::vector<std::string> vlrs, evlrs;     ///< complete, with their headers
  std::string header_tail, between, after;  ///< bytes nobody knows

  static std::string vlr(const std::string& user, unsigned id, const std::string& data) {
    return Bytes()
        .u16(0)
        .text(user, 16)
        .u16(id)
        .u16(data.size())
        .text("made by hand", 32)
        .raw(data)
        .str();
  }
  static std::string evlr(const std::string& user, unsigned id, const std::string& data) {
    return Bytes()
        .u16(0)
        .text(user, 16)
        .u16(id)
        .u64(data.size())
        .text("made by hand", 32)
        .raw(data)
        .str();
  }

  bool extended() const { return format >= 6; }
  bool hasTime() const { return format != 0 && format != 2; }
  bool hasColour() const {
    return format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
  }
  bool hasInfrared() const { return format == 8 || format == 10; }
  bool hasWaveform() const { return format == 4 || format == 5 || format == 9 || format == 10; }

  static int X(unsigned i) { return 1000000 + 7 * static_cast<int>(i); }
  static int Y(unsigned i) { return -2000000 - 11 * static_cast<int>(i); }
  static int Z(unsigned i) { return 50000 + 13 * static_cast<int>(i); }
  static double time(unsigned i) { return 230038.25 + 0.0001 * i; }
  static unsigned returnNumber(unsigned i) { return i % 3 + 1; }
  static unsigned source(unsigned i) { return 57138 + i % 2; }
  unsigned classOf(unsigned i) const { return extended() ? 200 + i % 50 : i % 32; }

  std::string record(unsigned i) const {
    Bytes b;
    b.i32(X(i)).i32(Y(i)).i32(Z(i)).u16(300 + i);
    const unsigned number = returnNumber(i), returns = 3;
    if (extended()) {
      // flags: key point and overlap; channel 2; scan direction; not edge
      b.u8(number | returns << 4U).u8(0xAU | 2U << 4U | 1U << 6U).u8(classOf(i)).u8(90 + i % 100);
      b.i16(-2500 - static_cast<int>(i % 1000)).u16(source(i));
    } else {
      b.u8(number | returns << 3U | 1U << 7U).u8(classOf(i) | 4U << 5U);  // edge; withheld
      b.u8(static_cast<std::uint8_t>(-15 - static_cast<int>(i % 10)))
          .u8(90 + i % 100)
          .u16(source(i));
    }
    if (hasTime()) b.f64(time(i));
    if (hasColour()) b.u16(1000 + i).u16(2000 + i).u16(3000 + i);
    if (hasInfrared()) b.u16(4000 + i);
    if (hasWaveform())
      b.u8(1).u64(60 + 256ULL * i).u32(256).f32(12.5F).f32(1e-4F).f32(2e-4F).f32(3e-4F);
    for (unsigned k = 0; k < extra; ++k) b.u8(0xA0U + k);
    return b.str();
  }

  std::size_t headerSize() const {
    return (minor >= 5 ? 393U : minor == 4 ? 375U : minor == 3 ? 235U : 227U) + header_tail.size();
  }
  std::size_t offsetToPoints() const {
    std::size_t offset = headerSize() + between.size();
    for (const std::string& v : vlrs) offset += v.size();
    return offset;
  }

  std::string header() const {
    const std::size_t length = record(0).size();
    const bool legacy = format < 6 || minor < 4;
    Bytes b;
    b.text("LASF", 4).u16(7).u16(encoding).text("project", 16).u8(1).u8(minor);
    b.text("HAND", 32).text("las_bytes", 32).u16(45).u16(2026).u16(headerSize());
    b.u32(offsetToPoints()).u32(vlrs.size()).u8(format).u16(length).u32(legacy ? count : 0);
    for (unsigned r = 1; r <= 5; ++r) b.u32(legacy ? countOf(r) : 0);
    b.f64(scale).f64(scale).f64(scale).f64(offset_x).f64(offset_y).f64(offset_z);
    const unsigned last = count == 0 ? 0 : count - 1;
    b.f64(X(last) * scale + offset_x).f64(X(0) * scale + offset_x);
    b.f64(Y(0) * scale + offset_y).f64(Y(last) * scale + offset_y);
    b.f64(Z(last) * scale + offset_z).f64(Z(0) * scale + offset_z);
    if (minor >= 3) b.u64(0);
    if (minor >= 4) {
      const std::size_t end = offsetToPoints() + count * length;
      b.u64(evlrs.empty() ? 0 : end).u32(evlrs.size()).u64(count);
      for (unsigned r = 1; r <= 15; ++r) b.u64(countOf(r));
    }
    if (minor >= 5) {
      const bool timed = hasTime() && count > 0;
      b.f64(timed ? time(last) : 0.0).f64(timed ? time(0) : 0.0).u16(time_offset);
    }
    return b.raw(header_tail).str();
  }

  std::string str() const {
    std::string bytes = header();
    for (const std::string& v : vlrs) bytes += v;
    bytes += between;
    for (unsigned i = 0; i < count; ++i) bytes += record(i);
    for (const std::string& v : evlrs) bytes += v;
    return bytes + after;
  }

 private:
  unsigned countOf(unsigned number) const {
    unsigned n = 0;
    for (unsigned i = 0; i < count; ++i) n += returnNumber(i) == number ? 1 : 0;
    return n;
  }
};

/// A file with something in every place where bytes can be.
inline LasBytes fullFile(int minor, int format, unsigned count) {
  LasBytes las;
  las.minor = minor;
  las.format = format;
  las.count = count;
  las.extra = 5;
  las.header_tail = "more header";
  las.vlrs = {LasBytes::vlr("LASF_Projection", 2112, "WKT"),
              LasBytes::vlr("unknown", 77, "payload")};
  las.between = "bytes between";
  if (minor >= 4) las.evlrs = {LasBytes::evlr("LASF_Spec", 65535, std::string(3000, 'w'))};
  las.after = "bytes behind the end";
  return las;
}

}  // namespace pcl_als::test
