// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/field_table.h>

namespace pcl_als {

/// Values by names that a table does not have: an object of a file, in this order.
template <typename V>
using NamedValues = std::vector<std::pair<std::string, V>>;

/// The names of the values of an enumeration in files.
template <typename E>
class FieldNames {
 public:
  FieldNames(std::string_view (*name)(E), std::initializer_list<E> all) {
    for (const E value : all) names_.emplace_back(value, name(value));
  }
  FieldNames(const char* (*name)(E), std::initializer_list<E> all) {
    for (const E value : all) names_.emplace_back(value, name(value));
  }
  FieldNames(std::initializer_list<std::pair<E, std::string>> names) : names_(names) {}

  FieldType type() const {
    FieldType type{FieldType::Kind::text};
    for (const auto& name : names_) type.choices.push_back(name.second);
    return type;
  }
  FieldValue write(E value, const FieldRow& /*row*/) const {
    for (const auto& [known, name] : names_)
      if (known == value) return name;
    return {};
  }
  void read(E& value, const FieldNode& node, const FieldRow& /*row*/) const {
    const std::string text = node.text();
    for (const auto& [known, name] : names_) {
      if (name != text) continue;
      value = known;
      return;
    }
    node.refuseText(type().choices);
  }

 private:
  std::vector<std::pair<E, std::string>> names_;
};

namespace detail {

template <typename V>
struct IsOptional : std::false_type {};
template <typename V>
struct IsOptional<std::optional<V>> : std::true_type {};
template <typename V>
struct IsList : std::false_type {};
template <typename V>
struct IsList<std::vector<V>> : std::true_type {};
template <typename V>
struct IsNamed : std::false_type {};
template <typename V>
struct IsNamed<NamedValues<V>> : std::true_type {};
template <typename V>
struct IsNamed<std::map<std::string, V>> : std::true_type {};
template <typename V>
inline constexpr bool kIsMatrix = std::is_base_of_v<Eigen::EigenBase<V>, V>;

FieldValue writeMatrix(const Eigen::MatrixXd& values, const FieldRow& row);
FieldValue writeVector(const Eigen::VectorXd& values, const FieldRow& row);
Eigen::MatrixXd readMatrix(const FieldNode& node, const FieldRow& row);
Eigen::VectorXd readVector(const FieldNode& node, const FieldRow& row, Eigen::Index size);
FieldType listOf(FieldType item, Eigen::Index length = 0);

/// Numbers, texts and truth values.
struct PlainField {
  template <typename V>
  static FieldType typeOf() {
    using Kind = FieldType::Kind;
    if constexpr (std::is_same_v<V, bool>)
      return {Kind::truth};
    else if constexpr (std::is_floating_point_v<V>)
      return {Kind::number, true};
    else if constexpr (std::is_integral_v<V>)
      return {std::is_signed_v<V> ? Kind::whole : Kind::count};
    else if constexpr (std::is_same_v<V, FieldValue>)
      return {};
    else
      return {Kind::text};
  }
  template <typename V>
  FieldValue write(const V& value, const FieldRow& row) const {
    if constexpr (std::is_floating_point_v<V>)
      return static_cast<double>(value) / row.number.internal_per_unit;
    else
      return value;
  }
  template <typename V>
  void read(V& value, const FieldNode& node, const FieldRow& row) const {
    if constexpr (std::is_same_v<V, bool>)
      value = node.truth();
    else if constexpr (std::is_floating_point_v<V>)
      value = readNumber(node, row);
    else if constexpr (std::is_integral_v<V> && std::is_signed_v<V>)
      value = static_cast<V>(node.whole());
    else if constexpr (std::is_integral_v<V>)
      value = static_cast<V>(node.count());
    else if constexpr (std::is_same_v<V, std::string>)
      value = node.text();
    else
      node.refuse("cannot be read");
  }
};

// A value, an optional one, a list, or values by name, whose single values a leaf writes and reads.
template <typename V, typename Leaf>
FieldType typeOf(const Leaf& leaf) {
  if constexpr (IsOptional<V>::value) {
    FieldType type = typeOf<typename V::value_type>(leaf);
    type.nullable = true;
    return type;
  } else if constexpr (IsNamed<V>::value) {
    FieldType type{FieldType::Kind::object};
    type.item.push_back(typeOf<typename V::value_type::second_type>(leaf));
    return type;
  } else if constexpr (IsList<V>::value) {
    return listOf(typeOf<typename V::value_type>(leaf));
  } else if constexpr (kIsMatrix<V> && std::is_same_v<Leaf, PlainField>) {
    const FieldType number{FieldType::Kind::number, true};
    if constexpr (V::ColsAtCompileTime == 1)
      return listOf(number, V::RowsAtCompileTime);
    else
      return listOf(listOf(number, V::ColsAtCompileTime), V::RowsAtCompileTime);
  } else if constexpr (std::is_same_v<Leaf, PlainField>) {
    return PlainField::typeOf<V>();
  } else {
    return leaf.type();
  }
}

template <typename V, typename Leaf>
FieldValue toValue(const V& value, const Leaf& leaf, const FieldRow& row) {
  if constexpr (IsOptional<V>::value) {
    return value ? toValue(*value, leaf, row) : FieldValue();
  } else if constexpr (IsNamed<V>::value) {
    FieldValue::Object object;
    for (const auto& [name, item] : value) object.emplace_back(name, toValue(item, leaf, row));
    return object;
  } else if constexpr (IsList<V>::value) {
    FieldValue::List list;
    list.reserve(value.size());
    for (const typename V::value_type& item : value) list.push_back(toValue(item, leaf, row));
    return list;
  } else if constexpr (kIsMatrix<V> && std::is_same_v<Leaf, PlainField>) {
    if constexpr (V::ColsAtCompileTime == 1)
      return writeVector(value, row);
    else
      return writeMatrix(value, row);
  } else {
    return leaf.write(value, row);
  }
}

template <typename V, typename Leaf>
void fromNode(V& value, const Leaf& leaf, const FieldNode& node, const FieldRow& row) {
  if constexpr (IsOptional<V>::value) {
    typename V::value_type read{};
    if (!node.isNull()) fromNode(read, leaf, node, row);
    value = node.isNull() ? V() : V(std::move(read));
  } else if constexpr (IsNamed<V>::value) {
    value.clear();
    for (const std::string& key : node.keys()) {
      typename V::value_type::second_type read{};
      fromNode(read, leaf, node[key], row);
      value.insert(value.end(), {key, std::move(read)});
    }
  } else if constexpr (IsList<V>::value) {
    value.clear();
    for (const FieldNode& item : node.items()) {
      typename V::value_type read{};
      fromNode(read, leaf, item, row);
      value.push_back(std::move(read));
    }
  } else if constexpr (kIsMatrix<V> && std::is_same_v<Leaf, PlainField>) {
    if constexpr (V::ColsAtCompileTime == 1)
      value = readVector(node, row, V::RowsAtCompileTime);
    else
      value = readMatrix(node, row);
  } else {
    leaf.read(value, node, row);
  }
}

}  // namespace detail

template <typename T>
class Fields;

/// \brief A field of a struct S.
///
/// \a access is a pointer to a member or to a const member function, or a function of a const S&; a
/// field can be read if it returns a reference to a variable, as `[](auto& s) -> auto& { … }` does.
/// Values may be truth values, whole and real numbers, texts, Eigen's vectors and matrices, values
/// of an enumeration with its FieldNames, objects with their Fields, and std::optional,
/// std::vector, NamedValues and std::map (by name) of these. Options are those of namespace field.
template <typename S>
class Field : public FieldRow {
 public:
  using Object = S;

