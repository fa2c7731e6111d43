// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/processing/file_batch.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/report/intensity_page.h>
#include <pcl_als/report/intensity_report.h>

#include "atmosphere_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "intensity_options.h"
#include "processes.h"
#include "report_options.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_intensity",
      "corrects intensity for range, incidence and atmosphere (radar equation; Habib et al. 2011, "
      "Eq. 35-36), from the points' calibrated geometry and the trajectory.\n"
      "I_c = I / gain (r / r0)^m / cos(incidence)^k exp(2 a (r - r0)), linear, in the intensity "
      "field times -intensity_scale; extra bytes: original_intensity, range, incidence_angle, and "
      "with "
      "-targets reflectance. Points without a surface (trees) and returns before the last are "
      "corrected for range and atmosphere only.",
      "IN OUT -trajectory T [options], or STRIP… -corrected DIR -trajectory T [options]",
      "pcl_als_intensity strip*.las -corrected out -trajectory flight.csv -visibility 48.3 "
      "-temperature 29.8 -pressure 101.81 -estimate strip_gains -report report");
  line.setArguments(
      {{"corrected", 1, app::Arguments::kAnyNumber}, {"", 1, 1, {".las", ".laz", ".pcd"}}});
  app::addFlightOptions(line);
  app::addForceOption(line);
  app::addStripOptions(line);
  app::addIntensityOptions(line);
  app::addResumeOption(line);
  return line;
}

/// Where each input goes.
std::vector<std::string> outputsOf(const CommandLine& line) {
  if (!line.has("corrected")) return {line.output()};
  return outputsIn(line.text("corrected"), line.inputs());
}

void writeReport(const CommandLine& line, const IntensityReport& report,
                 const IntensityPage& page) {
  const std::filesystem::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeIntensityTables(folder, report);
  page.write(app::reportOrigin(line), report);
  step.done("report.html with pictures, report.md, CSV");
}

void print(const IntensityResult& result) {
  if (result.overlaps) std::cout << overlapText(*result.overlaps, result.run->strips());
  if (result.reference) std::cout << referenceText(*result.reference);
  for (std::size_t i = 0; i < result.run->files(); ++i) {
    if (result.run->files() > 1) std::cout << result.run->input(i).path() << '\n';
    std::cout << countsText(result.outcome.counts[i], *result.run);
  }
  std::cout << std::flush;
}

int intensity(const CommandLine& line) {
  const ExtinctionChoice extinction = app::extinctionChoice(line);
  IntensityOptions options = app::intensityOptions(line, extinction.per_km);
  const std::vector<std::string>& files = line.inputs();
  const std::vector<std::string> outputs = outputsOf(line);
  const PointReference reference = commonReference(files);
  app::remarks(line, reference.remarks);
  const auto flight =
      app::loadTrajectory(line, reference.crs, 0.0, AttitudeUse::where_given, files);
  if (!line.has("radiometry")) app::remark(line, extinction.remark);
  const auto page = line.has("report") ? makeIntensityPage() : nullptr;
  if (page) options.observe = [&page](const IntensityRun& run) { return page->observe(run); };

  options.batch = app::batchOptions(line);
  const IntensityResult result =
      correctIntensity(files, outputs, flight, options, app::progressOf(line));
  if (!isRoot(app::processes())) return app::kDone;
  if (!line.quiet()) print(result);
  const IntensityReport report{&result, extinction, options.output, outputs};
  if (line.has("output")) writeFile(line.text("output"), intensityJson(report));
  if (page) writeReport(line, report, *page);
  return app::conclude(line, result.unreliable);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, commandLine, intensity);
}
