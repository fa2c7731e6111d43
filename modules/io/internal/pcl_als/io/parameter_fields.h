// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/fields.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// Gives the element of a system parameter, of values that are indexed by SystemParameter.
class ParameterElement {
 public:
  explicit ParameterElement(SystemParameter parameter) : index_(indexOf(parameter)) {}
  template <typename Values>
  auto& operator()(Values& values) const {
    return values[index_];
  }

 private:
  int index_;
};

/// A table with a field for each system parameter, which \a make returns for its
/// SystemParameterInfo.
template <typename S, typename Make>
Fields<S> fieldsByParameter(std::string name, std::string meaning, Make make) {
  std::vector<Field<S>> rows;
  for (const SystemParameterInfo& info : systemParameters()) rows.push_back(make(info));
  return {std::move(name), std::move(meaning), rows};
}

/// Standard deviations of the system parameters that are known (finite), each in its unit.
const Fields<SystemVector>& deviationFields();

/// The states of an estimate of a parameter.
const FieldNames<ParameterStatus>& parameterStatusNames();

/// The unit of an object, which must be that one.
template <typename S>
Field<S> unitField(std::string_view unit) {
  return Field<S>(
      "unit", [unit](const S& /*object*/) { return unit; }, "Unit of its values",
      field::oneOf({std::string(unit)}), field::reads([unit](S& /*object*/, const FieldNode& node) {
        if (node.text() != unit) node.refuseText({std::string(unit)});
      }));
}

/// The version of pcl_als.
std::string_view toolVersion();

/// The version of pcl_als that wrote a result file.
template <typename S>
Field<S> toolVersionField() {
  return Field<S>(
      "tool_version", [](const S& /*object*/) { return toolVersion(); }, "Version of pcl_als");
}

}  // namespace pcl_als
