// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <stdexcept>

#include <pcl_als/common/field_table.h>

namespace pcl_als {
namespace {

using Kind = FieldType::Kind;

void setType(FieldValue& schema, const char* type, bool nullable) {
  if (nullable)
    schema.set("type", FieldValue::List{type, "null"});
  else
    schema.set("type", type);
}

/// Makes the schema of a file, with one definition for each table.
class SchemaWriter {
 public:
  FieldValue objectOf(const FieldTable& table) {
    FieldValue schema, properties;
    FieldValue::List required;
    addFields(table, true, properties, required);
    schema.set("description", table.meaning());
    schema.set("type", "object");
    schema.set("properties", std::move(properties));
    if (!required.empty()) schema.set("required", std::move(required));
    return schema;
  }
  FieldValue definitions() const { return definitions_; }

 private:
  void addFields(const FieldTable& table, bool always, FieldValue& properties,
                 FieldValue::List& required) {
    for (const FieldRow& row : table.rows()) {
      const bool present = always && !row.mayBeAbsent();
      if (row.name.empty()) {
        addFields(row.type.table.front(), present, properties, required);
        continue;
      }
      FieldValue schema = valueOf(row.type, row);
      if (!row.meaning.empty()) schema.set("description", row.meaning);
      if (!row.unit.empty()) schema.set("unit", row.unit);
      properties.set(row.name, std::move(schema));
      if (present) required.emplace_back(row.name);
    }
  }

  /// The definition of a table; two tables of one name must be the same.
  FieldValue referenceTo(const FieldTable& table) {
    FieldValue schema = objectOf(table);
    const FieldValue* known = definitions_.find(table.name());
    if (known != nullptr && !(*known == schema))
      throw std::logic_error("two tables of fields have the name " + table.name());
    definitions_.set(table.name(), std::move(schema));
    FieldValue reference;
    reference.set("$ref", "#/$defs/" + table.name());
    return reference;
  }

  FieldValue valueOf(const FieldType& type, const FieldRow& row) {
    FieldValue schema;
    if (row.is_constant) {
      schema.set("const", row.get(nullptr, row));
    } else if (type.kind == Kind::list) {
      setType(schema, "array", type.nullable);
      if (!type.item.empty()) schema.set("items", valueOf(type.item.front(), row));
      if (type.length > 0) schema.set("minItems", type.length);
      if (type.length > 0) schema.set("maxItems", type.length);
    } else if (type.kind == Kind::object) {
      if (!type.table.empty())
        schema = nullable(referenceTo(type.table.front()), type.nullable);
      else
        setType(schema, "object", type.nullable);
      if (!type.item.empty()) schema.set("additionalProperties", valueOf(type.item.front(), row));
    } else if (!type.choices.empty()) {
      FieldValue::List names(type.choices.begin(), type.choices.end());
      if (type.nullable) names.emplace_back();
      schema.set("enum", std::move(names));
    } else if (type.kind != Kind::any) {
      addSimple(type, row, schema);
    } else {
      schema = FieldValue::Object();
    }
    return schema;
  }

  static FieldValue nullable(FieldValue reference, bool nullable) {
    if (!nullable) return reference;
    FieldValue null, either;
    null.set("type", "null");
    either.set("anyOf", FieldValue::List{std::move(reference), std::move(null)});
    return either;
  }

  static void addSimple(const FieldType& type, const FieldRow& row, FieldValue& schema) {
    const char* const name = type.kind == Kind::truth    ? "boolean"
                             : type.kind == Kind::text   ? "string"
                             : type.kind == Kind::number ? "number"
                                                         : "integer";
    setType(schema, name, type.nullable);
    const bool positive = type.kind == Kind::number && !row.number.negative;
    if (type.kind == Kind::count || positive) schema.set("minimum", 0);
    if (type.kind != Kind::number || row.number.limit <= 0.0) return;
    if (!positive) schema.set("minimum", -row.number.limit);
    schema.set("maximum", row.number.limit);
  }

