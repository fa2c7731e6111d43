// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <pcl_als/common/strip.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/processing/flight_file.h>
#include <pcl_als/processing/survey_reader.h>

// What the jobs take from Python, and its conversion, which needs no GIL.
namespace pcl_als::python {

/// A survey that several threads may hand to jobs; one job at a time uses it.
struct Survey {
  explicit Survey(SurveyReader opened) : reader(std::move(opened)) {}
  SurveyReader reader;
  std::mutex busy;
};

using Paths = std::vector<std::filesystem::path>;
using LidarStrip = Strip<PointLidar>;
using Strips = std::vector<std::shared_ptr<LidarStrip>>;

/// Points: an opened survey, clouds in memory, files, or one file.
using PointsArgument = std::variant<std::shared_ptr<Survey>, Strips, Paths, std::filesystem::path>;
/// A trajectory: one that was read, or its files or folder.
using FlightArgument = std::variant<std::shared_ptr<FlightFile>, std::filesystem::path, Paths>;
/// Control points or their CSV file; none.
using ControlArgument =
    std::variant<std::monostate, std::filesystem::path, std::vector<ControlPoint>>;

/// A survey in use by a job.
class UsedSurvey {
 public:
  UsedSurvey(const PointsArgument& points, int threads);
  SurveyReader& operator*() { return survey_->reader; }

 private:
  std::shared_ptr<Survey> survey_;
  std::unique_lock<std::mutex> lock_;
};

/// The flight as the options say; one that was read already is taken as it is.
FlightFile flightOf(const FlightArgument& argument, const FlightFileOptions& options);
std::vector<ControlPoint> controlOf(const ControlArgument& argument);
/// The names of the files of arguments, for lists of inputs.
void addInputs(const FlightArgument& flight, const ControlArgument& control,
               std::vector<std::string>& inputs);
std::vector<std::string> textsOfPaths(const Paths& paths);

/// The text of a JSON document as a Python object.
pybind11::object parsedJson(const std::string& text);

}  // namespace pcl_als::python
