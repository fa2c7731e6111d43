// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <set>
#include <sstream>
#include <type_traits>

#include <boost/program_options.hpp>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/nearest_name.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/common/thread_limit.h>

#include "interruption.h"
#include "output_check.h"
#include "remedy_options.h"
#include "standard_streams.h"

namespace po = boost::program_options;

namespace pcl_als::app {

namespace {

/// The arguments of a tool with the name of an option of \a lists before each of its values: those
/// that follow it up to the next option or point file (.las, .laz, .pcd), which is an input.
std::vector<std::string> spreadLists(int argc, const char* const* argv,
                                     const std::vector<std::string>& lists) {
  static const std::set<std::string> kPoints = {".las", ".laz", ".pcd"};
  std::vector<std::string> spread;
  std::string list;  // the option whose values may follow
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t name = argument.find_first_not_of('-');
    if (argument.size() > 1 && argument.front() == '-') {
      const bool known =
          name != std::string::npos && i + 1 < argc &&
          std::find(lists.begin(), lists.end(), argument.substr(name)) != lists.end();
      spread.push_back(argument);
      list = known ? argument : std::string();
      if (known) spread.emplace_back(argv[++i]);
      continue;
    }
    const bool value = !list.empty() && kPoints.count(lowerExtension(argument)) == 0;
    if (value) spread.push_back(list);
    if (!value) list.clear();
    spread.push_back(argument);
  }
  return spread;
}

}  // namespace

struct CommandLine::Parser {
  po::options_description options{"Options (one dash or two)", 100, 60};
  po::variables_map values;
};

CommandLine::CommandLine(std::string tool, std::string purpose, std::string synopsis,
                         std::string example)
    : tool_(std::move(tool)),
      purpose_(std::move(purpose)),
      synopsis_(std::move(synopsis)),
      example_(std::move(example)),
      parser_(std::make_unique<Parser>()) {}

CommandLine::CommandLine(CommandLine&&) noexcept = default;
CommandLine::~CommandLine() = default;

template <typename T>
void CommandLine::add(const char* name, const char* help, const T& default_value) {
  auto* const value = po::value<T>();
  if constexpr (std::is_floating_point_v<T>) {
    value->default_value(default_value, shortText(default_value));
  } else {
    value->default_value(default_value);
    words_.insert(name);
  }
  parser_->options.add_options()(name, value, help);
}

template <typename T>
T CommandLine::get(const char* name) const {
  return parser_->values[name].as<T>();
}

template void CommandLine::add(const char*, const char*, const double&);
template void CommandLine::add(const char*, const char*, const int&);
template void CommandLine::add(const char*, const char*, const std::string&);
template std::vector<std::string> CommandLine::get(const char*) const;
template double CommandLine::get(const char*) const;
template int CommandLine::get(const char*) const;
template std::string CommandLine::get(const char*) const;

void CommandLine::addOptional(const char* name, const char* help) {
  parser_->options.add_options()(name, po::value<std::string>(), help);
}

void CommandLine::addNeeded(const char* name, const char* help) {
  needed_.emplace_back(name);
  addOptional(name, (std::string(help) + " (needed)").c_str());
}

void CommandLine::addFlag(const char* name, const char* help) {
  parser_->options.add_options()(name, help);
}

void CommandLine::addList(const char* name, const char* help) {
  lists_.emplace_back(name);
  parser_->options.add_options()(name, po::value<std::vector<std::string>>(), help);
}

std::vector<std::string> CommandLine::list(const char* name) const {
  return get<std::vector<std::string>>(name);
}

std::string CommandLine::text(const char* name) const {
  if (!isList(name)) return get<std::string>(name);
  std::string joined;
  for (const std::string& value : list(name)) joined += (joined.empty() ? "" : ",") + value;
  return joined;
}

std::string CommandLine::help() const {
  std::ostringstream text;
  text << tool_ << ": " << purpose_ << "\n\nUsage: " << tool_ << ' ' << synopsis_ << "\n\n"
       << parser_->options << "\nExample:\n  " << example_
       << "\n\nExit status: 0 done, 1 wrong usage, 2 unusable input, 3 no reliable numerical "
          "answer.\n";
  return text.str();
}