  FieldValue definitions_;
};

/// The tables of a file, each once, in the order of their use.
void collect(const FieldTable& table, std::vector<FieldTable>& found);
void collect(const FieldType& type, std::vector<FieldTable>& found) {
  for (const FieldType& item : type.item) collect(item, found);
  for (const FieldTable& table : type.table) {
    const auto same = [&](const FieldTable& other) { return other.name() == table.name(); };
    if (std::any_of(found.begin(), found.end(), same)) continue;
    found.push_back(table);
    collect(table, found);
  }
}
void collect(const FieldTable& table, std::vector<FieldTable>& found) {
  for (const FieldRow& row : table.rows()) {
    if (row.name.empty())
      collect(row.type.table.front(), found);
    else
      collect(row.type, found);
  }
}

std::string typeText(const FieldType& type, const std::string& file) {
  std::string text;
  switch (type.kind) {
    case Kind::any:
      break;
    case Kind::truth:
      text = "true or false";
      break;
    case Kind::whole:
    case Kind::count:
      text = "whole number";
      break;
    case Kind::number:
      text = "number";
      break;
    case Kind::text:
      text = type.choices.empty() ? "text" : "";
      for (const std::string& choice : type.choices)
        text += (text.empty() ? "`" : ", `") + choice + "`";
      break;
    case Kind::list:
      text = type.length > 0 ? "list of " + std::to_string(type.length) : "list of";
      text += ": " + (type.item.empty() ? "" : typeText(type.item.front(), file));
      break;
    case Kind::object:
      text = "object";
      for (const FieldTable& table : type.table)
        text = "[" + table.name() + "](#" + file + "-" + table.name() + ")";
      if (!type.item.empty()) text = "by name: " + typeText(type.item.front(), file);
      break;
  }
  return type.nullable ? text + " or null" : text;
}

/// Lines of at most 95 characters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kLongest = 95;
  std::string lines = text;
  for (std::size_t from = 0; lines.size() - from > kLongest;) {
    const std::size_t blank = lines.rfind(' ', from + kLongest);
    if (blank == std::string::npos || blank < from) break;
    lines[blank] = '\n';
    from = blank + 1;
  }
  return lines;
}

void addRows(const FieldTable& table, bool always, const std::string& file, std::string& text) {
  for (const FieldRow& row : table.rows()) {
    const bool present = always && !row.mayBeAbsent();
    if (row.name.empty()) {
      addRows(row.type.table.front(), present, file, text);
      continue;
    }
    const std::string* constant = nullptr;
    const FieldValue value = row.is_constant ? row.get(nullptr, row) : FieldValue();
    constant = value.as<std::string>();
    text += "| `" + row.name + "` | " +
            (constant != nullptr ? '"' + *constant + '"' : typeText(row.type, file)) +
            (present ? "" : ", optional") + " | " + row.unit + " | " + row.meaning + " |\n";
  }
}

}  // namespace

FieldValue schemaOf(const FieldTable& table, const std::string& file) {
  SchemaWriter writer;
  FieldValue schema;
  schema.set("$schema", "https://json-schema.org/draft/2020-12/schema");
  schema.set("title", file);
  const FieldValue object = writer.objectOf(table);
  for (const auto& [key, value] : *object.as<FieldValue::Object>()) schema.set(key, value);
  if (!writer.definitions().isNull()) schema.set("$defs", writer.definitions());
  return schema;
}

std::string referenceOf(const FieldTable& table, const std::string& file) {
  std::vector<FieldTable> tables{table};
  collect(table, tables);
  std::string text;
  for (const FieldTable& each : tables) {
    const bool first = &each == tables.data();
    text += (first ? "## " + file : "### " + file + ": " + each.name()) + "\n\n" +
            wrapped(each.meaning()) + "\n\n| Key | Value | Unit | Meaning |\n|---|---|---|---|\n";
    addRows(each, true, file, text);
    text += '\n';
  }
  return text;
}

}  // namespace pcl_als
