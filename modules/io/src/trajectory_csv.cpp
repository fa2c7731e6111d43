// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "trajectory_csv.h"

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>

#include "csv_table.h"

namespace pcl_als::detail {

std::vector<TrajectorySample> readTrajectoryCsv(const std::filesystem::path& path) {
  CsvTable table(path);
  const std::size_t time = table.required("time");
  const std::size_t x = table.required("x"), y = table.required("y"), z = table.required("z");
  const std::size_t roll = table.optional("roll"), pitch = table.optional("pitch"),
                    heading = table.optional("heading");
  const auto angle = [&table](std::size_t column, double& radians) {
    if (column != CsvTable::npos) radians = table.numberOrNan(column) * kRadiansPerDegree;
  };
  std::vector<TrajectorySample> samples;
  while (table.next()) {
    TrajectorySample sample;
    sample.time = table.number(time);
    sample.position = {table.number(x), table.number(y), table.number(z)};
    angle(roll, sample.roll);
    angle(pitch, sample.pitch);
    angle(heading, sample.heading);
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError(path.string() + ": has a header but no records");
  return samples;
}

}  // namespace pcl_als::detail
