// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/flight_assessment.h>
#include <pcl_als/processing/strip_inventory.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/report/inventory_report.h>
#include <pcl_als/waveform/pulse_waves_file.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "command_line.h"
#include "flight_options.h"
#include "hint_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace pcl_als::app {
namespace {

ListedTrajectory flightOf(const CommandLine& line) {
  ListedTrajectory flight;
  if (line.has("trajectory_accuracy")) flight.accuracy_path = line.text("trajectory_accuracy");
  flight.accuracy = accuracies(line);
  if (!line.has("trajectory")) return flight;
  flight.trajectories = inspectFlight(trajectoryFiles(line), trajectoryReading(line, {}));
  return flight;
}

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_info",
      "lists the contents of point files: strips, times, density, returns, overlaps; of "
      "PulseWaves files (.pls) the pulses and how their waveforms are sampled",
      "FILE… [-trajectory T] [-output FILE]",
      "pcl_als_info strip1.las strip2.las -output survey.json");
  line.setArguments({{"trajectory", 0, Arguments::kAnyNumber},
                     {"trajectory_accuracy", 0, Arguments::kAnyNumber},
                     {"", 1, Arguments::kAnyNumber}});
  line.addNumber("cell", "cell size for density and overlaps; 0: by density", 0.0,
                 {0.0, 10000.0, "m"});
  line.addOutputFile("output", "also write the facts", {".json"}).formerly("json");
  addWindowOptions(line);
  addTrajectoryOptions(line, "listed, and used to detect the scanner and by -split");
  addStripOptions(line);
  addAccuracyOption(line, "listed");
  return line;
}

InventoryRequest requestOf(const CommandLine& line, const std::vector<std::string>& inputs,
                           const PointWindow& window, double cell) {
  InventoryRequest request{
      {inputs.begin(), inputs.end()}, cell, stripChoice(line), window, {}, {}, 0};
  request.strips.keep_timeless = true;  // nothing here needs times
  request.threads = line.threads();
  if (!line.has("trajectory") || !request.strips.split) return request;
  request.trajectory = trajectoryFiles(line);
  request.reading = trajectoryReading(line, {});
  return request;
}

void nameOptions(const CommandLine& line, DatasetInventory& survey) {
  for (FileInventory& file : survey.files) app::nameOptions(line, file.remarks);
  for (StripInventory& strip : survey.strips) app::nameOptions(line, strip.remarks);
  app::nameOptions(line, survey.remarks);
}

/// Adds what describes the waveforms of each file, or why it does not.
void addWaveforms(const CommandLine& line, DatasetInventory& survey) {
  const LasDamage damage = line.has("keep_readable") ? LasDamage::keep_intact : LasDamage::refuse;
  for (FileInventory& file : survey.files) {
    const std::string extension = lowerExtension(file.info.path);
    if (extension != ".las" && extension != ".laz") continue;
    try {
      const LasFile las(file.info.path, kLazAllFields, damage);
      for (const std::string& text : describeWaveforms(las)) file.remarks.push_back(text);
    } catch (const InputError& error) {
      file.remarks.push_back(error.what());
    }
  }
}

/// Prints the contents of Pulse files. \return the other inputs
std::vector<std::string> describePulseFiles(const CommandLine& line) {
  std::vector<std::string> others;
  for (const std::string& input : line.inputs()) {
    if (!isPulseFile(input)) {
      others.push_back(input);
      continue;
    }
    if (line.has("output"))
      throw UsageError("-output lists points, and " + input + " has pulses; omit it");
    const std::vector<std::string> texts = describePulseWaves(PulseWavesFile(input));
    if (line.quiet()) continue;
    std::cout << '\n' << input << '\n';
    for (const std::string& text : texts) std::cout << "  " << printable(text) << '\n';
  }
  return others;
}

int info(const CommandLine& line) {
  const PointWindow window = windowOf(line);
  const double cell = line.number("cell");
  const std::vector<std::string> inputs = describePulseFiles(line);
  ListedTrajectory flight = flightOf(line);
  if (!line.quiet()) std::cout << flightText(flight);
  if (inputs.empty()) {
    if (line.has("output")) writeFile(line.text("output"), inventoryJson({}, {}, flight));
    return kDone;
  }
  Step step("Reading " + counted(inputs.size(), "file"), line.quiet());
  const auto progress = [&](double fraction) { step.progress(fraction); };
  StripInventoryResult listed;
  if (choosesStrips(line))
    listed = takeInventory(requestOf(line, inputs, window, cell), progress);
  else
    listed.inventory = takeInventory({inputs.begin(), inputs.end()}, cell, progress, {}, window);
  DatasetInventory& survey = listed.inventory;
  addWaveforms(line, survey);
  std::uint64_t points = 0;
  for (const FileInventory& file : survey.files) points += file.statistics.points;
  step.done(grouped(points) + " points");
  remarks(line, listed.notes);
  nameOptions(line, survey);
  if (!line.quiet()) std::cout << '\n' << inventoryText(survey, listed.excluded);
  if (line.has("trajectory")) {
    flight.assessment = assessFlight(inputs, window, stripChoice(line), trajectoryFiles(line),
                                     trajectoryReading(line, {}), line.threads());
    if (choosesStrips(line)) flight.assessment.notes.clear();  // those of the strips listed
    app::nameOptions(line, flight.assessment.warnings);
    if (!line.quiet()) std::cout << assessmentText(flight.assessment);
  }
  if (line.has("output"))
    writeFile(line.text("output"), inventoryJson(survey, listed.excluded, flight));
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, pcl_als::app::commandLine, pcl_als::app::info);
}
