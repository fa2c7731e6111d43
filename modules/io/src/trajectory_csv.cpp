// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "trajectory_csv.h"

#include <pcl_als/common/errors.h>

#include "csv_table.h"
#include "trajectory_columns.h"

namespace pcl_als::detail {

TrajectoryFile readTrajectoryCsv(const std::filesystem::path& path) {
  CsvTable table(path);
  const TrajectoryColumns columns(table);
  const auto number = [&](TrajectoryQuantity quantity) {
    return table.number(columns[quantity].index);
  };
  const auto angle = [&](TrajectoryQuantity quantity, double& radians) {
    const TrajectoryColumn& column = columns[quantity];
    if (column.present()) radians = table.numberOrNan(column.index) * column.factor;
  };
  TrajectoryFile file;
  file.heading_is_yaw = columns.headingIsYaw();
  file.columns = columns.describe();
  while (table.next()) {
    TrajectorySample sample;
    sample.time = number(TrajectoryQuantity::time);
    sample.position = {number(TrajectoryQuantity::x), number(TrajectoryQuantity::y),
                       number(TrajectoryQuantity::z)};
    angle(TrajectoryQuantity::roll, sample.roll);
    angle(TrajectoryQuantity::pitch, sample.pitch);
    angle(TrajectoryQuantity::heading, sample.heading);
    file.samples.push_back(sample);
  }
  if (file.samples.empty()) throw InputError(path.string() + ": has a header but no records");
  return file;
}

}  // namespace pcl_als::detail
