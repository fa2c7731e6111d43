// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/survey/survey_reader.h>

// What the jobs take from Python, and its conversion, which needs no GIL. Arguments of bound
// classes are references or values: pybind11 converts None to a null pointer, also inside lists and
// alternatives, and refuses it for a reference. The caller keeps the objects alive.
namespace pcl_als::python {

/// A survey that several threads may hand to jobs; one job at a time uses it.
struct Survey {
  Survey(const std::vector<std::string>& files, const PointWindow& part, int threads)
      : paths(files), window(part), reader(files, threads, part) {}
  explicit Survey(SurveyReader opened) : reader(std::move(opened)) {}

  std::vector<std::string> paths;  ///< from which it was opened; empty: from points in memory
  PointWindow window;
  SurveyReader reader;
  std::mutex busy;
};

using Paths = std::vector<std::filesystem::path>;
using LidarStrip = StripWithColumns;
using Strips = std::vector<LidarStrip>;  ///< they share the points of those in Python

/// x_min, y_min, x_max, y_max in the ground frame, m.
using Rectangle = std::array<double, 4>;
/// UsageError where the minima are not the smaller values.
void setBounds(PointWindow& window, const std::optional<Rectangle>& bounds);

/// One file or several.
struct Files {
  Paths paths;

  std::vector<std::string> texts() const;
};

/// Points: files, an opened survey, or clouds in memory.
using PointsArgument = std::variant<Files, std::reference_wrapper<Survey>, Strips>;
/// A trajectory: its files or folder, or one that was read.
using TrajectoryArgument = std::variant<Files, std::reference_wrapper<LoadedTrajectory>>;
/// A trajectory; none.
using OptionalTrajectory =
    std::variant<std::monostate, Files, std::reference_wrapper<LoadedTrajectory>>;

/// An optional argument as the argument that it holds.
template <typename Argument, typename Optional>
std::optional<Argument> given(const Optional& argument) {
  return std::visit(
      [](const auto& value) -> std::optional<Argument> {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
          return std::nullopt;
        else
          return Argument(value);
      },
      argument);
}

/// Control points or their CSV file; none.
using ControlArgument =
    std::variant<std::monostate, std::filesystem::path, std::vector<ControlPoint>>;
/// A calibration or its file.
using CalibrationArgument =
    std::variant<std::filesystem::path, std::reference_wrapper<CalibrationResult>>;

/// A survey in use by a job.
class UsedSurvey {
 public:
  UsedSurvey(const PointsArgument& points, int threads);
  SurveyReader& operator*() { return survey_->reader; }

 private:
  std::unique_ptr<Survey> opened_;  ///< where the argument is none itself
  Survey* survey_;
  std::unique_lock<std::mutex> lock_;
};

/// The flight as the options say; one that was read already is taken as it is.
LoadedTrajectory flightOf(const TrajectoryArgument& argument,
                          const TrajectoryLoadingOptions& options);
std::vector<ControlPoint> controlOf(const ControlArgument& argument);
CalibrationResult calibrationOf(const CalibrationArgument& argument);
/// The names of the files of arguments, for lists of inputs.
void addInputs(const TrajectoryArgument& flight, const ControlArgument& control,
               std::vector<std::string>& inputs);

/// The text of a JSON document as a Python object.
pybind11::object parsedJson(const std::string& text);

}  // namespace pcl_als::python

namespace pybind11::detail {

template <>
struct type_caster<pcl_als::python::Files> {
  PYBIND11_TYPE_CASTER(pcl_als::python::Files, const_name("Union[os.PathLike, List[os.PathLike]]"));

  bool load(handle source, bool convert) {
    make_caster<std::filesystem::path> one;
    if (one.load(source, convert)) {
      value.paths = {cast_op<std::filesystem::path&&>(std::move(one))};
      return true;
    }
    make_caster<pcl_als::python::Paths> several;
    if (!several.load(source, convert)) return false;
    value.paths = cast_op<pcl_als::python::Paths&&>(std::move(several));
    return true;
  }
};

}  // namespace pybind11::detail
