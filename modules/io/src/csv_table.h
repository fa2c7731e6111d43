// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {

/// Whether a field is a number, in whatever range.
bool isNumber(std::string_view text);

/** \brief A text table with a header line, read record by record.
 *
 * Separator , ; tab or blanks, as the header has it; columns are found by name (case ignored,
 * quotes and blanks around a field dropped). A UTF-8 byte order mark, CR and CRLF line ends, empty
 * lines and lines that begin with #, % or // are skipped. Every error is an InputError that names
 * file, line and column. A first line of numbers is refused as a record without a header.
 */
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& path);

  /// What is known of the header of an export, which may follow other lines.
  struct Header {
    /// Whether these are the names of the columns.
    std::function<bool(const std::vector<std::string_view>&)> recognised;
    /// Whether a column may be degrees, minutes and seconds in three fields.
    std::function<bool(std::string_view)> geodetic;
    /// Names given by the caller: lines before the first numbers are skipped.
    std::vector<std::string> columns;
    /// What a caller may set where the file has no header.
    Hint no_header = Hint::none;
  };
  /// The same with a header that stands below other lines, maybe as a comment, and a line of units
  /// below it. Columns may repeat a name. Fields of degrees, minutes and seconds are one field.
  CsvTable(const std::filesystem::path& path, const Header& header);

  /// Number of the column; InputError when the header lacks it.
  std::size_t required(std::string_view name) const;
  /// Number of the column, or npos.
  std::size_t optional(std::string_view name) const;
  /// Names of the columns as the header has them.
  const std::vector<std::string_view>& header() const { return header_; }
  /// Units of the columns from the line below the header; empty where there is none.
  const std::vector<std::string>& units() const { return units_; }
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  /// Reads the next record; false at the end. InputError when its fields are not as many as the
  /// header's.
  bool next();
  /// Number of the line that was read last, from one.
  std::size_t line() const { return line_; }
  /// A field of the record as it stands.
  std::string_view text(std::size_t column) const { return fields_[column]; }
  /// A finite number.
  double number(std::size_t column) const;
  /// A number of metres that is within the size of the Earth.
  double coordinate(std::size_t column) const;
  /// A finite number of degrees: decimal or "D M S" with blanks, colons or signs of the units
  /// between, the sign or the letter of the hemisphere at either end.
  double sexagesimal(std::size_t column) const;
  /// A finite number, or NaN where the field is empty or says nan.
  double numberOrNan(std::size_t column) const;
  /// The header as one line, fit for a message.
  std::string headerText() const;
  /// "no column 'NAME' in the header '…'"
  std::string lackOf(std::string_view name) const;
  /// "FILE: line L: WHAT", of the line that was read last.
  std::string at(const std::string& what) const;
  /// Throws the InputError "FILE: line L: WHAT" about the header.
  [[noreturn]] void refuseHeader(const std::string& what) const;
  /// Throws the InputError "FILE: line L, column 'c': 'text' WHAT".
  [[noreturn]] void refuse(std::size_t column, const std::string& what) const;

 private:
  bool nextLine(std::string_view& line);
  bool rawLine(std::string_view& line);
  void split(std::string_view line);
  void readFirstLine();
  void refuseNumbers() const;
  std::string hintOfNumbers() const;
  bool findHeader(const Header& header);
  void takeUnits();
  void skipToNumbers(const Header& header);
  void prepareRecords(const Header& header);
  void mergeSpans();

  std::string name_, content_;
  std::string_view rest_;
  std::size_t line_ = 0;
  Hint no_header_ = Hint::none;
  char separator_ = ',';
  std::vector<std::string> columns_;
  std::vector<std::string_view> header_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> names_given_, units_;
  std::vector<std::size_t> spans_;  ///< fields of each column; empty: one each
};

}  // namespace pcl_als::detail
