// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_options.h"

#include <algorithm>

#include <pcl_als/common/errors.h>

namespace pcl_als::app {
namespace {

std::vector<std::string> namesOf(const CommandLine& line, const std::string& option) {
  if (!line.has(option)) return {};
  std::vector<std::string> names = splitList(line.text(option));
  if (names.empty()) throw UsageError("option -" + option + ": names no strip");
  return names;
}

}  // namespace

void addStripOptions(CommandLine& line, bool split) {
  const OptionGroup group(line, Group::strips);
  std::string names = "use these strips only, e.g. 1,2 (names as pcl_als_info lists them";
  if (split)
    names += line.declares("trajectory") ? ", with -split and -trajectory as here"
                                         : ", with -split as here";
  line.addText("strips", names + ")");
  line.addText("without", "leave these strips out, e.g. 3,4");
  if (!split) return;
  line.addFlag(
      "split",
      "divide the points into flight lines at gaps in time, changes of course, turns (60 "
      "degrees at 1.5 degrees per second) and hovering (below 15 % of the speed of the "
      "lines): for files without source ids (lines are named line1, line2, ... in order of "
      "time; the same with the same trajectory)");
}

void addChannelOption(CommandLine& line) {
  line.addText("channels",
               "the channels of the scanner are strips of their own (3.ch0, 3.ch1, ...): "
               "scanner_channel (LAS 1.4), user_data or an extra-bytes field")
      .in(Group::strips);
}

bool choosesStrips(const CommandLine& line) {
  return line.has("strips") || line.has("without") || line.has("split");
}

StripChoice stripChoice(const CommandLine& line) {
  StripChoice choice{namesOf(line, "strips"), namesOf(line, "without"), line.has("split")};
  choice.by_channel = line.has("channels");
  for (const std::string& name : choice.without) {
    if (std::find(choice.only.begin(), choice.only.end(), name) != choice.only.end())
      throw UsageError("options -strips and -without: both name strip '" + name + "'");
  }
  return choice;
}

}  // namespace pcl_als::app
