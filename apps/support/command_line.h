// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/console_progress.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/text_values.h>

#include "option.h"

namespace pcl_als::app {

struct CommandFiles;

/// Exit statuses of every tool.
enum ExitStatus { kDone = 0, kWrongUsage = 1, kUnusableInput = 2, kNoReliableAnswer = 3 };

/** \brief Options of a tool: positional arguments and `-option value`, with one dash or two.
 *
 * A tool declares each option with the role of its value. parse() checks everything that follows
 * from the roles before the tool reads a file: unknown and missing options, numbers out of range,
 * and outputs that would replace an input, another output or, in a folder, a file of the user. All
 * of it is UsageError, naming the option; an output that cannot be written is InputError.
 *
 * `-h`, `-version`, `-list_options`, `-quiet` and `-threads N` are common to all tools.
 */
class CommandLine {
 public:
  /// \param tool "pcl_als_info"; \param purpose one sentence; \param synopsis "FILE…"; \param
  /// example a full command
  CommandLine(std::string tool, std::string purpose, std::string synopsis, std::string example);

  /// The positional arguments; none where this is not called.
  void setArguments(std::vector<Arguments> forms) { forms_ = std::move(forms); }

  Option& addFlag(const std::string& name, const std::string& help);
  Option& addText(const std::string& name, const std::string& help,
                  std::optional<std::string> preset = {});
  /// Texts: those that follow the option up to the next option or point file.
  Option& addTexts(const std::string& name, const std::string& help);
  Option& addNumber(const std::string& name, const std::string& help, std::optional<double> preset,
                    Range range);
  /// A whole number that is not negative.
  Option& addWhole(const std::string& name, const std::string& help,
                   std::optional<std::uint64_t> preset, Range range);
  Option& addChoice(const std::string& name, const std::string& help,
                    std::vector<std::string> words, std::optional<std::string> preset = {});
  /// A file that is read; \a inputs where the value is not simply its path.
  Option& addInputFile(const std::string& name, const std::string& help, InputFiles inputs = {});
  /// The same of several, as addTexts().
  Option& addInputFiles(const std::string& name, const std::string& help, InputFiles inputs = {});
  /// A file that is written, with the extensions that the tool writes; the first one is usual.
  Option& addOutputFile(const std::string& name, const std::string& help,
                        std::vector<std::string> extensions);
  /// A folder that is made where it is missing, with the names of the files that are written there.
  Option& addOutputFolder(const std::string& name, const std::string& help, FolderFiles files);

  /// At most one of the options may be given, defaults apart; with \a needed, one must.
  void exclude(std::vector<std::string> names, bool needed = false);
  /// The option has an effect only with another one: without it, it is refused, its default apart.
  void makeDependent(const std::string& name, const std::string& on);

  /// Parses and checks; returns false when help or version was printed and the tool is done.
  bool parse(int argc, const char* const* argv);

  bool has(const std::string& name) const;                       ///< given, or with a default
  bool given(const std::string& name) const;                     ///< and not the default
  std::string text(const std::string& name) const;               ///< of a list: separated by commas
  std::vector<std::string> list(const std::string& name) const;  ///< empty where it is not given
  double number(const std::string& name) const;
  std::uint64_t whole(const std::string& name) const;
  std::size_t choice(const std::string& name) const;  ///< the index of the word
  /// What \a parse makes of the option's text; its UsageErrors name the option.
  template <typename Parse>
  auto parsed(const std::string& name, const Parse& parse) const {
    try {
      return parse(text(name));
    } catch (const UsageError& error) {
      throw UsageError("option -" + name + ": " + error.what());
    }
  }

  /// The input files among the positional arguments.
  const std::vector<std::string>& inputs() const { return inputs_; }
  /// The output among them; empty in a form without.
  const std::string& output() const { return output_; }
  /// The files that the options read, in the order of their declaration.
  std::vector<std::filesystem::path> optionInputs() const;

