// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_als::app {

class CommandLine;

/// What the value of an option is.
enum class Role { flag, text, number, whole, choice, input, output, folder };

/// The part of -h that lists an option, in the order of the parts.
enum class Group { inputs, strips, estimation, priors, output, others };

/// A name that an option had in the release before, with the factor from its unit to today's.
struct FormerName {
  std::string name;
  double factor = 1.0;
};

/// The numbers that an option takes, with their unit ("" for factors and the like).
struct Range {
  double low, high;
  std::string unit = {};
};

/// The files that an option reads, also one that is not given and has a default file.
using InputFiles = std::function<std::vector<std::filesystem::path>(const CommandLine&)>;

/** \brief The names of the files that are written into an output folder, without it; `*` stands for
 * any characters. Nothing where the output is a file in spite of that.
 */
using FolderFiles = std::function<std::optional<std::vector<std::string>>(const CommandLine&)>;
/// Names that are the same whatever the other options.
FolderFiles always(std::vector<std::string> names);
/// The names of the point files that are positional arguments. InputError for one of which no copy
/// can be written (requireCopyable()).
FolderFiles copiesOfInputs();

/** \brief An option of a tool with its role, from which follow the checks of its value, of files
 * that are read against those that are written, and its line in -h.
 */
struct Option {
  std::string name, help;
  Role role = Role::text;
  Group group = Group::others;  ///< by its role, where nothing else is said
  bool is_needed = false;
  bool is_setting = true;             ///< listed by CommandLine::settings()
  bool is_list = false;               ///< takes the values that follow it, and may be repeated
  std::optional<std::string> preset;  ///< the value where none is given
  Range range{0.0, 0.0, {}};          ///< of numbers
  std::vector<std::string> words;     ///< of a choice; extensions of an output file
  std::vector<FormerName> former;     ///< accepted with a remark for one release
  InputFiles inputs;                  ///< of role input
  FolderFiles files;                  ///< of an output that is or may be a folder

  /// Results do not depend on it: reports and records of the command leave it out.
  Option& noSetting() {
    is_setting = false;
    return *this;
  }
  /// -h lists it in this part.
  Option& in(Group part) {
    group = part;
    return *this;
  }
  /// Accepts a former name. Numbers given by it are multiplied by \a factor.
  Option& formerly(std::string former_name, double factor = 1.0) {
    former.push_back({std::move(former_name), factor});
    return *this;
  }
  /// The command is refused without it.
  Option& needed() {
    is_needed = true;
    return *this;
  }
};

/** \brief The arguments of a tool that are no options: input files and, in some tools, an output.
 *
 * A tool has one form for commands with the option \a with and one, whose \a with is empty, for all
 * others.
 */
struct Arguments {
  static constexpr std::size_t kAnyNumber = 100000;

  std::string with;
  std::size_t least = 0, most = 0;    ///< number of input files
  std::vector<std::string> out = {};  ///< extensions of the output that follows; empty: none
  FolderFiles files = {};             ///< where that output may be a folder

  /// A folder may stand for the point files in it.
  bool isList() const { return most == kAnyNumber; }
};

}  // namespace pcl_als::app
