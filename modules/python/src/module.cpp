// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "bindings.h"

// The extension module that the package pcl_als imports; see pcl_als/__init__.py.
PYBIND11_MODULE(_pcl_als, m) {
  using namespace pcl_als::python;
  // Classes belong to the package, not to the extension inside it.
  const pybind11::object name = m.attr("__name__");
  m.attr("__name__") = "pcl_als";
  m.doc() = "Airborne LiDAR calibration and quality control.";
  m.attr("__version__") = PCL_ALS_VERSION;
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
  bindClassification(m);
  bindPlanning(m);
  bindSimulation(m);
  bindPhotogrammetry(m);
  m.attr("__name__") = name;
}
