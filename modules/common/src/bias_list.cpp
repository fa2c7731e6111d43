// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <charconv>
#include <cmath>
#include <set>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

double numberIn(std::string_view text, std::string_view entry) {
  double value = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error == std::errc() && end == last && std::isfinite(value)) return value;
  throw UsageError("bias '" + std::string(entry) + "': '" + std::string(text) +
                   "' is not a number");
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void setBias(std::string_view entry, SystemVector& bias, std::set<SystemParameter>& given) {
  const auto equals = entry.find('=');
  if (equals == std::string_view::npos)
    throw UsageError("bias '" + std::string(entry) + "': expected NAME=VALUE");
  const std::string_view name = trimmed(entry.substr(0, equals));
  const auto parameter = systemParameterNamed(name);
  if (!parameter) {
    std::string known;
    for (const SystemParameterInfo& info : systemParameters())
      known += (known.empty() ? "" : ", ") + std::string(info.name);
    throw UsageError("bias '" + std::string(name) + "': no such parameter; there are " + known);
  }
  if (!given.insert(*parameter).second)
    throw UsageError("bias '" + std::string(name) + "' is given twice");
  bias[indexOf(*parameter)] =
      numberIn(trimmed(entry.substr(equals + 1)), entry) * infoOf(*parameter).internal_per_unit;
}

}  // namespace

void setBiases(std::string_view text, SystemVector& bias) {
  std::set<SystemParameter> given;
  for (bool first = true; !text.empty(); first = false) {
    const auto comma = text.find(',');
    const std::string_view entry = trimmed(text.substr(0, comma));
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
    if (entry.empty()) continue;
    if (first && entry == "none")
      bias.setZero();
    else
      setBias(entry, bias, given);
  }
}

}  // namespace pcl_als
