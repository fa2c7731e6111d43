// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "argument_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/point_files.h>

namespace pcl_als::app {
namespace {

/// No command is as long as 16 MiB.
constexpr ContentLimits kCommandLimits{std::uint64_t{16} << 20U, 0, true};

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::vector<std::string> wordsOf(const std::string& text, const std::string& file) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    if (isBlank(text[at])) {
      ++at;
      continue;
    }
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    std::string word;
    while (at < text.size() && !isBlank(text[at])) {
      const char c = text[at++];
      if (c != '\'' && c != '"') {
        word += c;
        continue;
      }
      const std::size_t end = text.find(c, at);
      if (end == std::string::npos) throw UsageError(file + ": a quote is not closed");
      word.append(text, at, end - at);
      at = end + 1;
    }
    words.push_back(std::move(word));
  }
  return words;
}

}  // namespace

std::vector<std::string> withArgumentFiles(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) {
    if (word.size() < 2 || word.front() != '@') {
      all.push_back(word);
      continue;
    }
    const std::string file = word.substr(1);
    for (std::string& more : wordsOf(readWholeFile(file, kCommandLimits), file))
      all.push_back(std::move(more));
  }
  return all;
}

std::vector<std::string> withFilesOfFolders(const std::vector<std::string>& arguments) {
  std::vector<std::string> all;
  for (const std::string& argument : arguments) {
    std::error_code unknown;
    std::vector<std::string> files;
    if (std::filesystem::is_directory(argument, unknown)) files = pointFilesIn(argument);
    if (files.empty()) files.push_back(argument);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

}  // namespace pcl_als::app
