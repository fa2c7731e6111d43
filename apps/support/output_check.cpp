// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "output_check.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include <fnmatch.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;
using Input = CommandFiles::Input;
using Output = CommandFiles::Output;

/// "option -report: PATH", or the path of a positional argument.
std::string placeOf(const Output& output, const fs::path& path) {
  return (output.option.empty() ? "" : "option -" + output.option + ": ") + path.string();
}

/// The files that an output stands for; of names with * those that are there.
std::vector<fs::path> filesIn(const Output& output) {
  if (!output.is_folder) return {output.path};
  std::vector<fs::path> files;
  std::error_code error;
  for (const std::string& name : output.files) {
    if (name.find('*') == std::string::npos) {
      files.push_back(output.path / name);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(output.path, error))
      if (fnmatch(name.c_str(), entry.path().filename().c_str(), 0) == 0)
        files.push_back(entry.path());
  }
  return files;
}

void checkExtension(const Output& output) {
  if (output.is_folder || output.extensions.empty()) return;
  const std::string extension = lowerExtension(output.path);
  for (const std::string& known : output.extensions)
    if (extension == known) return;
  throw UsageError(placeOf(output, output.path) + ": the name does not end in " +
                   joined(output.extensions));
}

bool isSame(const fs::path& one, const fs::path& other) {
  std::error_code error;
  return fs::equivalent(one, other, error) || normalizedPath(one) == normalizedPath(other);
}

void refuseInputs(const Output& output, const std::vector<Input>& inputs) {
  std::vector<fs::path> files = filesIn(output);
  files.push_back(output.path);  // a folder, too, must not be a file that is read
  std::error_code error;
  for (const Input& input : inputs) {
    for (const fs::path& file : files) {
      if (fs::is_directory(file, error) || !isSame(file, input.path)) continue;
      throw UsageError(placeOf(output, file) + " is also an input" +
                       (input.option.empty() ? "" : " (-" + input.option + ")") +
                       "; name another " + (output.is_folder ? "folder" : "file"));
    }
  }
}

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// Whether an output, other than a folder, is one of the files that go into a folder.
bool isWrittenInto(const Output& folder, const Output& file) {
  if (normalizedPath(fs::absolute(file.path).parent_path()) != normalizedPath(folder.path))
    return false;
  const std::string name = file.path.filename().string();
  return std::any_of(folder.files.begin(), folder.files.end(),
                     [&](const std::string& pattern) { return matches(pattern, name); });
}

bool haveCommonFile(const Output& one, const Output& other) {
  if (!one.is_folder && !other.is_folder) return isSame(one.path, other.path);
  if (normalizedPath(one.path) == normalizedPath(other.path)) {
    if (!one.is_folder || !other.is_folder) return true;
    for (const std::string& name : one.files)
      for (const std::string& pattern : other.files)
        if (matches(pattern, name) || matches(name, pattern)) return true;
  }
  return one.is_folder ? isWrittenInto(one, other) : isWrittenInto(other, one);
}

void refuseOtherOutput(const Output& output, const Output& other) {
  if (!haveCommonFile(output, other)) return;
  const bool folders = output.is_folder && other.is_folder;
  throw UsageError(placeOf(output, output.path) +
                   (folders ? " gets files of the names of" : " is") + " also another output" +
                   (other.option.empty() ? "" : " (-" + other.option + ")"));
}

/// Two files of one name in a folder come from inputs of one name in different folders.
void refuseRepeatedNames(const Output& output) {
  std::set<std::string> names;
  for (const std::string& name : output.files)
    if (!names.insert(name).second)
      throw UsageError(placeOf(output, output.path / name) + " is also another output");
}

void checkWritableFile(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) throw InputError(file.string() + ": is a folder; name a file");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(file.string() + ": is not a regular file; name another output");
  const fs::path folder = normalizedPath(file).parent_path();
  if (fs::is_directory(folder, error) && access(folder.c_str(), W_OK) == 0) return;
  if (!fs::exists(folder, error))
    throw InputError(file.string() + ": cannot be created: the folder does not exist");
  throw InputError("cannot write " + file.string() + ": " + folder.string() +
                   " is no folder that can be written to");
}

/// Whether something can be made in a folder; rights alone do not tell it (network, /proc).
bool canMakeIn(const fs::path& folder) {
  std::string probe = (folder / ".pcl_als_XXXXXX").string();
  return mkdtemp(probe.data()) != nullptr && rmdir(probe.c_str()) == 0;
}

/// The folder or, where it is to be made, the one in which it is.
void checkWritableFolder(const Output& output) {
  std::error_code error;
  fs::path folder = normalizedPath(output.path);
  while (!fs::exists(fs::symlink_status(folder, error)) && folder.has_relative_path())
    folder = folder.parent_path();
  if (fs::is_directory(folder, error) && canMakeIn(folder)) return;
  throw InputError(placeOf(output, output.path) + " is no folder that can be written to");
}

/// A positional argument or the value of an option as an output.
Output outputOf(const CommandLine& line, const std::string& option, const fs::path& path,
                const std::vector<std::string>& extensions, const FolderFiles& files) {
  Output output{option, path, extensions, false, {}};
  const auto names = files ? files(line) : std::nullopt;
  if (names) output.is_folder = true, output.files = *names;
  return output;
}

}  // namespace

CommandFiles filesOf(const CommandLine& line) {
  CommandFiles files;
  for (const std::string& input : line.inputs()) files.inputs.push_back({{}, input});
  for (const Option& option : line.options()) {
    if (option.role == Role::input) {
      std::vector<fs::path> paths;
      if (option.inputs)
        paths = option.inputs(line);
      else
        for (const std::string& path : line.list(option.name)) paths.emplace_back(path);
      for (const fs::path& path : paths) files.inputs.push_back({option.name, path});
    } else if ((option.role == Role::output || option.role == Role::folder) &&
               line.has(option.name)) {
      files.outputs.push_back(
          outputOf(line, option.name, line.text(option.name), option.words, option.files));
    }
  }
  if (!line.output().empty())
    files.outputs.push_back(outputOf(line, {}, line.output(), line.form().out, line.form().files));
  return files;
}

void refuseLosses(const CommandFiles& files) {
  for (const Output& output : files.outputs) {
    refuseInputs(output, files.inputs);
    checkExtension(output);
    refuseRepeatedNames(output);
    for (const Output& other : files.outputs) {
      if (&other == &output) break;
      refuseOtherOutput(output, other);
    }
    if (output.is_folder) refuseForeign(filesIn(output));
  }
}

void checkWritable(const CommandFiles& files) {
  for (const Output& output : files.outputs) {
    if (output.is_folder)
      checkWritableFolder(output);
    else
      checkWritableFile(output.path);
  }
}

}  // namespace pcl_als::app
