// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ply_header.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::detail {
namespace {

constexpr std::uint64_t kMostElements = std::uint64_t{1} << 40U;

struct PlyType {
  const char *name, *other_name;
  char type;
  std::size_t size;
};
constexpr PlyType kTypes[] = {{"char", "int8", 'I', 1},     {"uchar", "uint8", 'U', 1},
                              {"short", "int16", 'I', 2},   {"ushort", "uint16", 'U', 2},
                              {"int", "int32", 'I', 4},     {"uint", "uint32", 'U', 4},
                              {"float", "float32", 'F', 4}, {"double", "float64", 'F', 8}};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PcdField> properties;
  bool has_lists = false;
};

class PlyParser {
 public:
  PlyParser(const std::string& text, std::uint64_t file_size, const std::string& name)
      : text_(text), file_size_(file_size), name_(name) {}

  PcdHeader parse() {
    header_.kind = "PLY";
    if (nextLine() != "ply") fail("is no PLY file: its first line is not 'ply'");
    while (!complete_) takeLine(nextLine());
    if (!has_format_) fail("the PLY header has no format line");
    takeVertices();
    header_.of_pcl_als = true;  // there is no other origin than zero
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }
  [[noreturn]] void failAt(const std::string& what) const {
    fail("line " + std::to_string(line_) + " of the PLY header: " + what);
  }
  static std::string quoted(const std::string& text) {
    return "'" + printable(text, kLongestQuotation) + "'";
  }

  std::string nextLine() {
    ++line_;
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos)
      fail(line_ == 1 ? "is no PLY file: its first line is not 'ply'"
                      : "the PLY header has no line end_header");
    std::string line = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  void takeLine(const std::string& line) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "comment") {
      takePcdComment("#" + line.substr(line.find(key) + key.size()), header_);
    } else if (key == "format") {
      takeFormat(words);
    } else if (key == "element") {
      takeElement(words);
    } else if (key == "property") {
      takeProperty(words);
    } else if (key == "end_header") {
      complete_ = true;
    } else if (key != "obj_info" && !key.empty()) {
      failAt(quoted(key) + " is unknown");
    }
  }

  void takeFormat(std::istringstream& words) {
    std::string format;
    words >> format;
    if (format == "ascii")
      header_.data = PcdData::ascii;
    else if (format == "binary_little_endian")
      header_.data = PcdData::binary;
    else
      failAt("format " + quoted(format) + " is not read; ascii and binary_little_endian are");
    has_format_ = true;
  }

  void takeElement(std::istringstream& words) {
    PlyElement& element = elements_.emplace_back();
    std::string count;
    words >> element.name >> count;
    const auto number = valueIn<std::uint64_t>(count);
    if (!number || *number > kMostElements)
      failAt("the number of the elements is " + quoted(count));
    element.count = *number;
  }

  void takeProperty(std::istringstream& words) {
    if (elements_.empty()) failAt("a property stands before the first element");
    std::string type;
    PcdField field;
    words >> type;
    if (type == "list") {
      elements_.back().has_lists = true;
      return;
    }
    words >> field.name;
    const auto* const known =
        std::find_if(std::begin(kTypes), std::end(kTypes), [&](const PlyType& candidate) {
          return type == candidate.name || type == candidate.other_name;
        });
    if (known == std::end(kTypes) || field.name.empty())
      failAt("the type " + quoted(type) + " of property " + quoted(field.name) + " is unknown");
    field.type = known->type, field.size = known->size;
    elements_.back().properties.push_back(std::move(field));
  }

  /// The bytes of the elements before the vertices.
  std::uint64_t bytesOf(const PlyElement& element) const {
    if (element.count == 0) return 0;
    std::uint64_t size = 0;
    for (const PcdField& property : element.properties) size += property.size;
    if (element.has_lists || header_.data == PcdData::ascii)
      fail("the elements " + quoted(element.name) +
           " of the PLY stand before the vertices and have no fixed size");
    if (size > 0 && element.count > file_size_ / size)
      fail("the PLY header declares more elements " + quoted(element.name) +
           " than the file can hold");
    return element.count * size;
  }

  void takeVertices() {
    header_.data_position = at_;
    std::optional<PlyElement> vertices;
    if (std::none_of(elements_.begin(), elements_.end(),
                     [](const PlyElement& element) { return element.name == "vertex"; }))
      fail("the PLY has no element vertex");
    for (PlyElement& element : elements_) {
      if (element.name == "vertex" && !vertices) {
        vertices = std::move(element);
        continue;
      }
      if (!vertices) header_.data_position += bytesOf(element);
      if (element.count > 0)
        header_.other_elements.push_back(printable(element.name, kLongestQuotation));
    }
    if (vertices->has_lists) fail("the vertices of the PLY have lists, which are not read");
    if (vertices->properties.empty()) fail("the vertices of the PLY have no properties");
    header_.fields = std::move(vertices->properties);
    header_.points = vertices->count;
    layOutPcdFields(header_, name_);
    dropFloatTimes();
    checkPcdRoom(header_, file_size_, name_);
  }

  void dropFloatTimes() {
    for (PcdField& field : header_.fields) {
      if (field.column != "gps_time" || field.size == 8) continue;
      field.column.clear();
      header_.time_fault =
          "its GPS times are not used, they are of " + std::to_string(field.size) +
          " bytes and not of 8 (double): a float of week seconds has steps of 0.03 s, two metres "
          "of flight";
    }
  }

  const std::string& text_;
  std::uint64_t file_size_;
  const std::string& name_;
  PcdHeader header_;
  std::vector<PlyElement> elements_;
  std::size_t at_ = 0, line_ = 0;
  bool complete_ = false, has_format_ = false;
};

}  // namespace

PcdHeader parsePlyHeader(const std::string& text, std::uint64_t file_size,
                         const std::string& name) {
  if (file_size == 0) throw InputError(name + ": the file is empty");
  return PlyParser(text, file_size, name).parse();
}

}  // namespace pcl_als::detail
