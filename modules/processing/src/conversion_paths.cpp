// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "conversion_paths.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/point_files.h>
#include <pcl_als/processing/point_conversion.h>

namespace pcl_als::detail {
namespace {

namespace fs = std::filesystem;

/// Whether a name is that of a file of points, also in a format that is not written.
bool isPointFileName(const fs::path& path) {
  static const std::set<std::string> kOthers = {".asc", ".csv", ".e57", ".pts",
                                                ".ptx", ".txt", ".zlas"};
  return isPointFile(path) || kOthers.count(lowerExtension(path)) != 0;
}

bool isCopcName(const fs::path& path) {
  return lowerExtension(path) == ".laz" && lowerExtension(path.stem()) == ".copc";
}

/// The name without extension, also without that of COPC.
std::string stemOf(const fs::path& path) {
  return isCopcName(path) ? path.stem().stem().string() : path.stem().string();
}

/// One of kPointExtensions, of a file in a folder.
std::string extensionFor(const fs::path& input, const std::string& format) {
  const std::string extension = format.empty() ? lowerExtension(input) : "." + format;
  if (isPointExtension(extension)) return extension;
  if (format.empty())
    throw InputError(input.string() + ": is no point file by its name (" + kPointExtensions + ")");
  throw UsageError("point format '" + format + "' is none of las, laz, pcd, ply, xyz");
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw InputError(folder.string() + ": is no folder and cannot be made one");
}

/// UsageError for an output that is an input or another output, or that would be COPC, and for one
/// in a folder that would replace a file of the user.
void check(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs,
           bool in_folder) {
  std::error_code absent;
  std::map<std::string, bool> known;
  for (const fs::path& output : outputs) {
    if (isCopcName(output))
      throw UsageError(output.string() +
                       ": COPC files are read, not written; give it a name in .laz only");
    if (!known.emplace(output.string(), true).second)
      throw UsageError(output.string() + ": would be written twice; convert the inputs by turns");
    for (const fs::path& input : inputs)
      if (fs::equivalent(input, output, absent))
        throw UsageError(output.string() + ": input and output are the same file");
  }
  if (in_folder) refuseForeign(outputs);
}

/// A strip may be named by the path of a file.
std::string fileName(std::string strip) {
  std::replace_if(
      strip.begin(), strip.end(), [](unsigned char c) { return c == '/' || c == '\\' || c < ' '; },
      '_');
  return strip;
}

}  // namespace

std::vector<fs::path> outputPaths(const std::vector<fs::path>& inputs, const fs::path& output,
                                  const std::string& format) {
  std::vector<fs::path> outputs;
  if (isConversionFolder(output, inputs.size() != 1)) {
    for (const fs::path& input : inputs) outputs.push_back(output / convertedName(input, format));
    check(inputs, outputs, true);
    makeFolder(output);
    return outputs;
  }
  const std::string extension = lowerExtension(output);
  if (!isPointExtension(extension))
    throw UsageError(output.string() + ": is no point file by its name (" + kPointExtensions + ")");
  if (inputs.size() != 1)
    throw UsageError(output.string() + ": is one file; several inputs need a folder");
  if (!format.empty() && extension != "." + format)
    throw UsageError(output.string() + ": does not have the extension of format " + format);
  outputs.push_back(output);
  check(inputs, outputs, false);
  return outputs;
}

std::vector<fs::path> stripPaths(const std::vector<fs::path>& inputs, const fs::path& folder,
                                 const std::string& format,
                                 const std::vector<std::string>& strips) {
  requireStripFolder(folder);
  const std::string extension = extensionFor(inputs.at(0), format);
  std::vector<fs::path> outputs;
  for (const std::string& strip : strips) outputs.push_back(folder / (fileName(strip) + extension));
  check(inputs, outputs, true);
  makeFolder(folder);
  return outputs;
}

std::vector<std::uint16_t> lineNumbers(const std::vector<std::string>& strips) {
  constexpr std::size_t kMaximumFiles = 65'535;
  if (strips.size() > kMaximumFiles)
    throw InputError(counted(strips.size(), "strip") + ", and point source ids end at 65535");
  std::set<std::uint16_t> taken;
  std::vector<std::optional<std::uint16_t>> known(strips.size());
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const bool digits = strips[i].find_first_not_of("0123456789") == std::string::npos;
    if (!digits || strips[i].size() > 5 || std::stoul(strips[i]) > kMaximumFiles) continue;
    known[i] = static_cast<std::uint16_t>(std::stoul(strips[i]));
    taken.insert(*known[i]);
  }
  std::vector<std::uint16_t> numbers;
  std::uint16_t next = 1;
  for (const auto& number : known) {
    while (!number && taken.count(next) > 0) ++next;
    numbers.push_back(number ? *number : next++);
  }
  return numbers;
}

}  // namespace pcl_als::detail

namespace pcl_als {

bool isConversionFolder(const std::filesystem::path& output, bool folder_needed) {
  if (std::filesystem::is_directory(output)) return true;
  if (!folder_needed) return output.extension().empty();
  // A dot belongs to many names of folders; what is or looks like a file is refused.
  return !std::filesystem::exists(output) && !detail::isPointFileName(output);
}

void requireStripFolder(const std::filesystem::path& output) {
  if (!isConversionFolder(output, true))
    throw UsageError(output.string() +
                     ": is the name of a file; a file for each strip needs a folder");
}

std::string convertedName(const std::filesystem::path& input, const std::string& format) {
  return detail::stemOf(input) + detail::extensionFor(input, format);
}

}  // namespace pcl_als
