// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "xyz_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/common/time_alignment.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 16, kBuffer = std::size_t{1} << 20;
constexpr std::string_view kSeparators = " \t,;";
constexpr std::string_view kMark = "\xEF\xBB\xBF";  // UTF-8

/// The columns of PointLidar in the order of XyzFile::Quantity, and the largest value of those that
/// are whole numbers.
struct KnownColumn {
  const char* name;
  double largest;  ///< 0: any number
};
constexpr KnownColumn kKnown[] = {{"x", 0},
                                  {"y", 0},
                                  {"z", 0},
                                  {"gps_time", 0},
                                  {"intensity", 0},
                                  {"scan_angle", 0},
                                  {"point_source_id", 65535},
                                  {"return_number", 255},
                                  {"number_of_returns", 255},
                                  {"classification", 255},
                                  {"flags", 255},
                                  {"user_data", 255},
                                  {"channel", 255}};

/// Other names that tables of points give to them. Not "time": that may be one since the start of a
/// recording.
constexpr const char* kOtherNames[][2] = {{"easting", "x"},
                                          {"northing", "y"},
                                          {"height", "z"},
                                          {"elevation", "z"},
                                          {"class", "classification"}};

bool isComment(std::string_view line) {
  return line.substr(0, 1) == "#" || line.substr(0, 2) == "//";
}

std::string_view withoutMark(std::string_view line) {
  return line.substr(std::min(line.find_first_not_of("#/ \t"), line.size()));
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at < line.size();) {
    at = std::min(line.find_first_not_of(kSeparators, at), line.size());
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    if (end > at) fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

std::string withoutQuotes(std::string_view field) {
  std::string name(field);
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  return name;
}

bool isNumber(std::string_view field) {
  return valueIn<double>(field).has_value();
}

int decimalsIn(std::string_view number) {
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  const std::size_t end =
      std::min(number.find_first_not_of("0123456789", point + 1), number.size());
  return static_cast<int>(end - point - 1);
}

}  // namespace

XyzFile::XyzFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
                 const std::string& channel_field)
    : file_(path), channel_name_(channel_field == "scanner_channel" ? "" : channel_field) {
  if (!columns.empty()) {
    const std::string lack = lackOf(columns);
    if (!lack.empty()) throw UsageError("columns of " + file_.name() + ": " + lack);
    setColumns(columns);
  }
  readHeader();
  if (!channel_name_.empty()) nameChannel(channel_name_);
  rewind();
}

void XyzFile::fail(const std::string& what) const {
  throw InputError(file_.name() + ": line " + std::to_string(line_) + ": " + what);
}

XyzFile::Quantity XyzFile::quantityOf(const std::string& name) {
  std::string column = pcdColumnOf(name), lower;
  for (const char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [other, known] : kOtherNames)
    if (lower == other) column = known;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Quantity::channel); ++i)
    if (column == kKnown[i].name) return static_cast<Quantity>(i);
  return Quantity::none;
}

bool XyzFile::has(Quantity quantity) const {
  return std::find(quantities_.begin(), quantities_.end(), quantity) != quantities_.end();
}

void XyzFile::setColumns(const std::vector<std::string>& names) {
  names_ = names;
  quantities_.clear();
  for (const std::string& name : names) quantities_.push_back(quantityOf(name));
}

/// What names of columns lack; empty: nothing.
std::string XyzFile::lackOf(const std::vector<std::string>& names) const {
  std::array<std::size_t, kQuantities + 1> found{};
  for (const std::string& name : names) ++found[static_cast<std::size_t>(quantityOf(name))];
  for (std::size_t i = 0; i < kQuantities; ++i) {
    if (found[i] == 0 && i <= static_cast<std::size_t>(Quantity::z))
      return std::string("none of them is ") + kKnown[i].name;
    if (found[i] > 1) return std::string("two of them are ") + kKnown[i].name;
  }
  return {};
}

