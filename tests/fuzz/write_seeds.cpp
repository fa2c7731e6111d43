// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <fstream>

#include "fuzz_targets.h"

/// write_GROUP_seeds FOLDER: the seeds of every target as files, FOLDER/TARGET/0, 1, …
int main(int argc, char** argv) {
  if (argc != 2) return 1;
  for (const pcl_als::fuzz::Target& target : pcl_als::fuzz::PCL_ALS_FUZZ_TARGETS()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target.name;
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const std::string& seed : target.seeds())
      std::ofstream(folder / std::to_string(number++), std::ios::binary) << seed;
  }
  return 0;
}
