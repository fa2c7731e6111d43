// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::app {

template <typename T>
void CommandLine::add(const char* name, const char* help, const T& default_value) {
  auto* const value = boost::program_options::value<T>();
  if constexpr (std::is_floating_point_v<T>) {
    value->default_value(default_value, shortText(default_value));
  } else {
    value->default_value(default_value);
  }
  options_.add_options()(name, value, help);
}

template <typename T>
T CommandLine::get(const char* name) const {
  return values_[name].as<T>();
}

}  // namespace pcl_als::app
