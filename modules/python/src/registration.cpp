// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/processing/file_motion.h>
#include <pcl_als/processing/pair_alignment.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/registration/iterative_closest_patch.h>
#include <pcl_als/report/alignment_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using StripArgument = std::variant<std::filesystem::path, std::reference_wrapper<LidarStrip>>;

/// What an alignment found.
struct Alignment {
  bool converged = false, reliable = false;
  std::string reason, json, text;
  Eigen::VectorXd values, std;  ///< XT, YT, ZT, omega, phi, kappa
  Eigen::MatrixXd covariance;
  Eigen::Vector3d centroid;
  double scale = 1.0, sigma0 = 0.0, rms_before = 0.0, rms_after = 0.0;
  std::size_t pairs = 0;

  RigidMotion motion() const {
    RigidMotion motion;
    motion.centroid = centroid, motion.scale = scale;
    motion.shift = values.head<3>(), motion.rotation = values.tail<3>();
    return motion;
  }
};

Eigen::VectorXd deviationsOf(const PatchAlignmentResult& result) {
  Eigen::VectorXd values(6);
  for (int i = 0; i < 6; ++i)
    values[i] = result.parameters[i].determined ? result.standardDeviation(i)
                                                : std::numeric_limits<double>::quiet_NaN();
  return values;
}

Alignment alignmentOf(const PatchAlignmentResult& result, const AlignedStrips& strips) {
  Alignment alignment;
  alignment.converged = result.hasConverged();
  alignment.reliable = result.hasConverged() && result.allDetermined();
  alignment.reason = unreliability(result);
  alignment.json = alignmentJson(result, strips), alignment.text = alignmentTable(result);
  alignment.values.resize(6);
  alignment.values << result.motion.shift, result.motion.rotation;
  alignment.std = deviationsOf(result), alignment.covariance = result.covariance;
  alignment.centroid = result.motion.centroid, alignment.scale = result.motion.scale;
  alignment.sigma0 = result.sigma0, alignment.pairs = result.pairs;
  alignment.rms_before = result.normal_before.rms, alignment.rms_after = result.normal_after.rms;
  return alignment;
}

void bindAlignment(py::module_& m) {
  Record<Alignment>(m, "Alignment",
                    "The rigid motion of a source onto a target, about the centroid of their "
                    "overlap. Order of parameters: XT, YT, ZT (m), omega, phi, kappa (rad).")
      .field("converged", &Alignment::converged)
      .field("reliable", &Alignment::reliable, "converged, and every parameter is determined")
      .field("reason", &Alignment::reason, "why the result is not reliable; empty where it is")
      .field("values", &Alignment::values, "the six parameters")
      .field("std", &Alignment::std, "their standard deviations; NaN: not determined")
      .field("covariance", &Alignment::covariance, "6 x 6; m^2, m rad, rad^2")
      .state(&Alignment::centroid)
      .property(
          "transformation",
          [](const Alignment& a) { return Eigen::Matrix4d(a.motion().transformation().matrix()); },
          "4 x 4, from source to target, ground frame")
      .field("scale", &Alignment::scale)
      .field("sigma0", &Alignment::sigma0, "m")
      .field("pairs", &Alignment::pairs)
      .field("rms_before", &Alignment::rms_before, "normal distances with the initial motion, m")
      .field("rms_after", &Alignment::rms_after, "normal distances with the estimated motion, m")
      .state(&Alignment::json)
      .state(&Alignment::text)
      .bind()
      .def(
          "to_dict", [](const Alignment& a) { return parsedJson(a.json); },
          "The content of the result file of pcl_als_icpatch as dictionaries and lists.")
      .def("__str__", [](const Alignment& a) { return a.text; });
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

Alignment registerStrips(const LidarStrip& source, const LidarStrip& target,
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
  return alignmentOf(icpatch.getResult(),
                     {source.id, target.id, source.cloud->size(), target.cloud->size(), {}});
}

Alignment registerFiles(const std::filesystem::path& source, const std::filesystem::path& target,
                        const PatchAlignmentSettings& settings, const ProgressCallback& report) {
  const AlignmentPair pair = filePair({source, target}, std::nullopt);
  const PairAlignment made = registerPair(pair, settings, report);
  return alignmentOf(made.result, {pair.source.name, pair.target.name, made.source_points,
                                   made.target_points, pair.excluded});
}

std::shared_ptr<Alignment> icpatch(const StripArgument& source, const StripArgument& target,
                                   const PatchAlignmentSettings& settings,
                                   const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    if (source.index() != target.index())
      throw UsageError("source and target: not both strips in memory, nor both files");
    if (const auto* strip = std::get_if<std::reference_wrapper<LidarStrip>>(&source))
      return std::make_shared<Alignment>(registerStrips(
          strip->get(), std::get<std::reference_wrapper<LidarStrip>>(target).get(), settings));
    return std::make_shared<Alignment>(registerFiles(std::get<std::filesystem::path>(source),
                                                     std::get<std::filesystem::path>(target),
                                                     settings, report));
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
          return movePointFile(input, output, motion.motion(), threads).points;
        });
      },
      py::arg("input"), py::arg("output"), py::arg("motion"), py::kw_only(), py::arg("threads") = 0,
      "Writes a copy of a point file with moved points, everything else byte for byte; returns the "
      "number of points.");
}

}  // namespace pcl_als::python
