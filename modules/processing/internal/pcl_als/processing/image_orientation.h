// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/photogrammetry/bundle_adjustment.h>

namespace pcl_als {

/// Files of an image block.
struct ImageBlockFiles {
  std::filesystem::path images, measurements, lines, camera;
  std::optional<std::filesystem::path> check_points;

  /// measurements.csv beside the images.
  static std::filesystem::path besideImages(const std::filesystem::path& images);
};

struct ImageOrientationOptions {
  BundleSettings bundle;
  /// Of measurements without their own, unit of the camera's file; 0: 0.5 px or 0.003 mm.
  double image_sigma = 0.0;
  double assign_distance = 0.0;  ///< metres; above 0 lines of other names are assigned by position
};

/// A check point against the image block.
struct ImageCheckPoint {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< surveyed, metres
  Eigen::Vector3d difference = Eigen::Vector3d::Zero();  ///< image block - surveyed, metres
  Eigen::Vector3d std = Eigen::Vector3d::Zero();         ///< of the image block, metres
  std::size_t rays = 0;
};

/// Differences at check points in X, Y, Z, as in Table 4 of Habib et al. 2011; metres.
struct CheckSummary {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero(),
                  rmse = Eigen::Vector3d::Zero();
  double total = 0.0;  ///< RMSE of the three coordinates together
};
CheckSummary summaryOf(const std::vector<ImageCheckPoint>& points);

struct ImageOrientationResult {
  ImageBlock block;
  BundleResult bundle;
  std::vector<LineAssignment> assignments;
  std::vector<ImageCheckPoint> check_points;
  std::vector<std::string> unknown_lines;   ///< measured, without a line of the control
  std::vector<std::string> missing_points;  ///< check points that the block does not have
};

/// Orients a block in memory and compares it with check points.
ImageOrientationResult orientImages(ImageBlock block, const std::vector<ControlPoint>& check_points,
                                    const ImageOrientationOptions& options = {});

/// The same with files. InputError for those that cannot be used, and for a block that
/// adjustBundle() refuses.
ImageOrientationResult orientImages(const ImageBlockFiles& files,
                                    const ImageOrientationOptions& options,
                                    const ProgressCallback& progress = {});

}  // namespace pcl_als
