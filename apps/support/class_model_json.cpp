// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "class_model_json.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/atomic_file.h>

namespace pcl_als::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "pcl_als class statistics";

GaussianClass classOf(const Json& json, Eigen::Index bands) {
  GaussianClass c;
  c.name = json.at("name").get<std::string>();
  c.prior = json.at("prior").get<double>();
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
  json["version"] = 1;
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
  std::ifstream stream(path);
  if (!stream) throw InputError(path.string() + ": cannot be opened");
  const Json json = Json::parse(stream, nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("format", Json()) != kFormat)
    throw InputError(path.string() + ": is no file of class statistics");
  try {
    GaussianModel model;
    model.bands = json.at("bands").get<std::vector<std::string>>();
    for (const Json& entry : json.at("classes"))
      model.classes.push_back(classOf(entry, static_cast<Eigen::Index>(model.bands.size())));
    model.check();
    return model;
  } catch (const nlohmann::json::exception&) {
    throw InputError(path.string() + ": lacks a value or has one of the wrong kind");
  } catch (const UsageError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace pcl_als::app
