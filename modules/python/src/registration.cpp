// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/processing/file_motion.h>
#include <pcl_als/processing/pair_alignment.h>
#include <pcl_als/registration/iterative_closest_patch.h>
#include <pcl_als/report/alignment_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using StripArgument = std::variant<std::shared_ptr<LidarStrip>, std::filesystem::path>;

/// A result with the names of its strips.
struct Alignment {
  PatchAlignmentResult result;
  AlignedStrips strips;
};

Eigen::VectorXd valuesOf(const PatchAlignmentResult& result) {
  Eigen::VectorXd values(6);
  values << result.motion.shift, result.motion.rotation;
  return values;
}

Eigen::VectorXd deviationsOf(const PatchAlignmentResult& result) {
  Eigen::VectorXd values(6);
  for (int i = 0; i < 6; ++i)
    values[i] = result.parameters[i].determined ? result.standardDeviation(i)
                                                : std::numeric_limits<double>::quiet_NaN();
  return values;
}

void bindAlignment(py::module_& m) {
  py::class_<Alignment, std::shared_ptr<Alignment>>(
      m, "Alignment",
      "The rigid motion of a source onto a target, about the centroid of their overlap. Order of "
      "parameters: XT, YT, ZT (m), omega, phi, kappa (rad).")
      .def_property_readonly("converged",
                             [](const Alignment& a) { return a.result.hasConverged(); })
      .def_property_readonly(
          "reliable",
          [](const Alignment& a) { return a.result.hasConverged() && a.result.allDetermined(); },
          "converged, and every parameter is determined")
      .def_property_readonly(
          "reason", [](const Alignment& a) { return unreliability(a.result); },
          "why the result is not reliable; empty where it is")
      .def_property_readonly(
          "values", [](const Alignment& a) { return valuesOf(a.result); }, "the six parameters")
      .def_property_readonly(
          "std", [](const Alignment& a) { return deviationsOf(a.result); },
          "their standard deviations; NaN: not determined")
      .def_property_readonly(
          "covariance", [](const Alignment& a) { return Eigen::MatrixXd(a.result.covariance); },
          "6 x 6; m^2, m rad, rad^2")
      .def_property_readonly(
          "transformation",
          [](const Alignment& a) {
            return Eigen::Matrix4d(a.result.motion.transformation().matrix());
          },
          "4 x 4, from source to target, ground frame")
      .def_property_readonly("scale", [](const Alignment& a) { return a.result.motion.scale; })
      .def_property_readonly(
          "sigma0", [](const Alignment& a) { return a.result.sigma0; }, "m")
      .def_property_readonly("pairs", [](const Alignment& a) { return a.result.pairs; })
      .def_property_readonly(
          "rms_before", [](const Alignment& a) { return a.result.normal_before.rms; },
          "normal distances with the initial motion, m")
      .def_property_readonly(
          "rms_after", [](const Alignment& a) { return a.result.normal_after.rms; },
          "normal distances with the estimated motion, m")
      .def(
          "to_dict",
          [](const Alignment& a) { return parsedJson(alignmentJson(a.result, a.strips)); },
          "The content of the result file of pcl_als_icpatch as dictionaries and lists.")
      .def("__str__", [](const Alignment& a) { return alignmentTable(a.result); });
}

void bindSettings(py::module_& m) {
  using Settings = PatchAlignmentSettings;
  py::class_<Settings>(m, "AlignmentSettings",
                       "Settings of ICPatch; attributes may be given as keywords.")
      .def(fromKeywords<Settings>())
      .def_readwrite("search_distance", &Settings::search_distance,
                     "largest distance of the surfaces at the start, m")
      .def_readwrite("estimate_scale", &Settings::estimate_scale)
      .def_readwrite("points", &Settings::points, "triangulated points of each strip")
      .def_readwrite("pairs", &Settings::pairs, "candidates in each direction")
      .def_readwrite("maximum_iterations", &Settings::maximum_iterations)
      .def_readwrite("determined_std", &Settings::determined_std,
                     "above, a parameter is not determined; m at the radius of the overlap")
      .def_readwrite("threads", &Settings::threads);
}

Alignment alignStrips(const LidarStrip& source, const LidarStrip& target,
                      const PatchAlignmentSettings& settings) {
  IterativeClosestPatch<PointLidar, PointLidar> icpatch;
  icpatch.setInputSource(source.cloud);
  icpatch.setInputTarget(target.cloud);
  icpatch.setFrames(source.frame, target.frame);
  icpatch.setMaxCorrespondenceDistance(settings.search_distance);
  icpatch.setMaximumIterations(settings.maximum_iterations);
  icpatch.setEstimateScale(settings.estimate_scale);
  icpatch.setMaximumPoints(settings.points);
  icpatch.setMaximumPairs(settings.pairs);
  icpatch.setDeterminedStandardDeviation(settings.determined_std);
  icpatch.setNumberOfThreads(settings.threads);
  pcl::PointCloud<PointLidar> aligned;
  icpatch.align(aligned);
  return {icpatch.getResult(),
          {source.id, target.id, source.cloud->size(), target.cloud->size(), {}}};
}

Alignment alignFiles(const std::filesystem::path& source, const std::filesystem::path& target,
                     const PatchAlignmentSettings& settings, const ProgressCallback& report) {
  const AlignmentPair pair = filePair({source, target}, std::nullopt);
  const PairAlignment made = alignPair(pair, settings, report);
  return {made.result,
          {pair.source.name(), pair.target.name(), made.source_points, made.target_points,
           pair.use.left_out}};
}

std::shared_ptr<Alignment> icpatch(const StripArgument& source, const StripArgument& target,
                                   const PatchAlignmentSettings& settings,
                                   const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    if (source.index() != target.index())
      throw UsageError("source and target: not both strips in memory, nor both files");
    if (const auto* strip = std::get_if<std::shared_ptr<LidarStrip>>(&source))
      return std::make_shared<Alignment>(
          alignStrips(**strip, *std::get<std::shared_ptr<LidarStrip>>(target), settings));
    return std::make_shared<Alignment>(alignFiles(std::get<std::filesystem::path>(source),
                                                  std::get<std::filesystem::path>(target), settings,
                                                  report));
  });
}

}  // namespace

void bindRegistration(py::module_& m) {
  bindAlignment(m);
  bindSettings(m);
  m.def("icpatch", &icpatch, py::arg("source"), py::arg("target"), py::kw_only(),
        py::arg_v("settings", PatchAlignmentSettings(), "AlignmentSettings()"),
        py::arg("progress") = py::none(),
        "The rigid motion of one strip onto another, by ICPatch (Habib et al. 2011, section 2.3), "
        "as pcl_als_icpatch does. Both are strips in memory, or both files.");
  m.def(
      "move_file",
      [](const std::filesystem::path& input, const std::filesystem::path& output,
         const Alignment& motion, int threads) {
        return runJob({}, [&](const ProgressCallback&) {
          return movePointFile(input, output, motion.result.motion, threads);
        });
      },
      py::arg("input"), py::arg("output"), py::arg("motion"), py::kw_only(), py::arg("threads") = 0,
      "Writes a copy of a point file with moved points, everything else byte for byte; returns the "
      "number of points.");
}

}  // namespace pcl_als::python
