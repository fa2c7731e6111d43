// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/intensity_output.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/report/intensity_page.h>
#include <pcl_als/report/intensity_report.h>

#include "command_line.h"
#include "flight_options.h"
#include "intensity_options.h"
#include "output_check.h"
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
      "field times -scale; extra bytes: original_intensity, range, incidence_angle, and with "
      "-targets reflectance. Points without a surface (trees) and returns before the last are "
      "corrected for range and atmosphere only.",
      "IN OUT -trajectory T [options], or STRIP… -corrected DIR -trajectory T [options]",
      "pcl_als_intensity strip*.las -corrected out -trajectory flight.csv -visibility 48.3 "
      "-temperature 29.8 -pressure 101.81 -estimate strip_gains -report report");
  app::addFlightOptions(line);
  app::addForceOption(line);
  app::addStripOptions(line);
  app::addIntensityOptions(line);
  return line;
}

/// Input files, and where each goes.
struct Files {
  std::vector<std::string> inputs, outputs;
};

Files filesOf(const CommandLine& line) {
  Files files;
  if (!line.has("corrected")) {
    const std::vector<std::string>& names = line.inputs(2, 2);
    files.inputs = {names[0]};
    files.outputs = {names[1]};
    return files;
  }
  files.inputs = line.inputs(1, 100000);
  const std::filesystem::path folder = line.text("corrected");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": cannot make this folder");
  for (const std::string& input : files.inputs) {
    const std::string output = (folder / std::filesystem::path(input).filename()).string();
    if (std::find(files.outputs.begin(), files.outputs.end(), output) != files.outputs.end())
      throw UsageError("option -corrected: two inputs would become " + output);
    files.outputs.push_back(output);
  }
  return files;
}

void useStored(const CommandLine& line, IntensityRun& run) {
  if (!line.has("radiometry")) return;
  const StoredRadiometry stored = readIntensityJson(line.text("radiometry"));
  run.useModel(stored.model);
  run.useConstant(stored.constant);
  std::vector<double> gains;
  for (const std::string& strip : run.strips()) {
    const auto at = stored.gains.find(strip);
    if (at == stored.gains.end())
      throw InputError(line.text("radiometry") + ": knows no strip " + strip);
    gains.push_back(at->second);
  }
  run.useGains(gains);
}

/// What is to be learned before anything can be written.
void learn(const CommandLine& line, IntensityRun& run, IntensityReport& report) {
  const bool estimates = line.has("estimate");
  if (estimates || (run.settings().statistics && run.strips().size() > 1)) {
    Step step("Comparing strips", line.quiet());
    const OverlapResult& overlaps =
        run.adjust([&step](double fraction) { step.progress(fraction); });
    step.done(grouped(overlaps.cells) + " smooth cells seen by several strips");
    if (!line.quiet()) std::cout << overlapText(overlaps, run.strips());
    report.overlaps = overlaps;
    for (const std::string& warning : overlaps.warnings) report.warnings.push_back(warning);
  }
  if (line.has("targets")) {
    Step step("Reading " + line.text("targets"), line.quiet());
    const ReferenceResult& reference =
        run.refer(readReferenceTargets(line.text("targets"), app::unitOption(line, "targets")),
                  line.number("target_radius", 0.01, 1000.0, "m"));
    step.done(grouped(reference.targets.size()) + " targets");
    if (!line.quiet()) std::cout << referenceText(reference);
    report.reference = reference;
    for (const std::string& warning : reference.warnings) report.warnings.push_back(warning);
    if (reference.constant <= 0.0)
      report.warnings.push_back("no reflectance is written: no target has enough points");
  }
  for (const std::string& warning : report.warnings) app::remark(line, warning);
}

/// Counts of all files.
IntensityCounts allCounts(const IntensityOutcome& outcome) {
  IntensityCounts all;
  for (const IntensityCounts& counts : outcome.counts) all.merge(counts);
  return all;
}

