// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pcl_als {

/// Days from 1980-01-06, the start of GPS time, to a date such as 2013/09/21, 21.09.2013 or
/// 20130921. \a order of its parts: "ymd", "dmy", "mdy"; otherwise a year of four digits in front,
/// points between day, month and year, or a day above 12 show it. None where nothing does, or where
/// it is no date.
std::optional<long> daysOfGps(std::string_view text, const std::string& order);

/// A date such as "2026-05-04" of a day since 1980-01-06.
std::string dateText(long day);

}  // namespace pcl_als
