// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/processing/survey_correction.h>

namespace pcl_als {
namespace {

/// Corrects a file; its result as bytes.
std::string corrected(const std::string& input, const std::string& output,
                      const CalibrationResult& calibration,
                      const std::shared_ptr<const Trajectory>& flight,
                      const FileCorrectionOptions& options,
                      const std::function<void(double)>& fraction) {
  const auto progress = [&fraction](const JobProgress& now) {
    if (now.event == JobProgress::Event::advance) fraction(now.fraction);
    return true;
  };
  const FileCorrectionResult result =
      correctPointFile(input, output, calibration, flight, options, progress);
  const bool missed = result.coverage.missed() > 0;
  return ByteWriter()
      .put(result.points)
      .put(result.attitude_remark)
      .put(missed ? result.coverage.describe(*flight) : std::string())
      .put(result.copy_remarks)
      .put(result.remarks)
      .take();
}

}  // namespace

std::vector<CorrectedFile> correctPointFiles(const std::vector<std::string>& inputs,
                                             const std::vector<std::string>& outputs,
                                             const CalibrationResult& calibration,
                                             const std::shared_ptr<const Trajectory>& flight,
                                             const FileCorrectionOptions& options,
                                             const BatchOptions& batch_options,
                                             const ProgressCallback& callback) {
  if (options.deviation_cell > 0.0)
    throw UsageError("a raster of standard deviations is made of one file only");
  const UnchangedInputs unchanged;
  ProgressReport progress(sharedProgress(batch_options.processes, callback));
  FileBatch batch(inputs, outputs, batch_options);
  FileCorrectionOptions of_file = options;
  if (of_file.calibration_id.empty()) of_file.calibration_id = calibrationId(calibration);
  progress.begin("Writing " + counted(inputs.size(), "file"));
  const std::vector<std::string> results = batch.run(
      [&](std::size_t file, const std::function<void(double)>& fraction) {
        return corrected(inputs[file], outputs[file], calibration, flight, of_file, fraction);
      },
      [&progress](double fraction) { progress.advance(fraction); });
  std::vector<CorrectedFile> files(inputs.size());
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    CorrectedFile& file = files[i];
    ByteReader(results[i])
        .get(file.points)
        .get(file.attitude_remark)
        .get(file.uncovered)
        .get(file.copy_remarks)
        .get(file.remarks);
    file.kept = batch.wasKept(i);
    points += file.points;
  }
  progress.end(grouped(points) + " points");
  if (batch.keptCount() > 0)
    progress.remark(counted(batch.keptCount(), "file") + " complete from an earlier run");
  return files;
}

}  // namespace pcl_als
