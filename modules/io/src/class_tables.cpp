// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/io/class_io.h>

#include "csv_table.h"

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

constexpr std::size_t kMostClasses = 250;
// Sums of 250 x 250 of them are within 64 bits.
constexpr std::int64_t kLargestCount = 1'000'000'000'000;

std::int64_t countOf(const detail::CsvTable& table, std::size_t column) {
  const auto count = valueIn<std::int64_t>(table.text(column));
  if (!count || *count < 0 || *count > kLargestCount)
    table.refuse(column, "is not a count (0 to 10^12)");
  return *count;
}

void checkName(const detail::CsvTable& table, std::size_t column) {
  const std::string fault = classNameFault(table.text(column));
  if (!fault.empty()) table.refuse(column, fault);
}

}  // namespace

CountTable readCountTable(const fs::path& path) {
  detail::CsvTable table(path);
  CountTable result;
  result.classes.assign(table.header().begin() + 1, table.header().end());
  const std::size_t size = result.classes.size();
  if (size < 2 || size > kMostClasses)
    throw InputError(path.string() + ": has " + std::to_string(size) +
                     " classes; a confusion matrix needs 2 to 250, named in the header after the "
                     "first column");
  for (const std::string& name : result.classes) {
    const std::string fault = classNameFault(name);
    if (!fault.empty()) throw InputError(path.string() + ": a class of the header " + fault);
  }
  result.counts.assign(size, {});
  std::size_t rows = 0;
  for (; table.next(); ++rows) {
    const auto name = std::find(result.classes.begin(), result.classes.end(), table.text(0));
    if (name == result.classes.end()) table.refuse(0, "is not a class of the header");
    auto& row = result.counts[static_cast<std::size_t>(name - result.classes.begin())];
    if (!row.empty()) table.refuse(0, "has a second row");
    for (std::size_t column = 1; column <= size; ++column) row.push_back(countOf(table, column));
  }
  if (rows != size)
    throw InputError(path.string() + ": has " + std::to_string(rows) + " rows for " +
                     std::to_string(size) + " classes");
  return result;
}

bool holdsCheckedSites(const fs::path& path) {
  const detail::CsvTable table(path);
  return table.optional("reference") != detail::CsvTable::npos &&
         table.optional("classified") != detail::CsvTable::npos;
}

std::vector<CheckedSite> readCheckedSites(const fs::path& path) {
  detail::CsvTable table(path);
  const std::size_t x = table.required("x"), y = table.required("y"),
                    reference = table.required("reference"),
                    classified = table.required("classified");
  std::vector<CheckedSite> sites;
  while (table.next()) {
    CheckedSite site{{table.number(x), table.number(y)},
                     std::string(table.text(reference)),
                     std::string(table.text(classified))};
    checkName(table, reference);
    if (!site.classified.empty()) checkName(table, classified);
    sites.push_back(std::move(site));
  }
  if (sites.empty()) throw InputError(path.string() + ": has a header but no check points");
  return sites;
}

void writeCheckedSites(const fs::path& path, const std::vector<CheckedSite>& sites) {
  std::string text = "x,y,reference,classified\n";
  for (const CheckedSite& site : sites) {
    char place[80];
    std::snprintf(place, sizeof place, "%.3f,%.3f,", site.place.x(), site.place.y());
    text += place + site.reference + ',' + site.classified + '\n';
  }
  writeFile(path, text);
}

}  // namespace pcl_als