  template <typename Access, typename... Options>
  Field(const std::string& field, Access access, const char* what, const Options&... options) {
    bind(field, std::move(access), detail::PlainField(), what);
    (options(*this), ...);
  }
  template <typename Access, typename E, typename... Options>
  Field(const std::string& field, Access access, FieldNames<E> names, const char* what,
        const Options&... options) {
    bind(field, std::move(access), std::move(names), what);
    (options(*this), ...);
  }
  template <typename Access, typename T, typename... Options>
  Field(const std::string& field, Access access, Fields<T> fields, const char* what,
        const Options&... options) {
    bind(field, std::move(access), std::move(fields), what);
    (options(*this), ...);
  }
  /// The same value in all files.
  static Field constant(const char* field, FieldValue value, const char* what) {
    Field row(
        field, [value](const S& /*object*/) { return value; }, what);
    row.is_constant = true;
    return row;
  }
  /// The fields of \a fields as fields of this object.
  template <typename Access, typename T, typename... Options>
  static Field all(Access access, Fields<T> fields, const Options&... options) {
    return Field("", std::move(access), std::move(fields), "", options...);
  }

 private:
  template <typename Access, typename Leaf>
  void bind(const std::string& field, Access access, Leaf leaf, const char* what) {
    using Result = std::invoke_result_t<const Access&, S&>;
    using Value = std::decay_t<std::invoke_result_t<const Access&, const S&>>;
    name = field;
    meaning = what;
    type = detail::typeOf<Value>(leaf);
    if constexpr (std::is_lvalue_reference_v<Result> &&
                  !std::is_const_v<std::remove_reference_t<Result>>) {
      set = [access, leaf](void* object, const FieldNode& node, const FieldRow& row) {
        detail::fromNode(std::invoke(access, *static_cast<S*>(object)), leaf, node, row);
      };
    }
    get = [access = std::move(access), leaf = std::move(leaf)](const void* object,
                                                               const FieldRow& row) {
      return detail::toValue(std::invoke(access, *static_cast<const S*>(object)), leaf, row);
    };
  }
};

/// Options of fields.
namespace field {

/// Value in the program = value in the file times this.
inline auto in(double internal_per_unit) {
  return [=](FieldRow& row) { row.number.internal_per_unit = internal_per_unit; };
}
/// The unit, where the name does not end in it.
inline auto of(std::string_view unit) {
  return [=](FieldRow& row) { row.unit = unit; };
}
/// What the values are, where their type in the program does not tell.
inline auto is(FieldType type) {
  return [=](FieldRow& row) { row.type = type; };
}
inline auto oneOf(std::vector<std::string> choices) {
  return is({FieldType::Kind::text, false, std::move(choices)});
}
/// Null unless this holds: a function or member of the object.
template <typename Condition>
auto knownIf(Condition condition) {
  return [condition](auto& row) {
    using S = typename std::decay_t<decltype(row)>::Object;
    row.type.nullable = true;
    row.known = [condition](const void* object) -> bool {
      return std::invoke(condition, *static_cast<const S*>(object));
    };
  };
}
/// The field is omitted unless this holds. When a file is read, the field may be missing.
template <typename Condition>
auto onlyIf(Condition condition) {
  return [condition](auto& row) {
    using S = typename std::decay_t<decltype(row)>::Object;
    row.may_be_missing = true;
    row.present = [condition](const void* object) -> bool {
      return std::invoke(condition, *static_cast<const S*>(object));
    };
  };
}
/// The field is omitted if it is null or an empty text, list or object.
inline void unlessEmpty(FieldRow& row) {
  row.unless_empty = row.may_be_missing = true;
}
/// Files of earlier versions and those made by hand may do without it.
inline void mayBeMissing(FieldRow& row) {
  row.may_be_missing = true;
}
/// Never null, also when it is read.
inline void alwaysKnown(FieldRow& row) {
  row.number.known = true;
}
/// Never null, and not larger than this (units of the file) when it is read.
inline auto within(double limit) {
  return [=](FieldRow& row) {
    row.number.limit = limit;
    row.number.known = true;
  };
}
inline void notNegative(FieldRow& row) {
  row.number.negative = false;
}
/// How it is read, where that differs from the way it is written.
template <typename Read>
auto reads(Read read) {
  return [read](auto& row) {
    using S = typename std::decay_t<decltype(row)>::Object;
    row.set = [read](void* object, const FieldNode& node, const FieldRow& /*row*/) {
      read(*static_cast<S*>(object), node);
    };
  };
}
/// A condition on the object and the node of the field, once the field was read.
template <typename Condition>
auto checked(Condition condition) {
  return [condition](auto& row) {
    using S = typename std::decay_t<decltype(row)>::Object;
    row.check = [condition](const void* object, const FieldNode& node) {
      condition(*static_cast<const S*>(object), node);
    };
  };
}
/// A column of CSV files, with decimals; of an object: what the names of its columns begin with.
inline auto csv(const char* name, int decimals = -1) {
  return [=](FieldRow& row) {
    row.is_column = true;
    row.column = name;
    row.digits = decimals;
  };
}
/// A column with the name of the field.
inline auto csv(int decimals) {
  return [=](FieldRow& row) { csv(row.name.c_str(), decimals)(row); };
}

}  // namespace field

/// The fields of a struct S, with the functions of FieldTable for it.
template <typename T>
class Fields : public FieldTable {
 public:
  Fields(std::string name, std::string meaning, std::initializer_list<Field<T>> fields)
      : FieldTable(std::move(name), std::move(meaning), {fields.begin(), fields.end()}) {}
  Fields(std::string name, std::string meaning, const std::vector<Field<T>>& fields)
      : FieldTable(std::move(name), std::move(meaning), {fields.begin(), fields.end()}) {}

  Fields&& checked(std::function<void(const T&, const FieldNode&)> condition) && {
    setCheck([condition](const void* object, const FieldNode& node) {
      condition(*static_cast<const T*>(object), node);
    });
    return std::move(*this);
  }
  FieldType type() const { return {FieldType::Kind::object, false, {}, {*this}}; }
  FieldValue write(const T& object) const { return FieldTable::write(&object); }
  FieldValue write(const T& object, const FieldRow& /*row*/) const { return write(object); }
  void read(T& object, const FieldNode& node) const { FieldTable::read(&object, node); }
  void read(T& object, const FieldNode& node, const FieldRow& /*row*/) const { read(object, node); }
  std::string csvLine(const T& object, const char* end = "\n") const {
    return FieldTable::csvLine(&object, end);
  }
};

/// Access to the object itself, for objects in a file that are none in the program.
inline constexpr auto kSameObject = [](auto& object) -> auto& {
  return object;
};

}  // namespace pcl_als
