// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pybind11/pybind11.h>

// The parts of the module, in the order in which they refer to each other.
namespace pcl_als::python {

void bindErrors(pybind11::module_& m);
void bindProgress(pybind11::module_& m);
void bindPoints(pybind11::module_& m);
void bindSurvey(pybind11::module_& m);
void bindFiles(pybind11::module_& m);
void bindTrajectory(pybind11::module_& m);
void bindCalibrationResult(pybind11::module_& m);
void bindCalibration(pybind11::module_& m);
void bindCorrection(pybind11::module_& m);
void bindCheck(pybind11::module_& m);
void bindRegistration(pybind11::module_& m);
void bindIntensity(pybind11::module_& m);
void bindWaveforms(pybind11::module_& m);
void bindClassification(pybind11::module_& m);
void bindPlanning(pybind11::module_& m);
void bindSimulation(pybind11::module_& m);
void bindPhotogrammetry(pybind11::module_& m);

}  // namespace pcl_als::python
