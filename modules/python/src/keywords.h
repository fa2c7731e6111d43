// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pybind11/pybind11.h>

namespace pcl_als::python {

/// A constructor that takes the attributes of an object as keywords: Settings(threads=2). Names are
/// checked in _arguments.py.
template <typename T>
auto fromKeywords() {
  return pybind11::init([](const pybind11::kwargs& values) {
    T made;
    const pybind11::object self = pybind11::cast(&made, pybind11::return_value_policy::reference);
    for (const auto& [name, value] : values) pybind11::setattr(self, name, value);
    return made;
  });
}

}  // namespace pcl_als::python
