// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/pulse_io.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/report/waveform_report.h>

#include "atmosphere_options.h"
#include "command_line.h"
#include "flight_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

/// What cross sections need. Without a trajectory there are none.
void addCrossSectionOptions(CommandLine& line) {
  app::addFlightOptions(line, "for cross sections");
  app::addForceOption(line);
  std::vector<std::string> names = app::addAtmosphereOptions(line);
  line.addNumber("beam_divergence", "divergence of the beam, full angle", 0.3,
                 {0.001, 100.0, "mrad"});
  line.addNumber("calibration_constant",
                 "m2 per count, ns and km4, as an earlier run with -targets states it (default: 1, "
                 "cross sections are relative)",
                 std::nullopt, {1e-30, 1e30});
  line.addInputFile("targets",
                    "level reference targets, CSV x,y,reflectance[,id][,sigma]: calibrate cross "
                    "sections");
  app::addUnitsOption(line, "targets", "-targets");
  line.exclude({"targets", "calibration_constant"});
  line.addNumber("target_radius", "radius within which points belong to a target", 1.0,
                 {0.01, 1000.0, "m"});
  line.addFlag("correct_attenuation",
               "divide cross sections of echoes behind others of their pulse by the transmission "
               "that these leave");
  names.insert(names.end(),
               {"beam_divergence", "calibration_constant", "targets", "correct_attenuation"});
  for (const std::string& name : names) line.makeDependent(name, "trajectory");
  line.makeDependent("target_radius", "targets");
}

void addOutputOptions(CommandLine& line) {
  line.addOutputFile("output",
                     "numbers of echoes, the response, and some waveforms with echoes and "
                     "residuals for pcl_als_plot",
                     {".json"});
  line.addText("waveforms",
               "N,N,…: those of -output, by the numbers of points (pulses of a PulseWaves file) "
               "from 0 (default: examples of all numbers of echoes, and the largest residuals)")
      .in(app::Group::output);
  line.makeDependent("waveforms", "output");
  line.addFlag("only_returns", "write no new echoes").in(app::Group::output);
  line.addFlag("move_returns", "move returns along their pulse to their echoes")
      .in(app::Group::output);
}

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_waveform",
      "decomposes the waveforms of a LAS or LAZ file (point formats 4, 5, 9 and 10, packets in the "
      "file or in a .wdp beside it) or of a PulseWaves file (.pls with its .wvs) into echoes, and "
      "writes all of them as points.\n"
      "Extra bytes: amplitude (digitizer counts), echo_width and echo_width_std (full width at "
      "half maximum, ns), range_std (m), number_of_samples_saturated, new_echo (1: an echo that "
      "the scanner did not return; it is flagged as synthetic), and with -trajectory "
      "cross_section (m2) and backscatter_coefficient by the radar equation (Wagner 2010). "
      "Everything else of the records is "
      "kept; return numbers follow the times of the echoes where some are added. The pulses of a "
      "PulseWaves file have no returns: all echoes are new, and the extra byte channel is that of "
      "the receiver.",
      "IN OUT [options]", "pcl_als_waveform strip1.las echoes.laz -pulse_width 4.8");
  line.setArguments({{"", 1, 1, {".las", ".laz"}}});
  line.addNumber("pulse_width",
                 "full width at half maximum of the response of the system to a point target, a "
                 "Gaussian (default: the mean of emitted pulses of a PulseWaves file, otherwise "
                 "the response is estimated from single echoes)",
                 std::nullopt, {0.05, 1000.0, "ns"})
      .in(app::Group::inputs);
  line.addInputFile("pulse",
                    "the response by samples, such as the emitted pulse: CSV time_ns,value, evenly "
                    "spaced, with a baseline of zero");
  line.exclude({"pulse_width", "pulse"});
  line.addOutputFile("pulse_output", "the response that was used, by samples that -pulse reads",
                     {".csv"});
  line.addNumber("false_echoes", "expected number of false echoes in a waveform", 3e-4,
                 {1e-9, 0.1, ""});
  line.addNumber("ringing",
                 "exclude echoes behind a stronger one that are smaller than this share of its "
                 "amplitude",
                 0.0, {0.0, 0.9, ""});
  line.addNumber("ringing_reach", "time behind an echo in which -ringing applies", 30.0,
                 {0.0, 10000.0, "ns"});
  line.addNumber("saturation",
                 "digitizer count from which a sample is saturated (default: the largest that the "
                 "bits of a sample hold)",
                 std::nullopt, {1.0, 4294967295.0, "counts"});
  addOutputOptions(line);
  line.addChoice("range_from",
                 "where the times of echoes of a PulseWaves file count from: anchor, as stored, or "
                 "the emitted pulse of the same pulse (default: emitted where the file states "
                 "when the samples of emitted pulses begin)",
                 {"anchor", "emitted"});
  addCrossSectionOptions(line);
  return line;
}

