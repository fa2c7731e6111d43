// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pcd_header.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kLargestRecord = std::size_t{1} << 20;
constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 40U;
constexpr const char* kPadding = "_";  // as PCL calls it

/// The columns of PointLidar, with names without case and underscores.
constexpr std::pair<const char*, const char*> kColumns[] = {
    {"x", "x"},
    {"y", "y"},
    {"z", "z"},
    {"gpstime", "gps_time"},
    {"intensity", "intensity"},
    {"scanangle", "scan_angle"},
    {"scananglerank", "scan_angle"},
    {"pointsourceid", "point_source_id"},
    {"returnnumber", "return_number"},
    {"numberofreturns", "number_of_returns"},
    {"classification", "classification"},
    {"flags", "flags"},
    {"userdata", "user_data"},
};
/// So many: scan_angle has two names.
constexpr std::size_t kColumnCount = std::size(kColumns) - 1;

/// A name as it is compared: without case and underscores, and without "scalar" before it.
std::string plainName(const std::string& name) {
  constexpr std::string_view kScalar = "scalar";
  std::string plain;
  for (const char c : name)
    if (c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool prefixed = plain.size() > kScalar.size() && plain.rfind(kScalar, 0) == 0;
  return prefixed ? plain.substr(kScalar.size()) : plain;
}

void checkField(const PcdHeader& header, const PcdField& field, const std::string& name) {
  const std::string what = name + ": " + header.kind + " field " + field.name + ": ";
  const bool real = field.type == 'F' && (field.size == 4 || field.size == 8);
  const bool whole = (field.type == 'I' || field.type == 'U') &&
                     (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8);
  if (!real && !whole)
    throw InputError(what + "type " + std::string(1, field.type) + " of " +
                     std::to_string(field.size) + " bytes is unknown");
  if (field.count == 0 || field.count > kLargestRecord)
    throw InputError(what + "its COUNT is " + std::to_string(field.count));
}

bool hasVeryName(const PcdHeader& header, const std::string& name) {
  return std::any_of(header.fields.begin(), header.fields.end(),
                     [&](const PcdField& field) { return field.name == name; });
}

/// A field with the very name of a column is that column, whatever others are called.
void assignColumns(PcdHeader& header, const std::string& name) {
  std::map<std::string, const PcdField*> holders;
  for (PcdField& field : header.fields) {
    const std::string column = pcdColumnOf(field.name);
    if (column.empty() || (field.name != column && hasVeryName(header, column))) continue;
    const auto [holder, first] = holders.emplace(column, &field);
    if (!first)
      throw InputError(name + ": the " + header.kind + "'s fields " + holder->second->name +
                       " and " + field.name + " are the same by their names (" + column + ")");
    field.column = column;
  }
  header.of_pcl_als =
      header.of_pcl_als || (holders.size() == kColumnCount &&
                            std::all_of(holders.begin(), holders.end(), [](const auto& holder) {
                              return holder.first == holder.second->name;
                            }));
}

void takeComment(const std::string& line, const std::string& key, std::string& value) {
  if (line.rfind(key, 0) == 0) value = line.substr(key.size());
}

/// Goes through the header's lines; one member per key word.
class HeaderParser {
 public:
  HeaderParser(const std::string& text, std::uint64_t file_size, const std::string& name)
      : text_(text), file_size_(file_size), name_(name) {}

  PcdHeader parse() {
    std::size_t at = 0;
    while (!complete_) {
      const std::size_t end = text_.find('\n', at);
      if (end == std::string::npos) fail("the PCD header has no DATA line");
      std::string line = text_.substr(at, end - at);
      if (!line.empty() && line.back() == '\r') line.pop_back();
      at = end + 1;
      takeLine(line);
    }
    header_.data_position = at;
    finish();
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  void takeLine(const std::string& line) {
    takePcdComment(line, header_);
    if (line.empty() || line[0] == '#') return;
    std::istringstream stream(line);
    std::string key;
    stream >> key;
    std::vector<std::string> values;
    for (std::string value; stream >> value;) values.push_back(value);
    takeEntry(key, values);
  }

  void takeEntry(const std::string& key, const std::vector<std::string>& values) {
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") return takeNames(values);
    if (key == "SIZE")
      return takeEach(key, values,
                      [this](PcdField& field, const std::string& v) { field.size = count(v); });
    if (key == "TYPE")
      return takeEach(key, values,
                      [](PcdField& field, const std::string& v) { field.type = v[0]; });
    if (key == "COUNT")
      return takeEach(key, values,
                      [this](PcdField& field, const std::string& v) { field.count = count(v); });
    if (key == "WIDTH") return takeCount(values, width_);
    if (key == "HEIGHT") return takeCount(values, height_);
    if (key == "POINTS") return takeCount(values, points_);
    if (key == "VIEWPOINT") return takeViewpoint(values);
    if (key == "DATA") return takeData(values);
    fail("is not a PCD file (unknown header line '" + printable(key, kLongestQuotation) + "')");
  }

  std::uint64_t count(const std::string& text) const {
    const auto value = valueIn<std::uint64_t>(text);
    if (!value)
      fail("the PCD header has '" + printable(text, kLongestQuotation) + "' where a count belongs");
    return *value;
  }

  void takeCount(const std::vector<std::string>& values, std::optional<std::uint64_t>& to) const {
    to = count(values.empty() ? std::string() : values[0]);
  }

  void takeNames(const std::vector<std::string>& values) {
    header_.fields.clear();
    for (const std::string& value : values) {
      header_.fields.emplace_back();
      header_.fields.back().name = value;
    }
  }

  template <typename Take>
  void takeEach(const std::string& key, const std::vector<std::string>& values, Take take) {
    if (values.size() != header_.fields.size())
      fail("the PCD header's " + key + " line has " + std::to_string(values.size()) +
           " entries for " + std::to_string(header_.fields.size()) + " fields");
    for (std::size_t i = 0; i < values.size(); ++i) take(header_.fields[i], values[i]);
  }

  void takeViewpoint(const std::vector<std::string>& values) {
    std::vector<double> numbers;
    numbers.reserve(values.size());
    for (const std::string& value : values) numbers.push_back(valueIn<double>(value).value_or(NAN));
    if (numbers.size() != 7 ||
        !std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }))
      fail("the PCD header's VIEWPOINT is not seven numbers");
    header_.rotated = numbers[4] != 0.0 || numbers[5] != 0.0 || numbers[6] != 0.0;
    header_.viewpoint = {numbers[0], numbers[1], numbers[2]};
  }

  void takeData(const std::vector<std::string>& values) {
    const std::string kind = values.empty() ? "" : values[0];
    if (kind == "ascii")
      header_.data = PcdData::ascii;
    else if (kind == "binary")
      header_.data = PcdData::binary;
    else if (kind == "binary_compressed")
      header_.data = PcdData::binary_compressed;
    else
      fail("the PCD header's DATA is '" + printable(kind, kLongestQuotation) + "'");
    complete_ = true;
  }

  void finish() {
    if (header_.fields.empty()) fail("the PCD header has no FIELDS line");
    layOutPcdFields(header_, name_);
    if (header_.of_pcl_als && header_.rotated)
      fail("the PCD's VIEWPOINT is rotated; only a shift (… 1 0 0 0) can be the origin of a cloud");
    if (!points_ && !(width_ && height_))
      fail("the PCD header does not say how many points there are");
    if (width_ && height_) {
      if (*height_ != 0 && *width_ > kMostPoints / *height_)
        fail("the PCD header's WIDTH and HEIGHT are too large");
      if (points_ && *points_ != *width_ * *height_)
        fail("the PCD header's POINTS differ from WIDTH times HEIGHT");
    }
    header_.points = points_ ? *points_ : *width_ * *height_;
    checkPcdRoom(header_, file_size_, name_);
  }

  const std::string& text_;
  std::uint64_t file_size_;
  const std::string& name_;
  PcdHeader header_;
  std::optional<std::uint64_t> width_, height_, points_;
  bool complete_ = false;
};

}  // namespace