  /// Whether the tool has an option of this name.
  bool declares(const std::string& name) const { return find(name) != nullptr; }
  /// Null where it has none.
  const Option* find(const std::string& name) const;
  const std::deque<Option>& options() const { return options_; }
  const std::vector<Arguments>& forms() const { return forms_; }
  const Arguments& form() const;  ///< of this command
  bool quiet() const { return has("quiet"); }
  const std::string& tool() const { return tool_; }
  int threads() const { return static_cast<int>(whole("threads")); }
  /// "pcl_als_info 0.2.0"
  std::string toolAndVersion() const;
  std::string help() const;
  /// All settings that have a value, as given or by default, for a report: name, text.
  std::vector<std::pair<std::string, std::string>> settings() const;

 private:
  friend class OptionGroup;
  Option& add(const std::string& name, const std::string& help, Role role);
  const Option& declared(const std::string& name) const;
  /// The option of this name or former name, with the former one; null where there is none.
  std::pair<const Option*, const FormerName*> named(const std::string& name) const;
  void read(const std::vector<std::string>& words);
  std::size_t readOption(const std::vector<std::string>& words, std::size_t at);
  void take(const Option& option, const std::string& value);
  bool isOption(const std::string& word) const;
  void checkRelations() const;
  void takeArguments();
  void protect(const CommandFiles& files);
  void printRenamed() const;
  [[noreturn]] void refuseUnknown(const std::string& option) const;

  std::string tool_, purpose_, synopsis_, example_;
  std::deque<Option> options_;
  std::optional<Group> group_;  ///< of the options that are being declared
  std::vector<Arguments> forms_{{}};
  std::vector<std::pair<std::vector<std::string>, bool>> exclusive_;
  std::vector<std::pair<std::string, std::string>> dependent_;
  std::map<std::string, std::vector<std::string>> values_;  ///< of the options that are given
  std::vector<std::string> arguments_, inputs_;
  std::vector<std::string> renamed_;  ///< remarks about former names that are used
  std::string output_;
  FileProtection protection_;
};

/** \brief Options that are declared during its lifetime belong to one part of -h.
 *
 * Other options belong to a part by their role: files that are read to the inputs, files and
 * folders that are written to the output, all others to further options.
 */
class OptionGroup {
 public:
  OptionGroup(CommandLine& line, Group group) : line_(line), before_(line.group_) {
    line.group_ = group;
  }
  ~OptionGroup() { line_.group_ = before_; }
  OptionGroup(const OptionGroup&) = delete;
  OptionGroup& operator=(const OptionGroup&) = delete;

 private:
  CommandLine& line_;
  std::optional<Group> before_;
};

using Step = ConsoleStep;

/// Shows the phases of a job, unless -quiet.
inline ProgressCallback progressOf(const CommandLine& line) {
  return consoleProgress(line.quiet());
}

/// Declares -OF_units: the unit of length of a file of coordinates that does not state one.
void addUnitsOption(CommandLine& line, const std::string& of, const std::string& what);
/// The unit that -OF_units gives; metre without it.
LengthUnit unitOption(const CommandLine& line, const std::string& of);

/// Prints an indented line of explanation, unless -quiet or empty.
void remark(const CommandLine& line, const std::string& text);
void remarks(const CommandLine& line, const std::vector<std::string>& texts);

/// Runs a tool: parses its options and turns exceptions of its job into one line on stderr
/// ("pcl_als_info: …") and the exit status.
int run(int argc, const char* const* argv, CommandLine (*options)(),
        int (*job)(const CommandLine& line));
/// The same of any body.
int run(const CommandLine& line, const std::function<int()>& body);
/// Prints an exception; the exit status.
int reportFailure(const CommandLine& line, const std::exception_ptr& failure);

/// Ends a tool: kDone, or where \a why states why there is no reliable answer, kNoReliableAnswer
/// with that on stderr.
int conclude(const CommandLine& line, const std::string& why);

/// The greatest coordinate that options take, metres: beyond any projected CRS.
constexpr double kFarthest = 1e9;

}  // namespace pcl_als::app
