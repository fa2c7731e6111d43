// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/strip.h>
#include <pcl_als/io/las_file.h>
#include <pcl_als/io/strip_naming.h>

namespace pcl_als::app {

/// A point as the radiometric correction needs it; positions relative to IntensityWindow::origin.
struct IntensityPoint {
  double time = 0.0;  ///< as the file has it
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  float intensity = 0.0F;
  std::uint16_t source = 0;
  std::uint8_t return_number = 1, number_of_returns = 1, classification = 0;
};

/// Some points of a file, and those around them that surfaces are found with.
struct IntensityWindow {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, ground frame
  std::vector<IntensityPoint> points;
  /// By point source id: single and last returns, of the window and around it.
  std::map<std::uint16_t, std::vector<Eigen::Vector3f>> surface_points;
  std::vector<double> gain_control;  ///< by point; empty where none is read
};

/// What a first look at a file found.
struct IntensitySurvey {
  PointFileSources sources;
  bool has_time = true;
  std::uint64_t zeros = 0;  ///< points of intensity 0
  double largest = 0.0;     ///< intensity
  double first_time = 0.0, last_time = 0.0;
};

/** \brief A point file, read window by window.
 *
 * LAS: windows are runs of records. The first look keeps a box for every 4096 records and strip (32
 * bytes each); a window is read with the records of those blocks that lie within a margin of its
 * own. So a file in order of time or of place needs the memory of a window; one whose windows have
 * more than kMostNeighbours points around them is in no order and an InputError says so. PCD: one
 * window, the whole file.
 */
class IntensityInput {
 public:
  static constexpr std::size_t kWindow = std::size_t{1} << 17;
  static constexpr std::size_t kMostNeighbours = std::size_t{1} << 22;

  virtual ~IntensityInput() = default;
  /// By extension. \a gain_control: name of an extra field to read; empty: none.
  static std::unique_ptr<IntensityInput> open(const std::string& path,
                                              const std::string& gain_control, int threads);

  const std::string& path() const { return path_; }
  const IntensitySurvey& survey() const { return survey_; }
  virtual std::size_t windows() const = 0;
  /// \a margins: metres around the points of each source; sources without one get no neighbours.
  virtual void load(std::size_t window, const std::map<std::uint16_t, double>& margins,
                    IntensityWindow& out) const = 0;
  /// The file behind it; null for a PCD.
  virtual const LasFile* las() const { return nullptr; }
  /// The whole cloud; null for a LAS.
  virtual const Strip<PointLidar>* strip() const { return nullptr; }

 protected:
  explicit IntensityInput(std::string path) : path_(std::move(path)) {}
  std::string path_;
  IntensitySurvey survey_;
};

}  // namespace pcl_als::app
