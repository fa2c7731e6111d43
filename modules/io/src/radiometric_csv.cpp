// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "csv_table.h"

namespace pcl_als {

std::vector<ReferenceTarget> readReferenceTargets(const std::filesystem::path& path,
                                                  const LengthUnit& unit) {
  detail::CsvTable table(path);
  const std::size_t x = table.required("x"), y = table.required("y");
  const std::size_t reflectance = table.required("reflectance");
  const std::size_t id = table.optional("id"), sigma = table.optional("sigma");
  std::vector<ReferenceTarget> targets;
  while (table.next()) {
    ReferenceTarget target;
    target.id = id != detail::CsvTable::npos ? std::string(table.text(id))
                                             : std::to_string(targets.size() + 1);
    target.x = table.number(x) * unit.metres;
    target.y = table.number(y) * unit.metres;
    target.reflectance = table.number(reflectance);
    if (target.reflectance <= 0.0 || target.reflectance > 2.0)
      table.refuse(reflectance, "is no reflectance (more than 0, at most 2)");
    if (sigma != detail::CsvTable::npos && !table.text(sigma).empty()) {
      target.sigma = table.number(sigma);
      if (target.sigma < 0.0 || target.sigma >= 1.0)
        table.refuse(sigma, "must be from 0 to under 1");
    }
    targets.push_back(std::move(target));
  }
  if (targets.empty()) throw InputError(path.string() + ": has a header but no targets");
  return targets;
}

std::vector<GainStep> readGainSteps(const std::filesystem::path& path) {
  detail::CsvTable table(path);
  const std::size_t value = table.required("value"), gain = table.required("gain");
  std::vector<GainStep> steps;
  while (table.next()) {
    steps.push_back({table.number(value), table.number(gain)});
    if (steps.back().gain <= 0.0) table.refuse(gain, "must be more than 0");
  }
  if (steps.empty()) throw InputError(path.string() + ": has a header but no steps");
  std::sort(steps.begin(), steps.end(),
            [](const GainStep& a, const GainStep& b) { return a.value < b.value; });
  const auto twice =
      std::adjacent_find(steps.begin(), steps.end(),
                         [](const GainStep& a, const GainStep& b) { return a.value == b.value; });
  if (twice != steps.end())
    throw InputError(path.string() + ": the value " + std::to_string(twice->value) +
                     " comes twice");
  return steps;
}

}  // namespace pcl_als
