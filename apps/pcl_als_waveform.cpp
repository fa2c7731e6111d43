// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pulse_io.h>
#include <pcl_als/processing/waveform_job.h>

#include "command_line.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_waveform",
      "decomposes the waveforms of a LAS or LAZ file (point formats 4, 5, 9 and 10, packets in the "
      "file or in a .wdp beside it) into echoes, and writes all of them as points.\n"
      "Extra bytes: amplitude (digitizer counts), echo_width and echo_width_std (full width at "
      "half maximum, ns), range_std (m), number_of_samples_saturated, new_echo (1: an echo that "
      "the "
      "scanner did not return; it is flagged as synthetic). Everything else of the records is "
      "kept; return numbers follow the times of the echoes where some are added.",
      "IN OUT [options]", "pcl_als_waveform strip1.las echoes.laz -pulse_width 4.8");
  line.setArguments({{"", 1, 1, {".las", ".laz"}}});
  line.addNumber("pulse_width",
                 "full width at half maximum of the response of the system to a point target, a "
                 "Gaussian (default: the commonest width of single echoes)",
                 std::nullopt, {0.05, 1000.0, "ns"})
      .in(app::Group::inputs);
  line.addInputFile("pulse",
                    "the response by samples, such as the emitted pulse: CSV time_ns,value, evenly "
                    "spaced, with a baseline of zero");
  line.exclude({"pulse_width", "pulse"});
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
  line.addFlag("only_returns", "write no new echoes").in(app::Group::output);
  line.addFlag("move_returns", "move returns along their pulse to their echoes")
      .in(app::Group::output);
  return line;
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
  settings.threads = line.threads();
  return settings;
}

int waveform(const CommandLine& line) {
  const WaveformResult result = decomposeWaveforms(line.inputs().front(), line.output(),
                                                   settingsOf(line), app::progressOf(line));
  app::remarks(line, result.remarks);
  if (!line.quiet()) std::cout << describe(result) << std::flush;
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, waveform);
}
