// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "output_check.h"

#include <unistd.h>

#include <pcl_als/common/errors.h>

namespace pcl_als::app {
namespace fs = std::filesystem;

void checkWritable(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (fs::is_directory(folder) && access(folder.c_str(), W_OK) == 0) return;
  throw InputError("cannot write " + file.string() + ": " + folder.string() +
                   " is no folder that can be written to");
}

void makeOutputFolder(const std::string& option, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder) && access(folder.c_str(), W_OK) == 0) return;
  throw InputError("option -" + option + ": " + folder.string() +
                   " is no folder that can be written to");
}

void refuseInput(const std::string& option, const fs::path& output,
                 const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(output, input, error))
      throw UsageError("option -" + option + ": " + output.string() + " is also an input");
}

}  // namespace pcl_als::app
