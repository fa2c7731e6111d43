// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/measured_box.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/point_box.h>

namespace pcl_als {

MeasuredFile measureBox(const std::filesystem::path& path, int threads) {
  const std::string extension = lowerExtension(path);
  // The box of other files is that of their points.
  if (extension != ".las" && extension != ".laz") return {PointReader::open(path)->info(), {}};
  const LasFile file(path, kLazZ);
  MeasuredFile measured{file.info(), {}};
  requireMapCoordinates(measured.info);
  const Eigen::AlignedBox3d box = pointBox(file, threads);
  const std::string remark = headerBoxRemark(measured.info, box);
  if (!remark.empty()) measured.box_remark = path.string() + ": " + remark;
  if (!box.isEmpty()) measured.info.minimum = box.min(), measured.info.maximum = box.max();
  return measured;
}

}  // namespace pcl_als
