// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/field_node.h>
#include <pcl_als/common/printable.h>

namespace pcl_als {

bool FieldValue::isEmpty() const {
  if (const auto* text = as<std::string>()) return text->empty();
  if (const auto* list = as<List>()) return list->empty();
  if (const auto* object = as<Object>()) return object->empty();
  return isNull();
}

const FieldValue* FieldValue::find(std::string_view key) const {
  const auto* object = as<Object>();
  if (object == nullptr) return nullptr;
  for (const auto& [name, value] : *object)
    if (name == key) return &value;
  return nullptr;
}

void FieldValue::set(std::string_view key, FieldValue value) {
  if (isNull()) content_ = Object();
  auto& object = std::get<Object>(content_);
  for (auto& [name, old] : object) {
    if (name != key) continue;
    old = std::move(value);
    return;
  }
  object.emplace_back(key, std::move(value));
}

void FieldNode::refuse(const std::string& what) const {
  throw InputError(file_ + ": " + (path_.empty() ? "" : "'" + path_ + "' ") + what);
}

void FieldNode::refuseText(const std::vector<std::string>& allowed) const {
  std::string choice;
  for (std::size_t i = 0; i < allowed.size(); ++i)
    choice += (i == 0 ? "" : i + 1 < allowed.size() ? ", " : " or ") + allowed[i];
  refuse("is '" + printable(text(), kLongestQuotation) + "'; it must be " + choice);
}

FieldNode FieldNode::operator[](const std::string& key) const {
  if (value_->as<FieldValue::Object>() == nullptr) refuse("must be an object");
  const std::string path = path_.empty() ? key : path_ + "." + key;
  const FieldValue* found = value_->find(key);
  if (found == nullptr) FieldNode(*value_, file_, path).refuse("is missing");
  return {*found, file_, path};
}

std::vector<std::string> FieldNode::keys() const {
  const auto* object = value_->as<FieldValue::Object>();
  if (object == nullptr) refuse("must be an object");
  std::vector<std::string> names;
  for (const auto& field : *object) names.push_back(field.first);
  return names;
}

std::vector<FieldNode> FieldNode::items() const {
  const auto* list = value_->as<FieldValue::List>();
  if (list == nullptr) refuse("must be a list");
  std::vector<FieldNode> nodes;
  nodes.reserve(list->size());
  for (std::size_t i = 0; i < list->size(); ++i)
    nodes.emplace_back((*list)[i], file_, path_ + "[" + std::to_string(i) + "]");
  return nodes;
}

std::vector<FieldNode> FieldNode::items(std::size_t count) const {
  std::vector<FieldNode> nodes = items();
  if (nodes.size() != count)
    refuse("must have " + std::to_string(count) + " values, has " + std::to_string(nodes.size()));
  return nodes;
}

double FieldNode::number() const {
  const auto* number = value_->as<double>();
  const auto* whole = value_->as<std::int64_t>();
  const auto* count = value_->as<std::uint64_t>();
  if (whole != nullptr) return static_cast<double>(*whole);
  if (count != nullptr) return static_cast<double>(*count);
  if (number == nullptr) refuse("must be a number");
  return *number;
}

double FieldNode::within(double limit, const std::string& unit) const {
  const double value = number();
  if (std::abs(value) <= limit) return value;
  std::ostringstream text;
  text << "is out of range: " << value << ' ' << unit << " is not between " << -limit << " and "
       << limit << ' ' << unit;
  refuse(text.str());
}

double FieldNode::numberOrNan() const {
  return isNull() ? std::numeric_limits<double>::quiet_NaN() : number();
}

std::size_t FieldNode::count() const {
  const auto* count = value_->as<std::uint64_t>();
  if (count == nullptr) refuse("must be a whole number, 0 or more");
  return *count;
}

long FieldNode::whole() const {
  if (const auto* count = value_->as<std::uint64_t>()) return static_cast<long>(*count);
  const auto* whole = value_->as<std::int64_t>();
  if (whole == nullptr) refuse("must be a whole number");
  return static_cast<long>(*whole);
}

bool FieldNode::truth() const {
  const auto* truth = value_->as<bool>();
  if (truth == nullptr) refuse("must be true or false");
  return *truth;
}

std::string FieldNode::text() const {
  const auto* text = value_->as<std::string>();
  if (text == nullptr) refuse("must be a text");
  return *text;
}

std::vector<std::string> FieldNode::texts() const {
  std::vector<std::string> texts;
  for (const FieldNode& node : items()) texts.push_back(node.text());
  return texts;
}

}  // namespace pcl_als
