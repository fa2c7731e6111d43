// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/lidar_return.h>

namespace pcl_als {

void PointChunk::resize(std::size_t count) {
  for (auto* column : {&x, &y, &z, &gps_time}) column->resize(count);
  for (auto* column : {&intensity, &scan_angle}) column->resize(count);
  point_source_id.resize(count);
  for (auto* column :
       {&return_number, &number_of_returns, &classification, &flags, &user_data, &channel})
    column->resize(count);
  if (!extra.empty()) extra.resize(count);
}

PointChunk PointChunk::select(const std::vector<std::size_t>& rows) const {
  const auto part = [&rows](const auto& column) {
    std::decay_t<decltype(column)> selected(column.empty() ? 0 : rows.size());
    for (std::size_t i = 0; i < selected.size(); ++i) selected[i] = column[rows[i]];
    return selected;
  };
  return {part(x),
          part(y),
          part(z),
          part(gps_time),
          part(intensity),
          part(scan_angle),
          part(point_source_id),
          part(return_number),
          part(number_of_returns),
          part(classification),
          part(flags),
          part(user_data),
          part(channel),
          part(extra)};
}

LidarReturn PointChunk::point(std::size_t row, double time) const {
  LidarReturn point;
  point.position = Eigen::Vector3d(x[row], y[row], z[row]);
  point.time = time;
  point.intensity = intensity[row];
  point.scan_angle = scan_angle[row];
  point.return_number = return_number[row];
  point.number_of_returns = number_of_returns[row];
  point.classification = classification[row];
  point.flags = flags[row];
  point.channel = channel[row];
  point.user_data = user_data[row];
  return point;
}

}  // namespace pcl_als
