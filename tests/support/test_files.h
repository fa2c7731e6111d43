// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace pcl_als::test {

/// An empty folder of the build tree for the files of one test; made anew at each call.
inline std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(PCL_ALS_TEST_SCRATCH) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A file of the real data for tests ($PCL_ALS_TEST_DATA or the configured folder); empty where it
/// is absent.
inline std::optional<std::filesystem::path> testData(const std::string& name) {
  const char* folder = std::getenv("PCL_ALS_TEST_DATA");
  const auto path =
      std::filesystem::path(folder != nullptr ? folder : PCL_ALS_TEST_DATA_DEFAULT) / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

/// What an action complains of by throwing an Error; "no error" where it does not.
template <typename Error>
std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace pcl_als::test

/// Skips the running test, naming the file, where the real data is absent.
#define PCL_ALS_REQUIRE_DATA(path) \
  if (!(path)) GTEST_SKIP() << "real test data is absent: " #path
