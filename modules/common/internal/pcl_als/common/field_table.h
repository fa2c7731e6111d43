// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/field_node.h>
#include <pcl_als/common/field_value.h>

namespace pcl_als {

struct FieldRow;

/** \brief The description of a result: its fields with name, unit, meaning, and access to them.
 *
 * From it follow the values that files contain (write(), read()), the columns of CSV files, the
 * JSON Schema (schemaOf()) and the reference in the manual (referenceOf()). Fields<S> makes one for
 * a struct S; here, objects are S without their type. Copies share the description.
 */
class FieldTable {
 public:
  /// \param name of a table in schema and manual, unique among those of a file
  FieldTable(std::string name, std::string meaning, std::vector<FieldRow> rows);

  const std::string& name() const;
  const std::string& meaning() const;
  const std::vector<FieldRow>& rows() const;
  /// What is to be checked after reading an object; the node is that of the object.
  void setCheck(std::function<void(const void*, const FieldNode&)> check);

  FieldValue write(const void* object) const;
  /// Reads the fields that can be read; fields that the table does not have are ignored. InputError
  /// names the file, the way to the field, and what is wrong with it.
  void read(void* object, const FieldNode& node) const;

  /// The first line of a CSV file with the fields that are columns; \a before begins each name.
  std::string csvHeader(const std::string& before = {}, const char* end = "\n") const;
  /// A line of it: unknown values are empty, texts are quoted where necessary.
  std::string csvLine(const void* object, const char* end = "\n") const;

 private:
  struct Content;
  std::shared_ptr<Content> content_;
};

/// What the values of a field are.
struct FieldType {
  enum class Kind { any, truth, whole, count, number, text, list, object };

  Kind kind = Kind::any;
  bool nullable = false;
  std::vector<std::string> choices = {};  ///< the only texts; empty: any
  std::vector<FieldTable> table = {};     ///< of an object: one, or none where it is described
                                          ///< by its meaning alone
  std::vector<FieldType> item = {};       ///< of a list, or of an object by names: one
  std::size_t length = 0;                 ///< of a list; 0: any
};

/// Conditions on numbers when they are read, and their conversion.
struct FieldNumber {
  double internal_per_unit = 1.0;  ///< value in the program = value in the file times this
  double limit = 0.0;              ///< largest absolute value in the file; 0: none
  bool known = false;              ///< null is refused
  bool negative = true;            ///< negative values are accepted
};

/// One field of a table.
struct FieldRow {
  std::string name;     ///< empty: the fields of its table belong to the object itself
  std::string meaning;  ///< a sentence for the manual and the schema
  std::string unit;     ///< empty: that of the suffix of the name, such as _m, or none
  FieldType type;
  FieldNumber number;
  std::function<FieldValue(const void*, const FieldRow&)> get;
  std::function<void(void*, const FieldNode&, const FieldRow&)> set;  ///< empty: it is not read
  std::function<bool(const void*)> present;  ///< false: the field is omitted; empty: never
  std::function<bool(const void*)> known;    ///< false: the value is null; empty: never
  std::function<void(const void*, const FieldNode&)> check;  ///< after reading it; empty: none
  bool unless_empty = false;                                 ///< omitted if isEmpty()
  bool may_be_missing = false;                               ///< when it is read
  bool is_constant = false;                                  ///< the same in all files
  bool is_column = false;                                    ///< of CSV files
  std::string column;  ///< name there; of an object: what its columns begin with
  int digits = -1;     ///< decimals in CSV files; -1: those that are needed

  /// The value in the file. Null where it is not known.
  FieldValue valueOf(const void* object) const;
  /// Whether the field may be absent from a file of this version.
  bool mayBeAbsent() const { return present != nullptr || unless_empty; }
};

/// A cell of a CSV file: a text, in quotation marks where it has separators or such marks itself.
std::string csvCell(const std::string& text);

/// Reads a number with the conditions of a row, in the units of the program; null becomes NaN.
double readNumber(const FieldNode& node, const FieldRow& row);

/// The JSON Schema (draft 2020-12) of files with this table. \param file name of the file
FieldValue schemaOf(const FieldTable& table, const std::string& file);

/// The reference of all fields in Markdown, a section for each table; \a file is the name of the
/// file without its extension, which the headings begin with.
std::string referenceOf(const FieldTable& table, const std::string& file);

}  // namespace pcl_als
