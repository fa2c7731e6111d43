// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Headers of exports: lines before the header, headers that are comments, lines of units, degrees
// in three fields.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/text_values.h>

#include "csv_table.h"

namespace pcl_als::detail {
namespace {

constexpr int kMostHeaderLines = 1000;

bool anyNumber(const std::vector<std::string_view>& fields) {
  return std::any_of(fields.begin(), fields.end(), isNumber);
}

std::string_view withoutMark(std::string_view line, bool& comment) {
  const std::size_t first = line.find_first_not_of(" \t");
  comment = first != std::string_view::npos &&
            (std::string_view("#%*!").find(line[first]) != std::string_view::npos ||
             line.substr(first, 2) == "//");
  if (!comment) return line;
  // An empty rest is one of the line, too: a view without characters has no address.
  return line.substr(std::min(line.find_first_not_of("#%*!/ \t", first), line.size()));
}

/// Where names are separated by blanks, a unit in brackets belongs to the name before it.
void joinUnits(std::vector<std::string_view>& fields) {
  std::vector<std::string_view> joined;
  for (const std::string_view field : fields) {
    if (joined.empty() || field.empty() || (field.front() != '(' && field.front() != '[')) {
      joined.push_back(field);
      continue;
    }
    const char* first = joined.back().data();
    joined.back() =
        std::string_view(first, static_cast<std::size_t>(field.data() + field.size() - first));
  }
  fields = std::move(joined);
}

/// The units of a line: groups in brackets, and words outside of them.
std::vector<std::string> unitsOf(std::string_view line) {
  std::vector<std::string> units;
  while (!line.empty()) {
    const std::size_t first = line.find_first_not_of(" \t,;");
    if (first == std::string_view::npos) break;
    line.remove_prefix(first);
    const bool bracket = line.front() == '(' || line.front() == '[';
    std::size_t end = bracket ? line.find_first_of(")]") : line.find_first_of(" \t,;([");
    if (bracket && end != std::string_view::npos) ++end;
    units.emplace_back(line.substr(0, end));
    line.remove_prefix(end == std::string_view::npos ? line.size() : end);
  }
  return units;
}

/// Fields of a column with that unit: "(+/-D M S)" has three.
std::size_t fieldsOf(const std::string& unit) {
  std::string letters;
  for (const char c : unit) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  if (letters == "DMS") return 3;
  return letters == "DM" ? 2 : 1;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path, const Header& header)
    : name_(path.string()),
      content_(readWholeFile(path, kTableLimits)),
      rest_(content_),
      no_header_(header.no_header) {
  if (!header.columns.empty()) {
    skipToNumbers(header);
  } else if (findHeader(header)) {
    takeUnits();
  } else {
    readFirstLine();
    return;
  }
  prepareRecords(header);
}

/// The first line that is recognised; one that is marked as a comment only where no other is.
bool CsvTable::findHeader(const Header& header) {
  if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  const std::string_view start = rest_;
  std::string_view line, best_rest;
  std::size_t best_line = 0;
  char best_separator = ' ';
  for (int i = 0; i < kMostHeaderLines && rawLine(line); ++i) {
    bool comment = false;
    const std::string_view text = withoutMark(line, comment);
    separator_ = ' ';
    for (const char candidate : {'\t', ';', ','}) {
      if (text.find(candidate) != std::string_view::npos) separator_ = candidate;
    }
    split(text);
    if (separator_ == ' ') joinUnits(fields_);
    if (header.recognised(fields_)) {
      header_ = fields_, best_rest = rest_, best_line = line_, best_separator = separator_;
      if (!comment) break;
    } else if (!comment && fields_.size() > 2 &&
               std::all_of(fields_.begin(), fields_.end(), isNumber)) {
      break;  // data
    }
  }
  rest_ = best_line > 0 ? best_rest : start;
  line_ = best_line;
  if (best_line == 0) return false;
  separator_ = best_separator;
  return true;
}

void CsvTable::takeUnits() {
  const std::string_view before = rest_;
  const std::size_t line_before = line_;
  std::string_view line;
  if (nextLine(line)) {
    split(line);
    const std::vector<std::string> units = unitsOf(line);
    const auto inBrackets = [](const std::string& unit) {
      return unit.front() == '(' || unit.front() == '[';
    };
    const auto brackets = std::count_if(units.begin(), units.end(), inBrackets);
    // Words without brackets ("week") are few among those with.
    if (!anyNumber(fields_) && 2 * static_cast<std::size_t>(brackets) > units.size()) {
      if (units.size() == header_.size()) units_ = units;
      return;
    }
  }
  rest_ = before;
  line_ = line_before;
}

void CsvTable::skipToNumbers(const Header& header) {
  names_given_ = header.columns;
  header_.assign(names_given_.begin(), names_given_.end());
  const auto skipped = [&](std::size_t i) { return names_given_[i] == "skip"; };
  std::size_t first = 0;
  while (first + 1 < header_.size() && skipped(first)) ++first;
  for (std::string_view line; !rest_.empty();) {
    const std::string_view before = rest_;
    const std::size_t line_before = line_;
    if (!nextLine(line)) break;
    separator_ = ' ';
    for (const char candidate : {'\t', ';', ','}) {
      if (line.find(candidate) != std::string_view::npos) separator_ = candidate;
    }
    split(line);
    if (fields_.size() < header_.size() || !isNumber(fields_[first])) continue;
    rest_ = before;
    line_ = line_before;
    return;
  }
  throw InputError(name_ + ": no line has " + std::to_string(header_.size()) +
                   " columns that begin with a number");
}

/// What the first record shows of separator and fields.
void CsvTable::prepareRecords(const Header& header) {
  for (const std::string_view name : header_) {
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    columns_.push_back(lower);
  }
  const std::string_view before = rest_;
  const std::size_t line_before = line_;
  std::string_view line;
  const bool any = nextLine(line);
  rest_ = before;
  line_ = line_before;
  if (!any) return;
  // POSPac separates the names by commas and the numbers by blanks.
  if (separator_ != ' ' && line.find(separator_) == std::string_view::npos) separator_ = ' ';
  if (separator_ != ' ') return;
  split(line);
  std::vector<std::size_t> spans(header_.size(), 1);
  for (std::size_t i = 0; i < units_.size(); ++i) spans[i] = fieldsOf(units_[i]);
  std::size_t sum = 0;
  for (const std::size_t span : spans) sum += span;
  const auto geodetic = std::count_if(header_.begin(), header_.end(), header.geodetic);
  if (sum == header_.size() && geodetic == 2 &&
      (fields_.size() == sum + 4 || fields_.size() == sum + 2)) {
    for (std::size_t i = 0; i < spans.size(); ++i) {
      if (header.geodetic(header_[i])) spans[i] = fields_.size() == sum + 4 ? 3 : 2;
    }
    spans_ = spans;
  } else if (sum > header_.size() && fields_.size() == sum) {
    spans_ = spans;
  }
}

/// The fields of a column become one.
void CsvTable::mergeSpans() {
  std::vector<std::string_view> merged;
  std::size_t next = 0;
  for (const std::size_t span : spans_) {
    if (next + span > fields_.size()) return;
    const std::string_view last = fields_[next + span - 1];
    const char* first = fields_[next].data();
    merged.emplace_back(first, static_cast<std::size_t>(last.data() + last.size() - first));
    next += span;
  }
  merged.insert(merged.end(), fields_.begin() + static_cast<std::ptrdiff_t>(next), fields_.end());
  fields_ = std::move(merged);
}

double CsvTable::sexagesimal(std::size_t column) const {
  const std::string_view text = fields_[column];
  if (isNumber(text)) return number(column);
  double parts[3] = {0.0, 0.0, 0.0}, sign = 1.0;
  int count = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (std::string_view("-SsWw").find(c) != std::string_view::npos) sign = -1.0;
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) {
      // Signs of the units may be of several bytes.
      const bool known = std::string_view("+-NnSsEeWw :'\"\t").find(c) != std::string_view::npos ||
                         static_cast<unsigned char>(c) >= 128;
      if (!known || (c == '-' && count > 0)) refuse(column, "is not an angle");
      ++i;
      continue;
    }
    if (count == 3) refuse(column, "is not an angle");
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(),
                                              parts[count++], std::chars_format::fixed);
    if (error != std::errc()) refuse(column, "is not an angle");
    i = static_cast<std::size_t>(end - text.data());
  }
  if (count == 0 || !(parts[1] < 60.0) || !(parts[2] < 60.0)) refuse(column, "is not an angle");
  const double degrees = sign * (parts[0] + parts[1] / 60.0 + parts[2] / 3600.0);
  if (!std::isfinite(degrees)) refuse(column, "is not an angle");
  return degrees;
}

}  // namespace pcl_als::detail
