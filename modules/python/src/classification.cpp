// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/io/class_io.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/processing/land_cover_job.h>
#include <pcl_als/report/accuracy_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using OptionalPath = std::optional<std::filesystem::path>;

/// A map of land cover, and its accuracy where there are check sites.
struct LandCover {
  std::shared_ptr<GaussianModel> model;
  std::vector<std::uint64_t> cells;
  std::vector<std::string> undetermined, remarks;
  std::optional<double> overall_accuracy;
  std::optional<Eigen::MatrixXd> confusion;
  std::string json;
};

std::vector<std::string> classesOf(const GaussianModel& model) {
  std::vector<std::string> names;
  for (const GaussianClass& each : model.classes) names.push_back(each.name);
  return names;
}

AccuracyReport assess(const LandCoverResult& result, const RasterInput& files) {
  const CountedSites counted = countSites(result.checks.sites, classesOf(*result.model));
  AccuracyReport report{countPoints(counted.classes, counted.points),
                        assessSites(counted),
                        {},
                        {},
                        {},
                        {},
                        result.checks.remarks,
                        files.excluded};
  return report;
}

void bindModel(py::module_& m) {
  using Model = GaussianModel;
  Record<GaussianClass>(m, "ClassStatistics", "A class as a normal distribution over bands.")
      .field("name", &GaussianClass::name)
      .field("mean", &GaussianClass::mean, "by band, in the units of the bands")
      .field("covariance", &GaussianClass::covariance, "bands x bands")
      .field("prior", &GaussianClass::prior, "probability")
      .field("samples", &GaussianClass::samples, "from which it was estimated")
      .state(&GaussianClass::shrinkage)
      .bind();
  Record<Model>(m, "ClassModel",
                "Statistics of classes: normal distributions over the bands of rasters.")
      .field("bands", &Model::bands)
      .state(&Model::classes)
      .property("classes", &classesOf, "names")
      .bind()
      .def(
          "statistics",
          [](const Model& model, std::size_t i) { return GaussianClass(model.classes.at(i)); },
          py::arg("index"), "Statistics of a class.")
      .def(
          "mean",
          [](const Model& model, std::size_t i) {
            return Eigen::VectorXd(model.classes.at(i).mean);
          },
          py::arg("index"), "Mean of a class by band, in the units of the bands; a new array.")
      .def(
          "covariance",
          [](const Model& model, std::size_t i) {
            return Eigen::MatrixXd(model.classes.at(i).covariance);
          },
          py::arg("index"), "Covariance of a class, bands x bands; a new array.")
      .def(
          "write",
          [](const Model& model, const std::filesystem::path& path) {
            writeClassModel(path, model, {});
          },
          py::arg("path"));
  m.def("read_class_model", &readClassModel, py::arg("path"),
        "Reads a model that was written. InputError names the file and what is wrong with it.");
}

void bindResult(py::module_& m) {
  Record<LandCover>(m, "LandCover", "The result of classify().")
      .field("model", &LandCover::model, "given or trained; None where only rasters were made")
      .field("cells", &LandCover::cells, "cells of the map by class, in the order of model.classes")
      .field("undetermined", &LandCover::undetermined,
             "classes whose training samples do not suffice")
      .property("reliable", [](const LandCover& c) { return c.undetermined.empty(); })
      .field("remarks", &LandCover::remarks)
      .field("overall_accuracy", &LandCover::overall_accuracy,
             "share of the check sites that are classified correctly; None without them")
      .field("confusion", &LandCover::confusion,
             "numbers of check sites, [classified, reference]; None without them")
      .state(&LandCover::json)
      .bind()
      .def(
          "to_dict",
          [](const LandCover& c) -> py::object {
            if (c.json.empty()) return py::dict();
            return parsedJson(c.json);
          },
          "The content of accuracy.json as dictionaries and lists; empty without check sites.");
}

std::vector<ClassSite> sitesOf(const OptionalPath& path) {
  return path ? readClassSites(*path) : std::vector<ClassSite>();
}

std::shared_ptr<LandCover> classify(const Files& inputs, LandCoverOptions options,
                                    const OptionalPath& training, const OptionalPath& checks,
                                    const StripChoice& strips, const ProgressCallback& report) {
  RasterInput files = rasterInput(inputs.texts());
  if (!strips.only.empty() || !strips.without.empty() || strips.split) chooseStrips(strips, files);
  options.training = sitesOf(training), options.checks = sitesOf(checks);
  if (training) options.training_name = training->string();
  if (checks) options.checks_name = checks->string();
  const LandCoverResult result = classifyLandCover(files, options, report);
  auto made = std::make_shared<LandCover>();
  if (result.model) made->model = std::make_shared<GaussianModel>(*result.model);
  made->cells.assign(result.cover.cells.begin(), result.cover.cells.end());
  made->undetermined = result.undetermined, made->remarks = result.remarks;
  if (result.checks.sites.empty()) return made;
  const AccuracyReport accuracy = assess(result, files);
  made->overall_accuracy = accuracy.result.overall.value;
  made->confusion = accuracy.matrix.counts.cast<double>();
  made->json = accuracyJson(accuracy);
  return made;
}

}  // namespace

void bindClassification(py::module_& m) {
  bindModel(m);
  bindResult(m);
  m.def(
      "classify",
      [](const Files& files, const std::filesystem::path& output, const OptionalPath& training,
         const std::optional<GaussianModel>& model, const OptionalPath& checkpoints, double cell,
         const std::optional<std::vector<std::string>>& bands, const OptionalPath& grids,
         const OptionalPath& posterior, const OptionalPath& points, double reject,
         double training_radius, const StripChoice& strips, int threads,
         const PythonProgress& progress) {
        LandCoverOptions options;
        options.map = output, options.model = model, options.cell = cell;
        if (bands) options.bands = *bands;
        options.grids = grids.value_or(""), options.posterior = posterior.value_or("");
        options.points = points.value_or("");
        options.reject = reject, options.training_radius = training_radius;
        options.threads = threads;
        return runJob(progress, [&](const ProgressCallback& report) {
          return classify(files, options, training, checkpoints, strips, report);
        });
      },
      py::arg("files"), py::arg("output"), py::kw_only(), py::arg("training") = py::none(),
      py::arg("model") = py::none(), py::arg("checkpoints") = py::none(), py::arg("cell") = 1.0,
      py::arg("bands") = py::none(), py::arg("grids") = py::none(),
      py::arg("posterior") = py::none(), py::arg("points") = py::none(), py::arg("reject") = 0.0,
      py::arg("training_radius") = 0.0, py::arg_v("strips", StripChoice(), "StripChoice()"),
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Maps the land cover of point files by Gaussian maximum likelihood, as pcl_als_classify "
      "does. "
      "output: GeoTIFF of classes, an empty path: rasters only; training: CSV or GeoJSON of sites, "
      "or model; checkpoints: sites for the accuracy; cell: m; bands: names of the rasters that "
      "separate the classes; grids, posterior: GeoTIFFs to write; points: folder for point files "
      "with classes; reject: probability below which a cell has no class; training_radius: m. "
      "UsageError for impossible options, InputError for input that cannot be used.");
}

}  // namespace pcl_als::python
