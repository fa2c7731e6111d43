// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "command_line.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <stdexcept>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/nearest_name.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/point_files.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/common/thread_limit.h>

#include "argument_files.h"
#include "option_text.h"
#include "output_check.h"

namespace pcl_als::app {

namespace {

/// "-line_fit", "--line_fit=x" or "--line-fit" → "line_fit".
std::string nameIn(const std::string& word) {
  const std::size_t start = word.compare(0, 2, "--") == 0 ? 2 : 1;
  std::string name = word.substr(start, word.find('=') - start);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// The value in today's unit of the option; \a former: the name by which it is given, if that is a
/// former one.
std::string inUnitOf(const FormerName* former, const std::string& value) {
  const auto number = finiteNumber(value);
  const bool is_same = former == nullptr || former->factor == 1.0 || !number;
  return is_same ? value : shortText(*number * former->factor);
}

/// UsageError unless an option takes the value.
void checkValue(const Option& option, const std::string& value) {
  const auto refuse = [&](const std::string& what) {
    throw UsageError("option -" + option.name + ": '" + value + "' is " + what);
  };
  if (option.role == Role::number) {
    const auto number = finiteNumber(value);
    if (!number || *number < option.range.low || *number > option.range.high)
      refuse("not a number from " + rangeText(option));
  } else if (option.role == Role::whole) {
    const auto number = valueIn<std::uint64_t>(value);
    if (!number || static_cast<double>(*number) < option.range.low ||
        static_cast<double>(*number) > option.range.high)
      refuse("not a whole number from " + rangeText(option));
  } else if (option.role == Role::choice) {
    if (std::find(option.words.begin(), option.words.end(), value) == option.words.end())
      refuse("none of " + joined(option.words));
  } else if (option.role != Role::text && value.empty()) {
    throw UsageError("option -" + option.name + ": names no file");
  }
}

}  // namespace

bool CommandLine::parse(int argc, const char* const* argv) {
  addWhole("threads", "number of threads; 0: all cores", 0,
           {0, std::numeric_limits<int>::max(), {}});
  addFlag("quiet", "print nothing but errors");
  addFlag("help", "print this help; -h is the same");
  addFlag("list_options", "print the options as a table of values separated by tabs");
  addFlag("version", "print the version");
  read(withArgumentFiles({argv + 1, argv + argc}));
  printRenamed();
  const std::pair<const char*, std::function<std::string()>> answers[] = {
      {"help", [this] { return help(); }},
      {"version", [this] { return toolAndVersion() + '\n'; }},
      {"list_options", [this] { return optionTable(*this); }}};
  for (const auto& [name, text] : answers) {
    if (!has(name)) continue;
    std::cout << text();
    return false;
  }
  takeArguments();
  const CommandFiles files = filesOf(*this);
  refuseLosses(files);
  checkRelations();
  checkWritable(files);
  protect(files);
  limitThreads(threads());
  return true;
}

void CommandLine::read(const std::vector<std::string>& words) {
  for (std::size_t at = 0; at < words.size();) {
    if (words[at] == "--") {
      arguments_.insert(arguments_.end(), words.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                        words.end());
      return;
    }
    if (words[at].size() > 1 && words[at].front() == '-')
      at = readOption(words, at);
    else
      arguments_.push_back(words[at++]);
  }
}

/// The option at a word with its values; the position after them.
std::size_t CommandLine::readOption(const std::vector<std::string>& words, std::size_t at) {
  const std::string& word = words[at++];
  const std::string name = nameIn(word) == "h" ? "help" : nameIn(word);
  const auto [option, former] = named(name);
  if (option == nullptr) refuseUnknown(name);
  if (former != nullptr)
    renamed_.push_back("option -" + name + " is now called -" + option->name +
                       "; the next release does not accept the former name");
  const std::size_t equals = word.find('=');
  if (option->role == Role::flag) {
    if (equals != std::string::npos) throw UsageError("option -" + name + ": takes no value");
    take(*option, "yes");
    return at;
  }
  if (equals != std::string::npos) {
    take(*option, inUnitOf(former, word.substr(equals + 1)));
  } else {
    if (at == words.size() || isOption(words[at]))
      throw UsageError("option -" + name + ": needs a value (see " + tool_ + " -h)");
    take(*option, inUnitOf(former, words[at++]));
  }
  const auto continues = [](const std::string& next) {
    return (next.size() < 2 || next.front() != '-') && !isPointFile(next);
  };
  while (option->is_list && at < words.size() && continues(words[at])) take(*option, words[at++]);
  return at;
}

void CommandLine::take(const Option& option, const std::string& value) {
  std::vector<std::string>& values = values_[option.name];
  if (!values.empty() && !option.is_list)
    throw UsageError("option -" + option.name + ": is given twice");
  checkValue(option, value);
  values.push_back(value);
}

bool CommandLine::isOption(const std::string& word) const {
  return word.size() > 1 && word.front() == '-' &&
         (nameIn(word) == "h" || named(nameIn(word)).first != nullptr);
}

void CommandLine::printRenamed() const {
  if (quiet()) return;
  for (const std::string& text : renamed_) std::cerr << tool_ << ": " << text << std::endl;
}

void CommandLine::refuseUnknown(const std::string& option) const {
  std::vector<std::string> names;
  for (const Option& known : options_) names.push_back(known.name);
  const std::string near = nearestName(option, names);
  throw UsageError("unrecognised option '-" + option + "'" +
                   (near.empty() ? "" : "; did you mean -" + near + "?") + " (see " + tool_ +
                   " -h)");
}

void CommandLine::takeArguments() {
  const Arguments& wanted = form();
  const std::size_t out = wanted.out.empty() ? 0 : 1;
  if (arguments_.size() >= out)
    inputs_.assign(arguments_.begin(), arguments_.end() - static_cast<std::ptrdiff_t>(out));
  if (wanted.isList()) inputs_ = withFilesOfFolders(inputs_);
  if (arguments_.size() < out || inputs_.size() < wanted.least || inputs_.size() > wanted.most)
    throw UsageError("usage: " + tool_ + ' ' + synopsis_ + " (see " + tool_ + " -h)");
  if (out > 0) output_ = arguments_.back();
  // Of a list; where each input has a part of its own, the tool says what may be the same.
  if (wanted.most > 2) refuseRepeated(inputs_);
}

void CommandLine::checkRelations() const {
  for (const auto& [names, needed] : exclusive_) {
    const auto count = std::count_if(names.begin(), names.end(),
                                     [this](const std::string& name) { return given(name); });
    std::string options;
    for (const std::string& name : names)
      options += (options.empty() ? "-" : name == names.back() ? " and -" : ", -") + name;
    if (count > 1) throw UsageError("options " + options + " exclude each other");
    if (count == 0 && needed)
      throw UsageError("one of the options " + options + " is needed (see " + tool_ + " -h)");
  }
  for (const auto& [name, on] : dependent_)
    if (given(name) && !has(on)) throw UsageError("option -" + name + " needs -" + on);
  for (const Option& option : options_)
    if (option.is_needed && !has(option.name))
      throw UsageError("option -" + option.name + " is needed (see " + tool_ + " -h)");
}

void CommandLine::protect(const CommandFiles& files) {
  for (const CommandFiles::Input& input : files.inputs) protection_.keep(input.path);
  for (const CommandFiles::Output& output : files.outputs) {
    if (output.is_folder)
      protection_.guard(output.path);
    else
      protection_.allow(output.path);
  }
}

const Arguments& CommandLine::form() const {
  for (const Arguments& form : forms_)
    if (!form.with.empty() && has(form.with)) return form;
  const auto usual = std::find_if(forms_.begin(), forms_.end(),
                                  [](const Arguments& form) { return form.with.empty(); });
  if (usual == forms_.end()) throw std::logic_error(tool_ + ": has no usual form");
  return *usual;
}

std::vector<std::filesystem::path> CommandLine::optionInputs() const {
  std::vector<std::filesystem::path> files;
  for (const CommandFiles::Input& input : filesOf(*this).inputs)
    if (!input.option.empty()) files.push_back(input.path);
  return files;
}

const Option* CommandLine::find(const std::string& name) const {
  const auto found = std::find_if(options_.begin(), options_.end(),
                                  [&](const Option& option) { return option.name == name; });
  return found == options_.end() ? nullptr : &*found;
}

std::pair<const Option*, const FormerName*> CommandLine::named(const std::string& name) const {
  if (const Option* option = find(name)) return {option, nullptr};
  for (const Option& option : options_)
    for (const FormerName& former : option.former)
      if (former.name == name) return {&option, &former};
  return {nullptr, nullptr};
}

const Option& CommandLine::declared(const std::string& name) const {
  if (const Option* option = find(name)) return *option;
  throw std::logic_error(tool_ + ": option -" + name + " is not declared");
}

bool CommandLine::has(const std::string& name) const {
  const Option* const option = find(name);
  return option != nullptr && (option->preset || given(name));
}

bool CommandLine::given(const std::string& name) const {
  return values_.count(name) != 0;
}

std::vector<std::string> CommandLine::list(const std::string& name) const {
  const Option& option = declared(name);
  const auto found = values_.find(name);
  if (found != values_.end()) return found->second;
  return option.preset ? std::vector<std::string>{*option.preset} : std::vector<std::string>();
}

std::string CommandLine::text(const std::string& name) const {
  const std::vector<std::string> values = list(name);
  if (values.empty()) throw UsageError("option -" + name + " is needed (see " + tool_ + " -h)");
  std::string text = values.front();
  for (std::size_t i = 1; i < values.size(); ++i) text += "," + values[i];
  return text;
}

double CommandLine::number(const std::string& name) const {
  return finiteNumber(text(name)).value();
}

std::uint64_t CommandLine::whole(const std::string& name) const {
  return valueIn<std::uint64_t>(text(name)).value();
}

std::size_t CommandLine::choice(const std::string& name) const {
  const std::vector<std::string>& words = declared(name).words;
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), text(name)) -
                                  words.begin());
}

std::string CommandLine::toolAndVersion() const {
  return tool_ + " " + PCL_ALS_VERSION;
}

std::string CommandLine::help() const {
  const bool takes_folders = std::any_of(forms_.begin(), forms_.end(),
                                         [](const Arguments& form) { return form.isList(); });
  return tool_ + ": " + purpose_ + "\n\nUsage: " + tool_ + ' ' + synopsis_ +
         "\n\n@FILE stands for the words in FILE" +
         (takes_folders ? ", a folder for the point files in it." : ".") +
         "\n\nOptions (one dash or two):\n" + optionHelp(options_) + "\nExample:\n  " + example_ +
         "\n\nExit status: 0 done, 1 wrong usage, 2 unusable input, 3 no reliable numerical "
         "answer.\n";
}

std::vector<std::pair<std::string, std::string>> CommandLine::settings() const {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const Option& option : options_)
    if (option.is_setting && has(option.name))
      settings.emplace_back(option.name, text(option.name));
  std::sort(settings.begin(), settings.end());
  return settings;
}

}  // namespace pcl_als::app
