// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

#include <nlohmann/json.hpp>

#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/processing/class_model_file.h>

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "pcl_als class statistics";
constexpr int kVersion = 1;
constexpr std::size_t kMostBands = 100, kMostClasses = 250;

std::string nameOf(const Json& json) {
  auto name = json.get<std::string>();
  const std::string fault = classNameFault(name);
  if (!fault.empty()) throw UsageError("the name of a class " + fault);
  return name;
}

GaussianClass classOf(const Json& json, Eigen::Index bands) {
  GaussianClass c;
  c.name = nameOf(json.at("name"));
  c.prior = json.at("prior").get<double>();
  if (!json.at("samples").is_number_unsigned())
    throw UsageError("class " + c.name + ": its samples are no count");
  c.samples = json.at("samples").get<std::size_t>();
  c.shrinkage = json.at("shrinkage").get<double>();
  const auto mean = json.at("mean").get<std::vector<double>>();
  const auto rows = json.at("covariance").get<std::vector<std::vector<double>>>();
  bool square = static_cast<Eigen::Index>(rows.size()) == bands;
  for (const auto& row : rows) square = square && static_cast<Eigen::Index>(row.size()) == bands;
  if (static_cast<Eigen::Index>(mean.size()) != bands || !square)
    throw UsageError("class " + c.name + ": mean and covariance must fit the bands");
  c.mean = Eigen::Map<const Eigen::VectorXd>(mean.data(), bands);
  c.covariance.resize(bands, bands);
  for (Eigen::Index i = 0; i < bands; ++i)
    for (Eigen::Index j = 0; j < bands; ++j)
      c.covariance(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return c;
}

}  // namespace

void writeClassModel(const std::filesystem::path& path, const GaussianModel& model,
                     const std::vector<std::string>& remarks) {
  Json json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["bands"] = model.bands;
  json["classes"] = Json::array();
  for (const GaussianClass& c : model.classes) {
    Json covariance = Json::array();
    for (Eigen::Index i = 0; i < c.covariance.rows(); ++i) {
      const Eigen::VectorXd row = c.covariance.row(i);
      covariance.push_back(std::vector<double>(row.data(), row.data() + row.size()));
    }
    json["classes"].push_back(
        {{"name", c.name},
         {"prior", c.prior},
         {"samples", c.samples},
         {"shrinkage", c.shrinkage},
         {"mean", std::vector<double>(c.mean.data(), c.mean.data() + c.mean.size())},
         {"covariance", covariance}});
  }
  json["warnings"] = remarks;
  json["tool_version"] = PCL_ALS_VERSION;
  writeFile(path, json.dump(1) + "\n");
}

GaussianModel readClassModel(const std::filesystem::path& path) {
  const Json json = Json::parse(readWholeFile(path, kJsonLimits), nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("format", Json()) != kFormat)
    throw InputError(path.string() + ": is no file of class statistics");
  try {
    if (json.at("version") != kVersion)
      throw UsageError("is of version " + json.at("version").dump().substr(0, 20) +
                       ", this program reads version " + std::to_string(kVersion));
    GaussianModel model;
    const Json &bands = json.at("bands"), &classes = json.at("classes");
    if (!bands.is_array() || !classes.is_array() || bands.size() > kMostBands ||
        classes.size() > kMostClasses)
      throw UsageError("needs lists of at most 100 bands and 250 classes");
    for (const Json& band : bands) model.bands.push_back(nameOf(band));
    for (const Json& entry : classes)
      model.classes.push_back(classOf(entry, static_cast<Eigen::Index>(model.bands.size())));
    model.check();
    for (const std::string& band : model.bands) requireBand(band);
    return model;
  } catch (const nlohmann::json::exception&) {
    throw InputError(path.string() + ": lacks a value or has one of the wrong kind");
  } catch (const UsageError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace pcl_als