/// The names of the columns, and the position of the first line of numbers.
void XyzFile::readHeader() {
  bool is_named = !quantities_.empty(), may_have_header = is_named;
  data_position_ = 0, data_line_ = 0;
  std::string_view line;
  for (;;) {
    const std::uint64_t before = position_ - (text_.size() - at_);
    const std::size_t number = line_;
    data_position_ = before, data_line_ = number;
    if (!nextLine(line)) break;
    if (number == 0 && line.substr(0, kMark.size()) == kMark) line.remove_prefix(kMark.size());
    line = trimmed(line);
    if (line.empty()) continue;
    const bool is_comment = isComment(line);
    if (is_comment) takePcdComment(std::string(line), comments_);
    const std::vector<std::string_view> fields = fieldsOf(withoutMark(line));
    const bool numbers = !is_comment && std::all_of(fields.begin(), fields.end(), isNumber);
    if (is_comment || (!numbers && !is_named)) {
      is_named = is_named || takeHeader(line, is_comment);
      continue;
    }
    if (may_have_header && std::none_of(fields.begin(), fields.end(), isNumber)) {
      may_have_header = false;  // the names are given in its place
      continue;
    }
    if (is_named) return;
    if (fields.size() != 3)
      fail("there are " + std::to_string(fields.size()) +
           " columns and no header line names them; add one (x y z …), or give their names");
    is_assumed_ = true;
    setColumns({"x", "y", "z"});
    return;
  }
  if (!is_named) throw InputError(file_.name() + ": the file has no points and no header line");
}

/// Whether a line is the header. A comment may be any text.
bool XyzFile::takeHeader(std::string_view line, bool is_comment) {
  std::vector<std::string> names;
  for (const std::string_view field : fieldsOf(withoutMark(line)))
    names.push_back(withoutQuotes(field));
  const std::string lack = lackOf(names);
  if (lack.empty())
    setColumns(names);
  else if (!is_comment)
    fail("'" + printable(line, kLongestQuotation) +
         "' does not name the columns, nor is it a point: " + lack);
  return lack.empty();
}

void XyzFile::nameChannel(const std::string& field) {
  if (quantityOf(field) == Quantity::user_data) return;  // is kept, and taken as the channel, too
  const auto found = std::find(names_.begin(), names_.end(), field);
  if (found == names_.end())
    throw InputError(file_.name() + ": has no column '" + field +
                     "' with the channel of the scanner; it has " + joined(names_));
  quantities_[static_cast<std::size_t>(found - names_.begin())] = Quantity::channel;
}

std::vector<std::string> XyzFile::remarks() const {
  constexpr std::size_t kMostNamed = 20;
  std::vector<std::string> unused, remarks;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (quantities_[i] == Quantity::none && names_[i] != "skip")
      unused.push_back(printable(names_[i], kLongestQuotation));
  if (!unused.empty())
    remarks.push_back(
        (unused.size() == 1 ? "its column is not used: " : "its columns are not used: ") +
        listedNames(unused, kMostNamed));
  if (is_assumed_)
    remarks.emplace_back("it has no header line: its three columns are taken as x, y and z");
  return remarks;
}

void XyzFile::rewind() {
  text_.clear();
  at_ = 0, position_ = data_position_, line_ = data_line_;
}

/// Reads on; false at the end of the file.
bool XyzFile::refill() {
  const std::size_t bytes = std::min<std::uint64_t>(kBuffer, file_.size() - position_);
  if (bytes == 0) return false;
  text_.erase(0, at_);
  at_ = 0;
  const std::size_t kept = text_.size();
  text_.resize(kept + bytes);
  file_.read(position_, bytes, &text_[kept]);
  position_ += bytes;
  return true;
}

