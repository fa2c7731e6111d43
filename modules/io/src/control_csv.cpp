// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "csv_table.h"

namespace pcl_als {

namespace {

constexpr double kLargestSigma = 100.0;  // metres: such a point contains no information on heights

}  // namespace

std::vector<ControlPoint> readControl(const std::filesystem::path& path, const LengthUnit& unit) {
  detail::CsvTable table(path);
  const std::size_t id = table.required("id");
  const std::size_t x = table.required("x"), y = table.required("y"), z = table.required("z");
  const std::size_t sigma = table.optional("sigma");
  std::vector<ControlPoint> points;
  while (table.next()) {
    ControlPoint point;
    point.id = table.text(id);
    if (point.id.empty()) table.refuse(id, "must name the point");
    point.position = {table.number(x), table.number(y), table.number(z)};
    point.position *= unit.metres;
    if (sigma != detail::CsvTable::npos && !table.text(sigma).empty()) {
      point.sigma = table.number(sigma) * unit.metres;
      if (point.sigma < 0.0) table.refuse(sigma, "must not be negative");
      if (point.sigma > kLargestSigma) table.refuse(sigma, "must not exceed 100 m");
    }
    points.push_back(std::move(point));
  }
  if (points.empty()) throw InputError(path.string() + ": has a header but no control points");
  return points;
}

}  // namespace pcl_als
