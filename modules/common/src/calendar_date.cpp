// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <ctime>
#include <vector>

#include <pcl_als/common/calendar_date.h>

namespace pcl_als {
namespace {

bool isLeap(int year) {
  return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

int daysInMonth(int year, int month) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && isLeap(year) ? 1 : 0);
}

/// The numbers of a date; those of eight digits without separators are year, month and day.
std::vector<int> partsOf(std::string_view text) {
  std::vector<int> parts;
  std::size_t digits = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') {
      digits = 0;
      continue;
    }
    if (digits++ == 0) parts.push_back(0);
    if (digits > 8) return {};
    parts.back() = 10 * parts.back() + (c - '0');
  }
  if (parts.size() != 1 || digits != 8) return parts;
  return {parts[0] / 10000, parts[0] / 100 % 100, parts[0] % 100};
}

std::string orderOf(std::string_view text, const std::vector<int>& parts,
                    const std::string& stated) {
  if (stated == "ymd" || stated == "dmy" || stated == "mdy") return stated;
  if (parts[0] > 31) return "ymd";
  if (parts[2] < 1980) return "";
  if (text.find('.') != std::string_view::npos || parts[0] > 12) return "dmy";
  return parts[1] > 12 ? "mdy" : "";
}

}  // namespace

std::optional<long> daysOfGps(std::string_view text, const std::string& order) {
  const std::vector<int> parts = partsOf(text);
  if (parts.size() != 3) return std::nullopt;
  const std::string by = orderOf(text, parts, order);
  if (by.empty()) return std::nullopt;
  const auto part = [&](char which) { return parts[by.find(which)]; };
  const int year = part('y'), month = part('m'), day = part('d');
  if (year < 1980 || year > 2200 || month < 1 || month > 12 || day < 1 ||
      day > daysInMonth(year, month))
    return std::nullopt;
  long days = day - 6;  // since 1980-01-06
  for (int y = 1980; y < year; ++y) days += isLeap(y) ? 366 : 365;
  for (int m = 1; m < month; ++m) days += daysInMonth(year, m);
  return days;
}

std::string dateText(long day) {
  constexpr std::time_t kGpsEpoch = 315964800, kDay = 86400;  // seconds since 1970-01-01
  const std::time_t time = kGpsEpoch + kDay * day;
  std::tm date{};
  gmtime_r(&time, &date);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &date);
  return text;
}

}  // namespace pcl_als
