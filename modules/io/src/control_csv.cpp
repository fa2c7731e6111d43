// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "csv_table.h"

namespace pcl_als {

namespace {

constexpr double kLargestSigma = 100.0;  // metres: such a point contains no information on heights

constexpr double kDefaultExtent = 2.0;   // metres, of a patch
constexpr double kLargestExtent = 50.0;  // metres: planes of the ground or of buildings
constexpr double kSteepestNormal = 0.5;  // its vertical component: patches of at most 60 degrees

/// The columns of planar patches; npos where the file has none.
struct PatchColumns {
  std::size_t x, y, z, extent;

  explicit PatchColumns(const detail::CsvTable& table)
      : x(table.optional("nx")),
        y(table.optional("ny")),
        z(table.optional("nz")),
        extent(table.optional("extent")) {}

  bool stated(const detail::CsvTable& table, std::size_t column) const {
    return column != detail::CsvTable::npos && !table.text(column).empty();
  }

  /// A point with a normal is the centre of a patch.
  void read(const detail::CsvTable& table, const LengthUnit& unit, ControlPoint& point) const {
    if (!stated(table, x) && !stated(table, y) && !stated(table, z)) return;
    for (const std::size_t column : {x, y, z}) {
      if (!stated(table, column)) throw InputError(table.at("a patch needs all of nx, ny and nz"));
    }
    const Eigen::Vector3d normal(table.number(x), table.number(y), table.number(z));
    if (!(normal.norm() > 0.0)) table.refuse(x, "must be part of a normal that is not zero");
    point.kind = ControlPoint::Kind::patch;
    point.normal = (normal.z() < 0.0 ? -1.0 : 1.0) * normal.normalized();
    if (point.normal.z() < kSteepestNormal)
      table.refuse(z, "must be that of a patch of at most 60 degrees");
    point.extent = stated(table, extent) ? table.number(extent) * unit.metres : kDefaultExtent;
    if (!(point.extent > 0.0) || point.extent > kLargestExtent)
      table.refuse(extent, "must be above 0 and at most 50 m");
  }
};

}  // namespace

std::vector<ControlPoint> readControl(const std::filesystem::path& path, const LengthUnit& unit) {
  detail::CsvTable table(path);
  const std::size_t id = table.required("id");
  const std::size_t x = table.required("x"), y = table.required("y"), z = table.required("z");
  const std::size_t sigma = table.optional("sigma");
  const PatchColumns patch(table);
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
    patch.read(table, unit, point);
    points.push_back(std::move(point));
  }
  if (points.empty()) throw InputError(path.string() + ": has a header but no control points");
  return points;
}

}  // namespace pcl_als
