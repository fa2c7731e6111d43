// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

namespace pcl_als::python {

/** \brief Binds a struct that jobs return: its members as attributes that are read-only, and
 * pickling (of which copies are made, too) of the same members.
 *
 * \code
 * Record<PairFit>(m, "PairFit", "…").field("a", &PairFit::a).field("b", &PairFit::b).bind();
 * \endcode
 */
template <typename T>
class Record {
 public:
  using Class = pybind11::class_<T, std::shared_ptr<T>>;

  Record(pybind11::module_& m, const char* name, const char* text) : class_(m, name, text) {}

  /// A member that is an attribute.
  template <typename M>
  Record& field(const char* name, M T::*member, const char* text = "") {
    class_.def_property_readonly(
        name, [member](const T& value) { return M(value.*member); }, text);
    return state(member);
  }

  /// A member that is no attribute itself.
  template <typename M>
  Record& state(M T::*member) {
    if constexpr (std::is_enum_v<M>) {
      members_.emplace_back(
          [member](const T& value) {
            return pybind11::object(pybind11::int_(static_cast<int>(value.*member)));
          },
          [member](T& value, const pybind11::handle& from) {
            value.*member = static_cast<M>(from.cast<int>());
          });
    } else {
      members_.emplace_back(
          [member](const T& value) { return pybind11::cast(value.*member); },
          [member](T& value, const pybind11::handle& from) { value.*member = from.cast<M>(); });
    }
    return *this;
  }

  /// An attribute that follows from members.
  template <typename Get>
  Record& property(const char* name, Get&& get, const char* text = "") {
    class_.def_property_readonly(name, std::forward<Get>(get), text);
    return *this;
  }

  /// Ends the list of members.
  Class& bind() {
    const auto members = members_;
    class_.def(pybind11::pickle(
        [members](const T& value) {
          pybind11::list values;
          for (const auto& [get, set] : members) values.append(get(value));
          return pybind11::tuple(values);
        },
        [members](const pybind11::tuple& values) {
          if (values.size() != members.size())
            throw pybind11::value_error("pickled by another version of pcl_als");
          auto made = std::make_shared<T>();
          try {
            std::size_t i = 0;
            for (const auto& [get, set] : members) set(*made, values[i++]);
          } catch (const pybind11::cast_error&) {
            throw pybind11::value_error("pickled by another version of pcl_als");
          }
          return made;
        }));
    return class_;
  }

 private:
  using Get = std::function<pybind11::object(const T&)>;
  using Set = std::function<void(T&, const pybind11::handle&)>;

  Class class_;
  std::vector<std::pair<Get, Set>> members_;
};

}  // namespace pcl_als::python
