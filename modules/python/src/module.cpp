// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/stl.h>

#include <pcl_als/common/nearest_name.h>

#include "bindings.h"

namespace {

/// pybind11 allocates the value of an object that was made without __init__ when it is first used,
/// and leaves it uninitialised.
void* refuseAllocation(std::size_t /*size*/) {
  throw pybind11::type_error("this object was made without its __init__");
}

void refuseUninitialised(const pybind11::module_& m) {
  for (const auto& [name, value] : pybind11::dict(m.attr("__dict__"))) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* type = reinterpret_cast<PyTypeObject*>(value.ptr());
    if (pybind11::detail::type_info* info = pybind11::detail::get_type_info(type))
      info->operator_new = &refuseAllocation;
  }
}

}  // namespace

// The extension module that the package pcl_als imports; see pcl_als/__init__.py.
PYBIND11_MODULE(_pcl_als, m) {
  using namespace pcl_als::python;
  // Classes belong to the package, not to the extension inside it.
  const pybind11::object name = m.attr("__name__");
  m.attr("__name__") = "pcl_als";
  m.doc() = "Airborne LiDAR calibration and quality control.";
  m.attr("__version__") = PCL_ALS_VERSION;
  m.def("_nearest_name", &pcl_als::nearestName);  // for messages on misspelled arguments
  bindErrors(m);
  bindProgress(m);
  bindPoints(m);
  bindSurvey(m);
  bindFiles(m);
  bindCalibrationResult(m);
  bindTrajectory(m);
  bindCalibration(m);
  bindCorrection(m);
  bindCheck(m);
  bindRegistration(m);
  bindIntensity(m);
  bindWaveforms(m);
  bindClassification(m);
  bindPlanning(m);
  bindSimulation(m);
  bindPhotogrammetry(m);
  m.attr("__name__") = name;
  refuseUninitialised(m);
}