CrossSectionSettings crossSections(const CommandLine& line) {
  CrossSectionSettings settings;
  app::checkFlightOptions(line);
  if (!line.has("trajectory")) return settings;
  const std::vector<std::string>& files = line.inputs();
  const PointReference reference = commonReference(files);
  app::remarks(line, reference.remarks);
  settings.trajectory = app::loadTrajectory(line, reference.crs, 0.0, AttitudeUse::ignore, files);
  const ExtinctionChoice extinction = app::extinctionChoice(line);
  app::remark(line, extinction.remark);
  settings.gps_week = app::gpsWeek(line);
  settings.model.extinction_per_km = extinction.per_km;
  settings.model.beam_divergence = line.number("beam_divergence");
  if (line.has("calibration_constant"))
    settings.model.constant = line.number("calibration_constant");
  if (line.has("targets"))
    settings.targets = readReferenceTargets(line.text("targets"), app::unitOption(line, "targets"));
  settings.target_radius = line.number("target_radius");
  settings.correct_attenuation = line.has("correct_attenuation");
  settings.force = line.has("force");
  return settings;
}

/// The numbers of -waveforms.
std::vector<std::uint64_t> shownWaveforms(const CommandLine& line) {
  std::vector<std::uint64_t> numbers;
  for (const std::string& text : splitList(line.text("waveforms"))) {
    const auto number = valueIn<std::uint64_t>(text);
    if (!number) throw UsageError("option -waveforms: '" + text + "' is no number of a point");
    numbers.push_back(*number);
  }
  if (numbers.empty()) throw UsageError("option -waveforms: names no point");
  return numbers;
}

WaveformSettings settingsOf(const CommandLine& line) {
  WaveformSettings settings;
  if (line.has("pulse_width")) settings.pulse_width_ns = line.number("pulse_width");
  if (line.has("pulse")) {
    const PulseSamples pulse = readPulse(line.text("pulse"));
    settings.pulse = pulse.values;
    settings.pulse_spacing_ns = pulse.spacing_ns;
  }
  settings.false_echoes = line.number("false_echoes");
  settings.ringing = line.number("ringing");
  settings.ringing_reach_ns = line.number("ringing_reach");
  if (line.has("saturation")) settings.saturation = line.number("saturation");
  settings.new_echoes = !line.has("only_returns");
  settings.move_returns = line.has("move_returns");
  if (line.has("range_from"))
    settings.range_from =
        line.text("range_from") == "anchor" ? RangeOrigin::anchor : RangeOrigin::emitted;
  settings.threads = line.threads();
  settings.examples = line.has("output");
  if (line.has("waveforms")) settings.shown = shownWaveforms(line);
  settings.cross_sections = crossSections(line);
  return settings;
}

int waveform(const CommandLine& line) {
  const WaveformResult result = decomposeWaveforms(line.inputs().front(), line.output(),
                                                   settingsOf(line), app::progressOf(line));
  app::remarks(line, result.remarks);
  if (line.has("pulse_output"))
    writePulse(line.text("pulse_output"),
               {result.pulse_spacing_ns, result.pulse_first_ns, result.pulse});
  if (line.has("output"))
    writeFile(line.text("output"), waveformJson({&result, line.inputs().front(), line.output()}));
  if (!line.quiet()) std::cout << describe(result) << std::flush;
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, waveform);
}
