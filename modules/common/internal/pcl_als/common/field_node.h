// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <pcl_als/common/field_value.h>

namespace pcl_als {

/// A value of a file with the way to it, so that a message can say "parameters.range_bias.unit".
/// All functions throw InputError where the value is not what they return.
class FieldNode {
 public:
  /// \param value outlives the node
  FieldNode(const FieldValue& value, std::string file, std::string path = {})
      : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void refuse(const std::string& what) const;
  /// Refuses a text: "is 'vague'; it must be a, b or c".
  [[noreturn]] void refuseText(const std::vector<std::string>& allowed) const;

  const FieldValue& value() const { return *value_; }
  bool isNull() const { return value_->isNull(); }
  bool has(std::string_view key) const { return value_->find(key) != nullptr; }
  FieldNode operator[](const std::string& key) const;
  std::vector<std::string> keys() const;
  std::vector<FieldNode> items() const;
  /// The items of a list that must have \a count of them.
  std::vector<FieldNode> items(std::size_t count) const;

  double number() const;
  /// A number of at most this absolute value.
  double within(double limit, const std::string& unit) const;
  double numberOrNan() const;
  std::size_t count() const;
  long whole() const;
  bool truth() const;
  std::string text() const;
  std::vector<std::string> texts() const;

 private:
  const FieldValue* value_;
  std::string file_, path_;
};

}  // namespace pcl_als
