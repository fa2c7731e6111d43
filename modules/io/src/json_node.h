// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {

/// A value of the file with the way to it, so that a message can say "parameters.range_bias.unit".
class JsonNode {
 public:
  JsonNode(const nlohmann::json& json, std::string file, std::string path = {})
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(file_ + ": " + (path_.empty() ? "" : "'" + path_ + "' ") + what);
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  JsonNode operator[](const std::string& key) const {
    if (!json_->is_object()) refuse("must be an object");
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (!json_->contains(key)) JsonNode(*json_, file_, path).refuse("is missing");
    return {(*json_)[key], file_, path};
  }
  std::vector<JsonNode> items() const {
    if (!json_->is_array()) refuse("must be a list");
    std::vector<JsonNode> nodes;
    for (std::size_t i = 0; i < json_->size(); ++i) {
      nodes.emplace_back((*json_)[i], file_, path_ + "[" + std::to_string(i) + "]");
    }
    return nodes;
  }
  double number() const {
    if (!json_->is_number()) refuse("must be a number");
    const double value = json_->get<double>();
    if (!std::isfinite(value)) refuse("must be a finite number");
    return value;
  }
  double within(double limit, const char* unit) const {
    const double value = number();
    if (std::abs(value) <= limit) return value;
    std::ostringstream text;
    text << "is out of range: " << value << ' ' << unit << " is not between " << -limit << " and "
         << limit << ' ' << unit;
    refuse(text.str());
  }
  double numberOrNan() const {
    return json_->is_null() ? std::numeric_limits<double>::quiet_NaN() : number();
  }
  std::size_t count() const {
    if (!json_->is_number_unsigned()) refuse("must be a whole number, 0 or more");
    return json_->get<std::size_t>();
  }
  long whole() const {
    if (!json_->is_number_integer()) refuse("must be a whole number");
    return json_->get<long>();
  }
  bool truth() const {
    if (!json_->is_boolean()) refuse("must be true or false");
    return json_->get<bool>();
  }
  std::string text() const {
    if (!json_->is_string()) refuse("must be a text");
    return json_->get<std::string>();
  }

 private:
  const nlohmann::json* json_;
  std::string file_, path_;
};

}  // namespace pcl_als::detail