bool CommandLine::parse(int argc, const char* const* argv) {
  add<int>("threads", "number of threads; 0: all cores", 0);
  addFlag("quiet", "print nothing but errors");
  addFlag("help,h", "print this help");
  addFlag("version", "print the version");
  po::options_description all;
  all.add(parser_->options).add_options()("input", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("input", -1);
  const int style =
      (po::command_line_style::unix_style | po::command_line_style::allow_long_disguise) &
      ~po::command_line_style::allow_guessing;
  try {
    po::store(po::command_line_parser(spreadLists(argc, argv, lists_))
                  .options(all)
                  .positional(positional)
                  .style(style)
                  .run(),
              parser_->values);
    po::notify(parser_->values);
  } catch (const po::unknown_option& error) {
    throw UsageError(error.what() + suggestionFor(error.get_option_name()) + " (see " + tool_ +
                     " -h)");
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + " (see " + tool_ + " -h)");
  }
  if (has("help")) {
    std::cout << help();
    return false;
  }
  if (has("version")) {
    std::cout << toolAndVersion() << '\n';
    return false;
  }
  if (parser_->values.count("input") != 0)
    inputs_ = parser_->values["input"].as<std::vector<std::string>>();
  if (get<int>("threads") < 0) throw UsageError("option -threads: must be 0 or more");
  limitThreads(get<int>("threads"));
  refuseToOverwrite();
  return true;
}

std::string CommandLine::suggestionFor(const std::string& option) const {
  std::vector<std::string> names;
  for (const auto& known : parser_->options.options()) names.push_back(known->long_name());
  const std::size_t start = option.find_first_not_of('-');
  if (start == std::string::npos) return {};
  const std::string name = nearestName(option.substr(start, option.find('=') - start), names);
  return name.empty() ? std::string() : "; did you mean -" + name + "?";
}

void CommandLine::refuseToOverwrite() const {
  static const std::set<std::string> outputs{"output", "json",       "accuracy",
                                             "grids",  "posterior",  "checked",
                                             "map",    "save_model", "transformed"};
  std::vector<std::filesystem::path> inputs(inputs_.begin(), inputs_.end());
  std::vector<std::pair<std::string, std::string>> written;
  for (const auto& [name, value] : parser_->values) {
    if (isList(name))
      for (const std::string& path : list(name.c_str())) inputs.emplace_back(path);
    const auto* text = boost::any_cast<std::string>(&value.value());
    if (text == nullptr || words_.count(name) != 0) continue;
    if (outputs.count(name) != 0)
      written.emplace_back(name, *text);
    else
      inputs.emplace_back(*text);
  }
  for (const auto& [name, path] : written) refuseInput(name, path, inputs);
}

bool CommandLine::has(const char* name) const {
  return parser_->values.count(name) != 0;
}

bool CommandLine::declares(const char* name) const {
  return parser_->options.find_nothrow(name, false) != nullptr;
}

bool CommandLine::given(const char* name) const {
  return has(name) && !parser_->values[name].defaulted();
}

double CommandLine::number(const char* name, double low, double high, const char* unit) const {
  const double value = get<double>(name);
  if (std::isfinite(value) && value >= low && value <= high) return value;
  std::ostringstream text;
  text << "option -" << name << ": " << value << ' ' << unit << " is outside [" << low << ", "
       << high << "]";
  throw UsageError(text.str());
}

const std::vector<std::string>& CommandLine::inputs(std::size_t low, std::size_t high) const {
  if (inputs_.size() >= low && inputs_.size() <= high) {
    // Of a list; where each input has a part of its own, the tool says what may be the same.
    if (high > 2) refuseRepeated(inputs_);
    for (const std::string& name : needed_)
      if (!has(name.c_str()))
        throw UsageError("option -" + name + " is needed (see " + tool_ + " -h)");
    return inputs_;
  }
  throw UsageError("usage: " + tool_ + ' ' + synopsis_ + " (see " + tool_ + " -h)");
}

std::string CommandLine::toolAndVersion() const {
  return tool_ + " " + PCL_ALS_VERSION;
}

