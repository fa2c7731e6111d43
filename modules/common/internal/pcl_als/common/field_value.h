// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pcl_als {

/// A value of a result file: null, true or false, a number, a text, a list, or an object whose
/// fields keep their order.
class FieldValue {
 public:
  using List = std::vector<FieldValue>;
  using Object = std::vector<std::pair<std::string, FieldValue>>;
  using Content = std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double,
                               std::string, List, Object>;

  FieldValue() = default;  ///< null
  FieldValue(bool value) : content_(value) {}
  FieldValue(double value) {  ///< null where it is not finite
    if (std::isfinite(value)) content_ = value;
  }
  FieldValue(std::string value) : content_(std::move(value)) {}
  FieldValue(std::string_view value) : content_(std::string(value)) {}
  FieldValue(const char* value) : content_(std::string(value)) {}
  FieldValue(List value) : content_(std::move(value)) {}
  FieldValue(Object value) : content_(std::move(value)) {}
  /// Whole numbers of 0 and more are unsigned ones whatever their type, as those of a file.
  template <typename Whole, std::enable_if_t<std::is_integral_v<Whole>, int> = 0>
  FieldValue(Whole value) : content_(static_cast<std::uint64_t>(value)) {
    if constexpr (std::is_signed_v<Whole>)
      if (value < 0) content_ = static_cast<std::int64_t>(value);
  }

  const Content& content() const { return content_; }
  template <typename T>
  const T* as() const {
    return std::get_if<T>(&content_);
  }
  bool isNull() const { return content_.index() == 0; }
  /// Whether it is null, an empty text, an empty list or an empty object.
  bool isEmpty() const;
  /// The value of a field of an object; null pointer where there is none.
  const FieldValue* find(std::string_view key) const;
  /// Sets a field of an object, which null becomes; a new one is the last.
  void set(std::string_view key, FieldValue value);
  friend bool operator==(const FieldValue& a, const FieldValue& b) {
    return a.content_ == b.content_;
  }

 private:
  Content content_;
};

}  // namespace pcl_als
