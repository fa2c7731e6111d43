// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <unistd.h>

#include "test_files.h"

namespace pcl_als::test {

/// A file of the real data that is stored as .xz, unpacked once into the build tree; empty where
/// it, or xz, is absent.
inline std::optional<std::filesystem::path> unpacked(const std::string& name) {
  const auto packed = testData(name);
  if (!packed) return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(PCL_ALS_TEST_SCRATCH) / "unpacked";
  const std::filesystem::path file = folder / packed->stem();
  if (std::filesystem::exists(file)) return file;
  std::filesystem::create_directories(folder);
  // Another test may be doing the same: the rename makes whoever is last win with a whole file.
  const std::filesystem::path partial = file.string() + "." + std::to_string(getpid());
  const std::string command = "xz -dc '" + packed->string() + "' > '" + partial.string() + "'";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  std::filesystem::rename(partial, file);
  return file;
}

}  // namespace pcl_als::test
