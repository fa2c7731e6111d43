// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/point_reader.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

Group usualGroup(Role role) {
  switch (role) {
    case Role::input:
      return Group::inputs;
    case Role::output:
    case Role::folder:
      return Group::output;
    default:
      return Group::others;
  }
}

}  // namespace

FolderFiles always(std::vector<std::string> names) {
  return [names = std::move(names)](const CommandLine&) { return std::optional(names); };
}

FolderFiles copiesOfInputs() {
  return [](const CommandLine& line) {
    std::vector<std::string> names;
    for (const std::string& input : line.inputs()) {
      requireCopyable(input);
      names.push_back(std::filesystem::path(input).filename().string());
    }
    return std::optional(names);
  };
}

CommandLine::CommandLine(std::string tool, std::string purpose, std::string synopsis,
                         std::string example)
    : tool_(std::move(tool)),
      purpose_(std::move(purpose)),
      synopsis_(std::move(synopsis)),
      example_(std::move(example)) {}

Option& CommandLine::add(const std::string& name, const std::string& help, Role role) {
  Option& option = options_.emplace_back();
  option.name = name, option.help = help, option.role = role;
  option.group = group_.value_or(usualGroup(role));
  return option;
}

Option& CommandLine::addFlag(const std::string& name, const std::string& help) {
  return add(name, help, Role::flag);
}

Option& CommandLine::addText(const std::string& name, const std::string& help,
                             std::optional<std::string> preset) {
  Option& option = add(name, help, Role::text);
  option.preset = std::move(preset);
  return option;
}

Option& CommandLine::addTexts(const std::string& name, const std::string& help) {
  Option& option = add(name, help, Role::text);
  option.is_list = true;
  return option;
}

Option& CommandLine::addNumber(const std::string& name, const std::string& help,
                               std::optional<double> preset, Range range) {
  Option& option = add(name, help, Role::number);
  if (preset) option.preset = shortText(*preset);
  option.range = std::move(range);
  return option;
}

Option& CommandLine::addWhole(const std::string& name, const std::string& help,
                              std::optional<std::uint64_t> preset, Range range) {
  Option& option = add(name, help, Role::whole);
  if (preset) option.preset = std::to_string(*preset);
  option.range = std::move(range);
  return option;
}

Option& CommandLine::addChoice(const std::string& name, const std::string& help,
                               std::vector<std::string> words, std::optional<std::string> preset) {
  Option& option = add(name, help, Role::choice);
  option.words = std::move(words);
  option.preset = std::move(preset);
  return option;
}

Option& CommandLine::addInputFile(const std::string& name, const std::string& help,
                                  InputFiles inputs) {
  Option& option = add(name, help, Role::input);
  option.inputs = std::move(inputs);
  return option;
}

Option& CommandLine::addInputFiles(const std::string& name, const std::string& help,
                                   InputFiles inputs) {
  Option& option = addInputFile(name, help, std::move(inputs));
  option.is_list = true;
  return option;
}

Option& CommandLine::addOutputFile(const std::string& name, const std::string& help,
                                   std::vector<std::string> extensions) {
  Option& option = add(name, help, Role::output);
  option.words = std::move(extensions);
  return option;
}

Option& CommandLine::addOutputFolder(const std::string& name, const std::string& help,
                                     FolderFiles files) {
  Option& option = add(name, help, Role::folder);
  option.files = std::move(files);
  return option;
}

void CommandLine::exclude(std::vector<std::string> names, bool needed) {
  exclusive_.emplace_back(std::move(names), needed);
}

void CommandLine::makeDependent(const std::string& name, const std::string& on) {
  dependent_.emplace_back(name, on);
}

}  // namespace pcl_als::app