/// In one line, the reasons of each are in the tables; empty where all asked for is answered.
std::string whyNot(const CommandLine& line, const IntensityReport& report) {
  const LostIntensities lost = lostIntensities(allCounts(*report.outcome));
  if (lost.share > LostIntensities::kAll) return lost.text;
  if (report.reference && !(report.reference->constant > 0.0)) {
    return "no reference target was seen: intensities are relative";
  }
  if (!line.has("estimate") || report.overlaps->reliable()) return "";
  return "not all that -estimate asks for is determined by the overlaps (" +
         notEstimable(*report.overlaps, report.run->strips()) + "): the given values were kept";
}

void writeReport(const CommandLine& line, const IntensityReport& report, const IntensityPage* page,
                 bool reliable) {
  const std::filesystem::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeIntensityReport(folder, report, page == nullptr);
  if (page != nullptr)
    page->write(app::reportOrigin(line, {"trajectory", "targets", "radiometry"}), report, reliable);
  step.done(page != nullptr ? "report.html with pictures, report.md, CSV"
                            : "report.md, CSV; no report.html: built without VTK");
}

void checkOptions(const CommandLine& line) {
  line.number("target_radius", 0.01, 1000.0, "m");  // is needed late
  if (line.has("radiometry") && line.has("estimate"))
    throw UsageError("options -radiometry and -estimate exclude each other");
}

int intensity(int argc, const char* const* argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  checkOptions(line);
  const ExtinctionChoice extinction = app::extinctionChoice(line);
  const IntensitySettings settings = app::intensitySettings(line, extinction.per_km);
  const IntensityOutput output = app::intensityOutput(line);
  const Files files = filesOf(line);
  // What can be known to fail should fail before the work, not after it.
  if (line.has("report")) app::makeOutputFolder("report", line.text("report"));
  if (line.has("json")) app::checkWritable(line.text("json"));
  const PointReference reference = commonReference(files.inputs);
  app::remarks(line, reference.remarks);
  const auto flight = app::readFlight(line, reference.crs, 0.0, AttitudeUse::where_given);

  Step looking("Reading " + counted(files.inputs.size(), "file"), line.quiet());
  IntensityRun run(files.inputs, flight, settings);
  looking.done(counted(run.strips().size(), "strip"));
  for (const std::string& remark : run.remarks()) app::remark(line, remark);
  useStored(line, run);
  if (!line.has("radiometry")) app::remark(line, extinction.remark);

  IntensityOutcome outcome(run.strips().size());
  const auto page = line.has("report") ? makeIntensityPage(run, outcome) : nullptr;
  IntensityReport report{&run, &outcome, extinction, output, files.outputs, {}, {}, {}, {}};
  report.warnings = run.warnings();
  learn(line, run, report);
  for (std::size_t i = 0; i < files.inputs.size(); ++i) {
    Step step("Writing " + files.outputs[i], line.quiet());
    writeCorrected(
        run, i, files.outputs[i], output, [&step](double fraction) { step.progress(fraction); },
        outcome);
    step.done(grouped(outcome.counts[i].points) + " points");
    if (!line.quiet()) std::cout << countsText(outcome.counts[i], run);
  }
  report.left_out = run.leftOut(allCounts(outcome));
  for (const std::string& text : describe(report.left_out)) {
    report.warnings.push_back(text);
    app::remark(line, text);
  }
  if (line.has("json")) writeIntensityJson(line.text("json"), report);
  const LostIntensities lost = lostIntensities(allCounts(outcome));
  if (lost.share > LostIntensities::kMany) {
    report.warnings.push_back(lost.text);
    app::remark(line, "warning: " + lost.text);
  }
  const std::string missing = whyNot(line, report);
  if (line.has("report")) writeReport(line, report, page.get(), missing.empty());
  if (missing.empty()) return app::kDone;
  std::cerr << "pcl_als_intensity: no reliable answer: " << missing << std::endl;
  return app::kNoReliableAnswer;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_intensity", [argc, argv] { return intensity(argc, argv); });
}