void takePcdComment(const std::string& line, PcdHeader& header) {
  takeComment(line, kPcdCrsComment, header.crs);
  takeComment(line, kPcdStripComment, header.strip_id);
  header.strip_id = printable(header.strip_id);  // is shown, and names files
  takeComment(line, kPcdCorrectionsComment, header.corrections);
  header.of_pcl_als = header.of_pcl_als || line.rfind(kPcdComment, 0) == 0;
}

void layOutPcdFields(PcdHeader& header, const std::string& name) {
  assignColumns(header, name);
  for (PcdField& field : header.fields) {
    checkField(header, field, name);
    field.offset = header.record_length;
    header.record_length += field.size * field.count;
    if (header.record_length > kLargestRecord)
      throw InputError(name + ": the " + header.kind + "'s records are too long");
  }
}

void checkPcdRoom(const PcdHeader& header, std::uint64_t file_size, const std::string& name) {
  const std::uint64_t room = file_size - std::min(file_size, header.data_position);
  if (header.data == PcdData::binary_compressed) return;  // its own sizes are checked later
  // An ASCII record has at least a digit and a separator per field; the last one may be missing.
  const bool ascii = header.data == PcdData::ascii;
  const std::uint64_t most =
      ascii ? (room + 1) / (2 * header.fields.size()) : room / header.record_length;
  if (header.points > most)
    throw InputError(name + ": the header declares " + std::to_string(header.points) +
                     " points but the file can hold at most " + std::to_string(most) +
                     " (truncated copy?)");
}

const PcdField* PcdHeader::find(const std::string& column) const {
  const auto field = std::find_if(fields.begin(), fields.end(),
                                  [&](const PcdField& f) { return f.column == column; });
  return field == fields.end() ? nullptr : &*field;
}

const PcdField* PcdHeader::named(const std::string& name) const {
  const PcdField* like = nullptr;
  std::size_t alike = 0;
  for (const PcdField& field : fields) {
    if (field.name == name) return &field;
    if (plainName(field.name) != plainName(name)) continue;
    like = &field;
    ++alike;
  }
  return alike == 1 ? like : nullptr;
}

const PcdField* PcdHeader::following(const PcdField& field) const {
  const auto next = std::find_if(fields.begin(), fields.end(), [&](const PcdField& f) {
    return f.offset > field.offset && f.name != kPadding;
  });
  return next == fields.end() ? nullptr : &*next;
}

std::vector<std::string> PcdHeader::unusedFields(const PcdField* channel) const {
  std::vector<std::string> names;
  for (const PcdField& field : fields)
    if (field.column.empty() && field.name != kPadding && &field != channel)
      names.push_back(field.name);
  return names;
}

std::string pcdColumnOf(const std::string& field) {
  const std::string plain = plainName(field);
  for (const auto& [name, column] : kColumns)
    if (plain == name) return column;
  return {};
}

const char* PcdHeader::dataName() const {
  if (data == PcdData::ascii) return "ascii";
  if (kind != std::string_view("PCD")) return "binary_little_endian";
  return data == PcdData::binary ? "binary" : "binary_compressed";
}

PcdHeader parsePcdHeader(const std::string& text, std::uint64_t file_size,
                         const std::string& name) {
  if (file_size == 0) throw InputError(name + ": the file is empty");
  return HeaderParser(text, file_size, name).parse();
}

}  // namespace pcl_als::detail
