// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/report/mounting_report.h>

#include "command_line.h"
#include "flight_options.h"

namespace pcl_als::app {
namespace {

constexpr const char* kList = "list";

std::vector<std::string> conventionWords() {
  std::vector<std::string> words;
  for (const MountingConvention& convention : mountingConventions())
    words.push_back(convention.name);
  words.emplace_back(kList);
  return words;
}

void addConventionOptions(CommandLine& line) {
  const OptionGroup group(line, Group::inputs);
  line.addChoice("convention",
                 "how the program states a mounting; list prints what each one means, with its "
                 "source",
                 conventionWords());
  line.addText("order",
               "instead of a convention: the axes of the three rotations in the order of -angles, "
               "such as ZYX or ZXZ (body forward, right, down, scanner to body, degrees)");
  line.exclude({"convention", "order"}, true);
  line.addChoice("about",
                 "with -order: the axes of later rotations move with the scanner, or are fixed",
                 {"moving", "fixed"}, "moving");
  line.makeDependent("about", "order");
  line.addText("axes",
               "directions of x, y, z of the body, each r(ight) or l(eft), f(orward) or b(ack), "
               "u(p) or d(own), such as frd, flu, rfu (default: those of the convention)");
  line.addText("signs", "1 or -1 for each of -angles, -1: counted the other way (default: 1,1,1)");
  line.addChoice("direction", "what the rotation turns (default: that of the convention)",
                 {"scanner_to_body", "body_to_scanner"});
  line.addChoice("unit", "of -angles (default: that of the convention)",
                 {"deg", "rad", "gon", "arcsec"});
  line.addChoice("lever_arm_from",
                 "origin of the lever arm, which points to the other one (default: body)",
                 {"body", "scanner"});
  line.addChoice("lever_arm_axes", "axes of its components (default: body)", {"body", "scanner"});
}

CommandLine commandLine() {
  CommandLine line("pcl_als_mounting",
                   "composes the mounting angles and the lever arm to be typed into the program of "
                   "a vendor from the old ones and a calibration.",
                   "-calibration calibration.json -convention NAME -angles A,B,C [options]",
                   "pcl_als_mounting -calibration calibration.json -convention novatel -angles "
                   "0.12,-0.05,90.2 -lever_arm 0.02,0.11,-0.08");
  line.addInputFile("calibration",
                    "calibration.json or history.json of points that were computed with -angles");
  addConventionOptions(line);
  line.addText("angles", "the old angles A,B,C, in the order of the convention").in(Group::inputs);
  line.addText("lever_arm",
               "the old lever arm X,Y,Z, m (default: not known, the change of it is given)")
      .in(Group::inputs);
  line.addText("system", "the scanner, where the calibration has several systems")
      .in(Group::inputs);
  line.addNumber("range", "distance of points at which differences of angles are stated", 1000.0,
                 {1.0, 10000.0, "m"});
  line.addOutputFile("output", "mounting.json to write, with the covariance", {".json"});
  addForceOption(line, "the calibration's verdict is not \"usable\"");
  return line;
}

Eigen::Vector3d threeNumbers(const std::string& text) {
  const std::vector<double> numbers = numbersIn(text, ',');
  if (numbers.size() != 3) throw UsageError("'" + text + "' is not three numbers A,B,C");
  return {numbers[0], numbers[1], numbers[2]};
}

std::array<int, 3> threeSigns(const std::string& text) {
  const Eigen::Vector3d numbers = threeNumbers(text);
  if (!numbers.cwiseAbs().isOnes(0.0)) throw UsageError("'" + text + "' is not three of 1 and -1");
  return {int(numbers[0]), int(numbers[1]), int(numbers[2])};
}

MountingConvention conventionOf(const CommandLine& line) {
  MountingConvention convention;
  if (line.has("convention")) {
    convention = mountingConventionNamed(line.text("convention"));
  } else {
    const bool fixed_axes = line.choice("about") == 1;
    convention = line.parsed(
        "order", [&](const std::string& order) { return mountingOrder(order, fixed_axes); });
  }
  if (line.has("axes")) {
    line.parsed("axes", bodyFromAxes);
    convention.axes = line.text("axes");
  }
  if (line.has("signs")) {
    const std::array<int, 3> signs = line.parsed("signs", threeSigns);
    for (std::size_t i = 0; i < 3; ++i) convention.angles[i].sign *= signs[i];
  }
  if (line.has("direction")) convention.scanner_to_body = line.choice("direction") == 0;
  if (line.has("unit")) convention.unit = line.text("unit");
  if (line.has("lever_arm_from")) convention.lever_to_scanner = line.choice("lever_arm_from") == 0;
  if (line.has("lever_arm_axes")) convention.lever_in_body = line.choice("lever_arm_axes") == 0;
  return convention;
}

MountingInput inputOf(const CommandLine& line) {
  MountingInput input;
  input.convention = conventionOf(line);
  if (!line.has("angles")) throw UsageError("option -angles is needed, for the old angles");
  input.angles = line.parsed("angles", threeNumbers);
  if (line.has("lever_arm")) input.lever_arm = line.parsed("lever_arm", threeNumbers);
  if (line.has("system")) input.system = line.text("system");
  input.range = line.number("range");
  return input;
}

int mounting(const CommandLine& line) {
  if (line.has("convention") && line.text("convention") == kList) {
    std::cout << conventionsText() << std::flush;
    return kDone;
  }
  const std::string file = line.text("calibration");
  const MountingInput input = inputOf(line);
  const MountingReport report = reportMounting(usableCalibration(line), file, input);
  if (line.has("output")) writeFile(line.text("output"), mountingJson(report));
  if (!line.quiet()) std::cout << mountingText(report) << std::flush;
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, pcl_als::app::commandLine, pcl_als::app::mounting);
}
