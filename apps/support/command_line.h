// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/console_progress.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::app {

/// Exit statuses of every tool.
enum ExitStatus { kDone = 0, kWrongUsage = 1, kUnusableInput = 2, kNoReliableAnswer = 3 };

/** \brief Options of a tool: positional inputs and `-option value`, with one dash or two.
 *
 * `-h`, `-version`, `-quiet` and `-threads N` are common to all tools. A tool declares its own
 * through options() and reads them with get(). Unknown options, missing values and values out of
 * range are UsageError, naming the option.
 */
class CommandLine {
 public:
  /// \param tool "pcl_als_info"; \param purpose one sentence; \param synopsis "FILE…"; \param
  /// example a full command
  CommandLine(std::string tool, std::string purpose, std::string synopsis, std::string example);
  CommandLine(CommandLine&&) noexcept;
  ~CommandLine();

  /// Adds an option that takes a value: double, int or std::string.
  template <typename T>
  void add(const char* name, const char* help, const T& default_value);
  void addOptional(const char* name, const char* help);  ///< text value, absent by default
  void addNeeded(const char* name, const char* help);    ///< the same; inputs() refuses its absence
  void addFlag(const char* name, const char* help);
  /// An option with one value or more: those that follow it up to the next option or point file.
  void addList(const char* name, const char* help);

  /// Parses; returns false when help or version was printed and the tool is done. Throws
  /// UsageError.
  bool parse(int argc, const char* const* argv);

  template <typename T>
  T get(const char* name) const;
  bool has(const char* name) const;
  bool given(const char* name) const;        ///< and not the default
  std::string text(const char* name) const;  ///< of a list: separated by commas
  std::vector<std::string> list(const char* name) const;
  /// A finite number in [low, high]; UsageError naming option, value and unit otherwise.
  double number(const char* name, double low, double high, const char* unit) const;
  /// What \a parse makes of the option's text; its UsageErrors name the option.
  template <typename Parse>
  auto parsed(const char* name, const Parse& parse) const {
    try {
      return parse(text(name));
    } catch (const UsageError& error) {
      throw UsageError(std::string("option -") + name + ": " + error.what());
    }
  }
  /// The value of an int option in [low, high]; UsageError naming the option otherwise.
  int whole(const char* name, int low, int high) const;
  /// The value of a std::string option as a whole number; UsageError for anything else.
  std::uint64_t wholeNumber(const char* name) const;

  /// Positional arguments; UsageError unless their number is in [low, high], and for one that is
  /// given twice in a list of any length.
  const std::vector<std::string>& inputs(std::size_t low, std::size_t high) const;
  /// Whether the tool has an option of this name.
  bool declares(const char* name) const;
  bool quiet() const { return has("quiet"); }
  const std::string& tool() const { return tool_; }
  /// The index of the option's value among words; UsageError that lists them for another value.
  std::size_t choice(const char* name, const std::vector<std::string>& words) const;
  int threads() const { return get<int>("threads"); }
  /// "pcl_als_info 0.1.0"
  std::string toolAndVersion() const;
  /// All options that have a value, as given or by default, for a report: name, text.
  std::vector<std::pair<std::string, std::string>> settings() const;

 private:
  std::string help() const;
  bool isList(const std::string& name) const {
    return std::find(lists_.begin(), lists_.end(), name) != lists_.end();
  }
  /// "; did you mean -trajectory?" for a misspelt option; empty where none is near.
  std::string suggestionFor(const std::string& option) const;
  /// UsageError where a file to write is one that is read.
  void refuseToOverwrite() const;

  std::string tool_, purpose_, synopsis_, example_;
  struct Parser;  ///< what Boost keeps of options and values
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> inputs_, lists_, needed_;
  std::set<std::string> words_;  ///< options with a default, whose values are no files
};

using Step = ConsoleStep;

/// Shows the phases of a job, unless -quiet.
inline ProgressCallback progressOf(const CommandLine& line) {
  return consoleProgress(line.quiet());
}

/// Declares -OF_units: the unit of length of a file of coordinates that does not state one.
void addUnitsOption(CommandLine& line, const std::string& of, const std::string& what);
/// The unit that -OF_units gives; metre without it. UsageError for another word.
LengthUnit unitOption(const CommandLine& line, const std::string& of);

/// Prints an indented line of explanation, unless -quiet or empty.
void remark(const CommandLine& line, const std::string& text);
void remarks(const CommandLine& line, const std::vector<std::string>& texts);

/// Runs a tool: parses its options and turns exceptions of its job into one line on stderr
/// ("pcl_als_info: …") and the exit status.
int run(int argc, const char* const* argv, CommandLine (*options)(),
        int (*job)(const CommandLine& line));
/// The same of any body.
int run(const std::string& tool, const std::function<int()>& body);
/// Prints an exception; the exit status.
int reportFailure(const std::string& tool, const std::exception_ptr& failure);

/// Ends a tool: kDone, or where \a why states why there is no reliable answer, kNoReliableAnswer
/// with that on stderr.
int conclude(const CommandLine& line, const std::string& why);

/// The finite number from \a low to \a high that a text is; UsageError that names \a what for
/// another.
double numberIn(const std::string& text, const std::string& what,
                double low = -std::numeric_limits<double>::infinity(),
                double high = std::numeric_limits<double>::infinity());
/// The greatest coordinate that options take, metres: beyond any projected CRS.
constexpr double kFarthest = 1e9;

}  // namespace pcl_als::app
