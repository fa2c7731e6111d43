// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "argument_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <pcl_als/common/errors.h>

#include "option.h"

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const std::string& file) {
  constexpr std::uintmax_t kLargest = 16U << 20U;  // bytes: no command is as long
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) throw InputError(file + ": there is no such file");
  if (fs::file_size(file, failed) > kLargest || failed)
    throw InputError(file + ": is no file of options");
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw InputError(file + ": cannot be read");
  if (text.find('\0') != std::string::npos) throw InputError(file + ": is no file of options");
  return text;
}

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
    for (std::string& more : wordsOf(contentOf(file), file)) all.push_back(std::move(more));
  }
  return all;
}

std::vector<std::string> withFilesOfFolders(const std::vector<std::string>& arguments) {
  std::vector<std::string> all;
  for (const std::string& argument : arguments) {
    std::error_code failed;
    std::vector<std::string> files;
    if (fs::is_directory(argument, failed)) {
      for (fs::directory_iterator entry(argument, failed), end; !failed && entry != end;
           entry.increment(failed))
        if (isPointFile(entry->path())) files.push_back(entry->path().string());
      if (failed) throw InputError(argument + ": cannot be read: " + failed.message());
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) files.push_back(argument);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

}  // namespace pcl_als::app