/// The next line, until the next call; false at the end of the file.
bool XyzFile::nextLine(std::string_view& line) {
  std::size_t end = text_.find('\n', at_);
  while (end == std::string::npos) {
    const std::size_t known = text_.size() - at_;
    if (known > kLongestLine || !refill()) break;
    end = text_.find('\n', at_ + known);
  }
  const bool is_last = end == std::string::npos;
  if (is_last) end = text_.size();
  if (is_last && at_ == end) return false;
  ++line_;
  if (end - at_ > kLongestLine)
    fail("is longer than 65536 bytes: this is no text with a point in each line");
  line = std::string_view(text_).substr(at_, end - at_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  at_ = is_last ? end : end + 1;
  return true;
}

bool XyzFile::read(std::size_t lines, PointChunk& chunk) {
  chunk.resize(0);
  std::string_view line;
  std::size_t count = 0;
  for (; count < lines && nextLine(line); ++count) {
    line = trimmed(line);
    if (!line.empty() && !isComment(line)) takeLine(line, chunk);
  }
  return count > 0;
}

void XyzFile::takeLine(std::string_view line, PointChunk& chunk) {
  Values values{};
  values[static_cast<std::size_t>(Quantity::return_number)] = 1.0;
  values[static_cast<std::size_t>(Quantity::number_of_returns)] = 1.0;
  std::size_t column = 0;
  for (std::size_t at = 0; at < line.size();) {
    at = std::min(line.find_first_not_of(kSeparators, at), line.size());
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    if (end > at) {
      if (column < names_.size()) takeField(column, line.substr(at, end - at), values);
      ++column;
    }
    at = end;
  }
  if (column != names_.size())
    fail("has " + std::to_string(column) + " fields for " + std::to_string(names_.size()) +
         " columns");
  append(values, chunk);
}

void XyzFile::takeField(std::size_t column, std::string_view text, Values& values) {
  const Quantity quantity = quantities_[column];
  if (quantity == Quantity::none) return;
  const auto number = valueIn<double>(text);
  const auto refuse = [&](const std::string& what) {
    fail("column " + printable(names_[column], kLongestQuotation) + ": '" +
         printable(text, kLongestQuotation) + "' is " + what);
  };
  if (!number) refuse("no number");
  const double largest = kKnown[static_cast<std::size_t>(quantity)].largest;
  if (largest > 0.0 && !(*number >= 0.0 && *number <= largest && std::floor(*number) == *number))
    refuse("no whole number from 0 to " + std::to_string(static_cast<int>(largest)));
  values[static_cast<std::size_t>(quantity)] = *number;
  if (quantity <= Quantity::z) decimals_ = std::max(decimals_, decimalsIn(text));
}

void XyzFile::append(const Values& values, PointChunk& chunk) {
  const auto of = [&values](Quantity quantity) {
    return values[static_cast<std::size_t>(quantity)];
  };
  const auto byte = [&of](Quantity quantity) { return static_cast<std::uint8_t>(of(quantity)); };
  const double x = of(Quantity::x), y = of(Quantity::y), z = of(Quantity::z);
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return;
  const double time = of(Quantity::gps_time);
  time_units_ = std::max(time_units_, timeUnitsPerSecond(time));
  chunk.x.push_back(x), chunk.y.push_back(y), chunk.z.push_back(z);
  chunk.gps_time.push_back(secondsOfTime(time));
  chunk.intensity.push_back(static_cast<float>(of(Quantity::intensity)));
  chunk.scan_angle.push_back(static_cast<float>(of(Quantity::scan_angle)));
  chunk.point_source_id.push_back(static_cast<std::uint16_t>(of(Quantity::point_source_id)));
  chunk.return_number.push_back(byte(Quantity::return_number));
  chunk.number_of_returns.push_back(byte(Quantity::number_of_returns));
  chunk.classification.push_back(byte(Quantity::classification));
  chunk.flags.push_back(byte(Quantity::flags));
  chunk.user_data.push_back(byte(Quantity::user_data));
  const bool in_flags = channel_name_.empty();
  chunk.channel.push_back(in_flags                 ? chunk.flags.back() >> 6U
                          : has(Quantity::channel) ? byte(Quantity::channel)
                                                   : byte(Quantity::user_data));
}

}  // namespace pcl_als::detail
