// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "csv_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::detail {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view trimmed(std::string_view text, std::string_view what) {
  const std::size_t first = text.find_first_not_of(what);
  // What is empty remains a part of the text: a view of its own would have no address.
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(what) - first + 1);
}

std::string_view fieldOf(std::string_view text) {
  text = trimmed(text, kBlanks);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = trimmed(text.substr(1, text.size() - 2), kBlanks);
  }
  return text;
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// A piece of a file that is fit for a message.
std::string quotable(std::string_view text) {
  return printable(text, kLongestQuotation);
}

char separatorOf(std::string_view header) {
  for (const char candidate : {',', ';', '\t'}) {
    if (header.find(candidate) != std::string_view::npos) return candidate;
  }
  return ' ';
}

}  // namespace

bool isNumber(std::string_view text) {
  return valueIn<double>(text).has_value();
}

CsvTable::CsvTable(const std::filesystem::path& path)
    : name_(path.string()), content_(readWholeFile(path, kTableLimits)), rest_(content_) {
  readFirstLine();
}

void CsvTable::readFirstLine() {
  if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  std::string_view header;
  if (!nextLine(header)) throw InputError(name_ + ": is empty; a header line is needed");
  separator_ = separatorOf(header);
  split(header);
  refuseNumbers();
  header_ = fields_;
  for (const std::string_view field : fields_) columns_.push_back(lowered(field));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const auto first = std::find(columns_.begin(), columns_.end(), columns_[i]);
    if (columns_[i].empty() || first == columns_.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    refuseHeader("column '" + quotable(columns_[i]) + "' appears twice" + hintOfNumbers());
  }
}

/// A line of numbers in the place of the header is a record. The first cell of a header may be
/// empty, as in a matrix of numbered classes; further ones of a record may be.
void CsvTable::refuseNumbers() const {
  const auto number_or_empty = [](std::string_view field) {
    return field.empty() || isNumber(field);
  };
  if (!isNumber(fields_.front()) || !std::all_of(fields_.begin(), fields_.end(), number_or_empty))
    return;
  const auto count = std::count_if(fields_.begin(), fields_.end(), isNumber);
  throw InputError(name_ + ": line " + std::to_string(line_) + " holds " +
                       counted(static_cast<std::uint64_t>(count), "number") +
                       ", but the file has no header line: name the columns in a line above it",
                   no_header_);
}

/// Asks for the header where some of what stands in its place are numbers, as in records that begin
/// with a name.
std::string CsvTable::hintOfNumbers() const {
  return std::any_of(header_.begin(), header_.end(), isNumber)
             ? "; is the line with the names of the columns missing?"
             : "";
}

std::size_t CsvTable::optional(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  return found == columns_.end() ? npos : static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::required(std::string_view name) const {
  const std::size_t column = optional(name);
  if (column != npos) return column;
  refuseHeader(lackOf(name));
}

std::string CsvTable::lackOf(std::string_view name) const {
  return "no column '" + std::string(name) + "' in the header '" + headerText() + "'" +
         hintOfNumbers();
}

std::string CsvTable::headerText() const {
  std::string header;
  for (const std::string& present : columns_) header += (header.empty() ? "" : ",") + present;
  return quotable(header);
}

std::string CsvTable::at(const std::string& what) const {
  return name_ + ": line " + std::to_string(line_) + ": " + what;
}

void CsvTable::refuseHeader(const std::string& what) const {
  throw InputError(at(what));
}

bool CsvTable::rawLine(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
  if (end != std::string_view::npos && line.data()[end] == '\r' && !rest_.empty() &&
      rest_.front() == '\n')
    rest_.remove_prefix(1);
  ++line_;
  return true;
}

bool CsvTable::nextLine(std::string_view& line) {
  while (rawLine(line)) {
    const std::string_view text = trimmed(line, kBlanks);
    if (!text.empty() && text.front() != '#' && text.front() != '%' && text.substr(0, 2) != "//")
      return true;
  }
  return false;
}

void CsvTable::split(std::string_view line) {
  fields_.clear();
  if (separator_ == ' ') {
    for (line = trimmed(line, kBlanks); !line.empty();) {
      const std::size_t end = line.find_first_of(kBlanks);
      fields_.push_back(fieldOf(line.substr(0, end)));
      line =
          end == std::string_view::npos ? std::string_view() : trimmed(line.substr(end), kBlanks);
    }
    return;
  }
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(separator_);
    fields_.push_back(fieldOf(line.substr(0, end)));
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
}

bool CsvTable::next() {
  std::string_view line;
  if (!nextLine(line)) return false;
  split(line);
  // A separator at the end of a line adds no column.
  if (!spans_.empty()) mergeSpans();
  if (fields_.size() == columns_.size() + 1 && fields_.back().empty()) fields_.pop_back();
  if (fields_.size() == columns_.size()) return true;
  throw InputError(name_ + ": line " + std::to_string(line_) + ": " +
                   std::to_string(fields_.size()) + " column(s), the header has " +
                   std::to_string(columns_.size()));
}

double CsvTable::number(std::size_t column) const {
  const auto value = valueIn<double>(fields_[column]);
  if (!value) refuse(column, "is not a number");
  if (!std::isfinite(*value)) refuse(column, "is not a finite number");
  return *value;
}

double CsvTable::coordinate(std::size_t column) const {
  constexpr double kFarthest = 1e8;  // beyond geocentric coordinates and false eastings
  const double value = number(column);
  if (std::abs(value) > kFarthest) refuse(column, "is not a coordinate in metres");
  return value;
}

double CsvTable::numberOrNan(std::size_t column) const {
  const std::string_view text = fields_[column];
  if (text.empty() || lowered(text) == "nan") return std::numeric_limits<double>::quiet_NaN();
  return number(column);
}

void CsvTable::refuse(std::size_t column, const std::string& what) const {
  throw InputError(name_ + ": line " + std::to_string(line_) + ", column '" +
                   quotable(columns_[column]) + "': '" + quotable(fields_[column]) + "' " + what);
}

}  // namespace pcl_als::detail
