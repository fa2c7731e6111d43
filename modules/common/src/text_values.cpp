// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <filesystem>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {

std::optional<double> finiteNumber(std::string_view text) {
  const auto value = valueIn<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> splitList(std::string_view list) {
  std::vector<std::string> parts;
  while (!list.empty()) {
    const auto comma = list.find(',');
    const std::string_view part = trimmed(list.substr(0, comma));
    if (!part.empty()) parts.emplace_back(part);
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  }
  return parts;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::optional<std::pair<std::string, std::string>> assignmentIn(const std::string& text) {
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  return std::pair(text.substr(0, equals), text.substr(equals + 1));
}

std::vector<double> numbersIn(const std::string& text, char separator) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    const auto number = finiteNumber(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::pair<std::string, std::string> pairIn(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    throw UsageError("'" + text + "' is not A:B");
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::vector<std::pair<std::string, std::string>> pairsIn(const std::string& list) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : splitList(list)) pairs.push_back(pairIn(text));
  if (pairs.empty()) throw UsageError("names no pair");
  return pairs;
}

std::string fileNames(const std::vector<std::string>& paths) {
  std::string names;
  for (std::size_t i = 0; i < paths.size() && i < 3; ++i)
    names += (i > 0 ? ", " : "") + std::filesystem::path(paths[i]).filename().string();
  if (paths.size() > 3) names += " and " + std::to_string(paths.size() - 3) + " more";
  return names;
}

std::map<std::string, double> stripValuesIn(const std::string& list, double low, double high) {
  std::map<std::string, double> values;
  for (const std::string& part : splitList(list)) {
    const auto entry = assignmentIn(part);
    if (!entry) throw UsageError("'" + part + "' is not STRIP=VALUE");
    const auto value = finiteNumber(entry->second);
    if (!value || *value < low || *value > high) {
      std::ostringstream text;
      text << "'" << entry->second << "' is not a number from " << low << " to " << high;
      throw UsageError(text.str());
    }
    if (!values.emplace(entry->first, *value).second)
      throw UsageError("strip " + entry->first + " is given twice");
  }
  if (values.empty()) throw UsageError("names no strip");
  return values;
}

}  // namespace pcl_als
