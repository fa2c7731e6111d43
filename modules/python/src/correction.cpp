// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/file_correction.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "messages.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

LoadedTrajectory flightFor(const TrajectoryArgument& trajectory,
                           const CalibrationResult& calibration, const std::string& crs) {
  TrajectoryLoadingOptions reading = trajectoryLoadingOptions(calibration);
  reading.crs = crs;
  return flightOf(trajectory, reading);
}

/// What was done to a file.
struct FileCorrection {
  std::uint64_t points = 0, uncovered = 0;
  std::string time_remark, attitude_remark, flight_remark;
  WarningTexts warnings;
};

void bindCorrectedFile(py::module_& m) {
  Record<FileCorrection>(m, "FileCorrection", "What correct_file() did.")
      .field("points", &FileCorrection::points, "number of points")
      .field("uncovered", &FileCorrection::uncovered,
             "points without trajectory, which are unchanged")
      .field("time_remark", &FileCorrection::time_remark,
             "how the times of the points were reconciled with those of the trajectory")
      .field("attitude_remark", &FileCorrection::attitude_remark,
             "recovery of pitch and crab from this file, where the calibration has none")
      .field("flight_remark", &FileCorrection::flight_remark,
             "that the calibration is of another flight, whose own part is not used")
      .state(&FileCorrection::warnings)
      .property("warnings",
                [](const FileCorrection& f) { return hintedTexts("correct_file", f.warnings); })
      .bind();
}

FileCorrection correctFile(const std::filesystem::path& input, const std::filesystem::path& output,
                           const TrajectoryArgument& trajectory,
                           const CalibrationArgument& calibration,
                           const FileCorrectionOptions& options, const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    const CalibrationResult biases = calibrationOf(calibration);
    const std::string crs = commonReference(std::vector<std::string>{input.string()}).crs;
    const LoadedTrajectory flight = flightFor(trajectory, biases, crs);
    const FileCorrectionResult result =
        correctPointFile(input, output, biases, flight.trajectory, options, report);
    return FileCorrection{result.points,        result.coverage.missed(),
                          result.time_remark,   result.attitude_remark,
                          result.flight_remark, warningTexts(result.warnings)};
  });
}

/// The channels of the scanner in a further column of a strip; empty where it has none.
std::vector<std::uint8_t> channelsOf(const LidarStrip& strip, const std::string& field) {
  std::vector<std::uint8_t> channels;
  for (const PointColumn& column : strip.columns) {
    if (column.field.name != field) continue;
    for (const double value : column.values)
      channels.push_back(channelOfValue(value, "strip " + strip.id + ": column '" + field + "'"));
  }
  return channels;
}

std::shared_ptr<LidarStrip> correctStrip(const LidarStrip& strip,
                                         const TrajectoryArgument& trajectory,
                                         const CalibrationArgument& calibration,
                                         bool strip_corrections, bool invert, bool keep_uncovered,
                                         int threads) {
  return runJob({}, [&](const ProgressCallback&) {
    const CalibrationResult biases = calibrationOf(calibration);
    SystemBiasCorrection<PointLidar> correction;
    correction.setTrajectory(flightFor(trajectory, biases, strip.frame.crs).trajectory);
    correction.setCalibration(biases);
    correction.setLocalFrame(strip.frame);
    correction.setStripCorrections(strip_corrections);
    correction.setInvert(invert);
    correction.setKeepUncovered(keep_uncovered);
    correction.setNumberOfThreads(threads);
    correction.setInputCloud(strip.cloud);
    correction.setStripId(strip.id);
    correction.setChannels(channelsOf(strip, SystemLookup(biases).channelField()));
    auto corrected = std::make_shared<LidarStrip>();
    corrected->id = strip.id, corrected->frame = strip.frame, corrected->columns = strip.columns;
    correction.filter(*corrected->cloud);
    return corrected;
  });
}

}  // namespace

void bindCorrection(py::module_& m) {
  bindCorrectedFile(m);
  m.def(
      "correct_file",
      [](const std::filesystem::path& input, const std::filesystem::path& output,
         const TrajectoryArgument& trajectory, const CalibrationArgument& calibration,
         bool strip_corrections, bool invert, bool keep_uncovered, bool force,
         std::optional<int> gps_week, int threads, const PythonProgress& progress) {
        FileCorrectionOptions options;
        options.strip_corrections = strip_corrections, options.invert = invert;
        options.keep_uncovered = keep_uncovered, options.force = force;
        options.gps_week = gps_week, options.threads = threads;
        return correctFile(input, output, trajectory, calibration, options, progress);
      },
      py::arg("input"), py::arg("output"), py::arg("trajectory"), py::arg("calibration"),
      py::kw_only(), py::arg("strip_corrections") = false, py::arg("invert") = false,
      py::arg("keep_uncovered") = false, py::arg("force") = false, py::arg("gps_week") = py::none(),
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Removes the biases of a calibration from a point file (Habib et al. 2011, Eq. 13), as "
      "pcl_als_apply does: .las and .laz in constant memory with every other byte kept, .pcd. "
      "strip_corrections: also the errors of the trajectory that were estimated; invert: applies "
      "the biases instead; keep_uncovered: any number of points without trajectory stay "
      "unchanged, else at most 1 %; force: continue where the verdict or the trajectory is "
      "against it. UsageError for a calibration that should not be applied.");
  m.def("correct_strip", &correctStrip, py::arg("strip"), py::arg("trajectory"),
        py::arg("calibration"), py::kw_only(), py::arg("strip_corrections") = false,
        py::arg("invert") = false, py::arg("keep_uncovered") = false, py::arg("threads") = 0,
        "The same of a strip in memory; returns a new Strip.");
}

}  // namespace pcl_als::python
