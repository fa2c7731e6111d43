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

constexpr double kSmallestTarget = 0.1;  // metres, diameter: less than a footprint
constexpr double kLargestTarget = 20.0;

bool stated(const detail::CsvTable& table, std::size_t column) {
  return column != detail::CsvTable::npos && !table.text(column).empty();
}

/// A standard deviation in a column that may be missing or empty; 0: it is not stated.
double readSigma(const detail::CsvTable& table, std::size_t column, const LengthUnit& unit) {
  if (!stated(table, column)) return 0.0;
  const double sigma = table.number(column) * unit.metres;
  if (sigma < 0.0) table.refuse(column, "must not be negative");
  if (sigma > kLargestSigma) table.refuse(column, "must not exceed 100 m");
  return sigma;
}

/// The columns of planar patches; npos where the file has none.
struct PatchColumns {
  std::size_t x, y, z, extent;

  explicit PatchColumns(const detail::CsvTable& table)
      : x(table.optional("nx")),
        y(table.optional("ny")),
        z(table.optional("nz")),
        extent(table.optional("extent")) {}

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

/// The columns of circular targets; npos where the file has none.
struct TargetColumns {
  std::size_t diameter, sigma_plan;

  explicit TargetColumns(const detail::CsvTable& table)
      : diameter(table.optional("diameter")), sigma_plan(table.optional("sigma_plan")) {}

  /// A point with a diameter is the centre of a target.
  void read(const detail::CsvTable& table, const LengthUnit& unit, ControlPoint& point) const {
    if (!stated(table, diameter)) {
      if (stated(table, sigma_plan))
        table.refuse(sigma_plan, "is that of a target and needs its diameter");
      return;
    }
    if (point.kind == ControlPoint::Kind::patch)
      table.refuse(diameter, "must be empty for a patch: a point has a normal or a diameter");
    point.kind = ControlPoint::Kind::target;
    point.diameter = table.number(diameter) * unit.metres;
    if (!(point.diameter >= kSmallestTarget) || point.diameter > kLargestTarget)
      table.refuse(diameter, "must be 0.1 to 20 m");
    point.sigma_plan = readSigma(table, sigma_plan, unit);
  }
};

}  // namespace

std::vector<ControlPoint> readControl(const std::filesystem::path& path, const LengthUnit& unit) {
  detail::CsvTable table(path);
  const std::size_t id = table.required("id");
  const std::size_t x = table.required("x"), y = table.required("y"), z = table.required("z");
  const std::size_t sigma = table.optional("sigma");
  const PatchColumns patch(table);
  const TargetColumns target(table);
  std::vector<ControlPoint> points;
  while (table.next()) {
    ControlPoint point;
    point.id = table.text(id);
    if (point.id.empty()) table.refuse(id, "must name the point");
    point.position = {table.number(x), table.number(y), table.number(z)};
    point.position *= unit.metres;
    point.sigma = readSigma(table, sigma, unit);
    patch.read(table, unit, point);
    target.read(table, unit, point);
    points.push_back(std::move(point));
  }
  if (points.empty()) throw InputError(path.string() + ": has a header but no control points");
  return points;
}

}  // namespace pcl_als