std::vector<std::pair<std::string, std::string>> CommandLine::settings() const {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const auto& [name, value] : parser_->values) {
    if (name == "input") continue;
    std::ostringstream text;
    if (const auto* number = boost::any_cast<double>(&value.value())) text << *number;
    if (const auto* whole = boost::any_cast<int>(&value.value())) text << *whole;
    if (const auto* word = boost::any_cast<std::string>(&value.value()))
      text << (word->empty() ? "yes" : *word);
    if (isList(name)) text << this->text(name.c_str());
    settings.emplace_back(name, text.str());
  }
  return settings;
}

void addUnitsOption(CommandLine& line, const std::string& of, const std::string& what) {
  const std::string help =
      "unit of the coordinates in " + what + ": m, ft (international) or us_ft (US survey foot)";
  line.add<std::string>((of + "_units").c_str(), help.c_str(), "m");
}

LengthUnit unitOption(const CommandLine& line, const std::string& of) {
  return lengthUnitNamed(line.text((of + "_units").c_str()), "option -" + of + "_units");
}

void remark(const CommandLine& line, const std::string& text) {
  if (!text.empty() && !line.quiet()) std::cout << "  " << text << std::endl;
}

void remarks(const CommandLine& line, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) remark(line, text);
}

int run(int argc, const char* const* argv, CommandLine (*options)(),
        int (*job)(const CommandLine&)) {
  CommandLine line = options();
  return run(line.tool(), [&] { return line.parse(argc, argv) ? job(line) : kDone; });
}

int conclude(const CommandLine& line, const std::string& why) {
  if (why.empty()) return kDone;
  std::cerr << line.tool() << ": no reliable answer: " << why << std::endl;
  return kNoReliableAnswer;
}

int reportFailure(const std::string& tool, const std::exception_ptr& failure) {
  const auto failed = [&tool](std::string message, int status) {
    // What a file holds in place of text must not reach the terminal.
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    std::replace_if(message.begin(), message.end(), control, '?');
    std::cerr << tool << ": " << message << std::endl;
    return status;
  };
  try {
    std::rethrow_exception(failure);
  } catch (const UsageError& error) {
    return failed(withOption(error), kWrongUsage);
  } catch (const Error& error) {
    return failed(withOption(error), kUnusableInput);
  } catch (const std::bad_alloc&) {
    return failed("not enough memory", kUnusableInput);
  } catch (const std::exception& error) {
    return failed(error.what(), kUnusableInput);
  }
}

int run(const std::string& tool, const std::function<int()>& body) {
  openStandardStreams();
  removeUnfinishedFilesOnSignals();
  reportAborts(tool.c_str());
  try {
    const int status = body();
    const char* reason = "";
    if (flushStandardOutput(reason) || status != kDone) return status;
    throw InputError(std::string("cannot write to standard output: ") + reason);
  } catch (...) {
    return reportFailure(tool, std::current_exception());
  }
}

double numberIn(const std::string& text, const std::string& what, double low, double high) {
  const auto value = finiteNumber(text);
  if (value && *value >= low && *value <= high) return *value;
  std::ostringstream message;
  message << what << ": '" << text << "' is not a ";
  if (std::isfinite(low))
    message << "number from " << low << " to " << high;
  else
    message << "finite number";
  throw UsageError(message.str());
}

std::size_t CommandLine::choice(const char* name, const std::vector<std::string>& words) const {
  const auto found = std::find(words.begin(), words.end(), text(name));
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  throw UsageError(std::string("option -") + name + ": '" + text(name) + "' is none of " +
                   joined(words));
}

int CommandLine::whole(const char* name, int low, int high) const {
  const int value = get<int>(name);
  if (value >= low && value <= high) return value;
  throw UsageError(std::string("option -") + name + ": " + std::to_string(value) + " is outside [" +
                   std::to_string(low) + ", " + std::to_string(high) + "]");
}

std::uint64_t CommandLine::wholeNumber(const char* name) const {
  if (const auto value = valueIn<std::uint64_t>(text(name))) return *value;
  throw UsageError(std::string("option -") + name + ": '" + text(name) +
                   "' is not a whole number from 0 to 18446744073709551615");
}

}  // namespace pcl_als::app
