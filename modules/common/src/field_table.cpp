// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cstdio>
#include <utility>

#include <pcl_als/common/field_table.h>
#include <pcl_als/common/fields.h>

namespace pcl_als {

struct FieldTable::Content {
  std::string name, meaning;
  std::vector<FieldRow> rows;
  std::function<void(const void*, const FieldNode&)> check;
};

namespace {

/// Units by the ends of names.
constexpr std::array<std::pair<const char*, const char*>, 22> kUnitsByEnd{
    {{"_m_per_m", "m/m"},     {"_m_per_s", "m/s"},
     {"_m_per_deg", "m/deg"}, {"_mm_per_100m", "mm/100 m"},
     {"_mm_per_s", "mm/s"},   {"_mm_per_deg", "mm/deg"},
     {"_per_m2", "1/m²"},     {"_per_km", "1/km"},
     {"_m2", "m²"},           {"_mm", "mm"},
     {"_cm", "cm"},           {"_km", "km"},
     {"_nm", "nm"},           {"_m", "m"},
     {"_arcsec", "arcsec"},   {"_mdeg", "mdeg"},
     {"_deg", "deg"},         {"_s", "s"},
     {"_mb", "MB"},           {"_percent", "%"},
     {"_kpa", "kPa"},         {"_c", "°C"}}};

std::string unitOf(const std::string& name) {
  for (const auto& [end, unit] : kUnitsByEnd) {
    const std::string_view suffix(end);
    if (name.size() > suffix.size() &&
        name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0)
      return unit;
  }
  return {};
}

bool isNumber(const FieldType& type) {
  if (type.kind == FieldType::Kind::list) return !type.item.empty() && isNumber(type.item.front());
  return type.kind == FieldType::Kind::number;
}

std::string cellOf(const FieldValue& value, int digits) {
  char text[400];
  if (const auto* number = value.as<double>()) {
    if (digits < 0)
      std::snprintf(text, sizeof text, "%.17g", *number);
    else
      std::snprintf(text, sizeof text, "%.*f", digits, *number);
    return text;
  }
  if (const auto* whole = value.as<std::int64_t>()) return std::to_string(*whole);
  if (const auto* count = value.as<std::uint64_t>()) return std::to_string(*count);
  if (const auto* truth = value.as<bool>()) return *truth ? "true" : "false";
  if (const auto* words = value.as<std::string>()) return csvCell(*words);
  return {};
}

void addNames(const FieldTable& table, const std::string& before, std::string& line) {
  for (const FieldRow& row : table.rows()) {
    if (!row.is_column) continue;
    if (row.type.table.empty())
      line += before + row.column + ',';
    else
      addNames(row.type.table.front(), before + row.column, line);
  }
}

/// The cells of the columns of an object, of which \a find returns the values.
template <typename Find>
void addCells(const FieldTable& table, Find find, std::string& line) {
  for (const FieldRow& row : table.rows()) {
    if (!row.is_column) continue;
    const FieldValue value = find(row);
    const auto inside = [&value](const FieldRow& field) {
      const FieldValue* found = value.find(field.name);
      return found == nullptr ? FieldValue() : *found;
    };
    if (row.type.table.empty())
      line += cellOf(value, row.digits) + ',';
    else
      addCells<std::function<FieldValue(const FieldRow&)>>(row.type.table.front(), inside, line);
  }
}

}  // namespace

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

FieldTable::FieldTable(std::string name, std::string meaning, std::vector<FieldRow> rows)
    : content_(std::make_shared<Content>()) {
  for (FieldRow& row : rows) {
    if (row.unit.empty() && isNumber(row.type)) row.unit = unitOf(row.name);
    if (row.number.known && row.type.kind == FieldType::Kind::number) row.type.nullable = false;
  }
  *content_ = {std::move(name), std::move(meaning), std::move(rows), {}};
}

const std::string& FieldTable::name() const {
  return content_->name;
}
const std::string& FieldTable::meaning() const {
  return content_->meaning;
}
const std::vector<FieldRow>& FieldTable::rows() const {
  return content_->rows;
}
void FieldTable::setCheck(std::function<void(const void*, const FieldNode&)> check) {
  content_->check = std::move(check);
}

FieldValue FieldRow::valueOf(const void* object) const {
  return known && !known(object) ? FieldValue() : get(object, *this);
}

FieldValue FieldTable::write(const void* object) const {
  FieldValue::Object fields;
  for (const FieldRow& row : rows()) {
    if (row.present && !row.present(object)) continue;
    FieldValue value = row.valueOf(object);
    if (row.unless_empty && value.isEmpty()) continue;
    if (!row.name.empty()) {
      fields.emplace_back(row.name, std::move(value));
    } else if (const auto* more = value.as<FieldValue::Object>()) {
      fields.insert(fields.end(), more->begin(), more->end());
    }
  }
  return fields;
}

void FieldTable::read(void* object, const FieldNode& node) const {
  for (const FieldRow& row : rows()) {
    if (!row.set) continue;
    if (row.name.empty()) {
      row.set(object, node, row);
    } else if (node.has(row.name) || !row.may_be_missing) {
      const FieldNode field = node[row.name];
      row.set(object, field, row);
      if (row.check) row.check(object, field);
    } else {
      node.keys();  // refuses what is no object
    }
  }
  if (content_->check) content_->check(object, node);
}

std::string FieldTable::csvHeader(const std::string& before, const char* end) const {
  std::string line;
  addNames(*this, before, line);
  line.pop_back();
  return line + end;
}

std::string FieldTable::csvLine(const void* object, const char* end) const {
  std::string line;
  addCells(
      *this, [object](const FieldRow& row) { return row.valueOf(object); }, line);
  line.pop_back();
  return line + end;
}

double readNumber(const FieldNode& node, const FieldRow& row) {
  const FieldNumber& number = row.number;
  const double value = number.limit > 0.0 ? node.within(number.limit, row.unit)
                       : number.known     ? node.number()
                                          : node.numberOrNan();
  if (!number.negative && value < 0.0) node.refuse("must not be negative");
  return value * number.internal_per_unit;
}

namespace detail {

FieldType listOf(FieldType item, Eigen::Index length) {
  FieldType list{FieldType::Kind::list};
  list.item.push_back(std::move(item));
  list.length = length > 0 ? static_cast<std::size_t>(length) : 0;
  return list;
}

FieldValue writeVector(const Eigen::VectorXd& values, const FieldRow& row) {
  FieldValue::List list;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    list.emplace_back(values[i] / row.number.internal_per_unit);
  return list;
}

FieldValue writeMatrix(const Eigen::MatrixXd& values, const FieldRow& row) {
  FieldValue::List list;
  for (Eigen::Index i = 0; i < values.rows(); ++i) list.push_back(writeVector(values.row(i), row));
  return list;
}

Eigen::VectorXd readVector(const FieldNode& node, const FieldRow& row, Eigen::Index size) {
  const std::vector<FieldNode> items =
      size > 0 ? node.items(static_cast<std::size_t>(size)) : node.items();
  Eigen::VectorXd values(static_cast<Eigen::Index>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = readNumber(items[i], row);
  return values;
}

Eigen::MatrixXd readMatrix(const FieldNode& node, const FieldRow& row) {
  const std::vector<FieldNode> rows = node.items();
  Eigen::MatrixXd values;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::VectorXd line = readVector(rows[i], row, i == 0 ? 0 : values.cols());
    if (i == 0) values.resize(static_cast<Eigen::Index>(rows.size()), line.size());
    values.row(static_cast<Eigen::Index>(i)) = line.transpose();
  }
  return values;
}

}  // namespace detail
}  // namespace pcl_als
