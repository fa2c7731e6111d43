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

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/survey/strip_assignment.h>
#include <pcl_als/survey/swath_track.h>

namespace pcl_als {

/// A point of a file; LidarReturn::time is as stored in the file.
struct IntensityPoint : LidarReturn {
  std::uint16_t source = 0;
  std::uint32_t label = 0;  ///< among those of WindowRequest::arrangement
};

/// Points of a file, and the points around them that are needed for their surfaces.
struct IntensityWindow {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of surface_points: metres, ground frame
  std::vector<IntensityPoint> points;
  /// By strip in use: single and last returns, of the window and around it.
  std::map<int, std::vector<Eigen::Vector3f>> surface_points;
  std::vector<double> gain_control;  ///< by point; empty where none is read

  /// A position in the frame of surface_points.
  Eigen::Vector3f relative(const Eigen::Vector3d& position) const {
    return (position - origin).cast<float>();
  }
};

/// Result of a first pass over a file.
struct IntensitySurvey {
  PointFileSources sources;
  std::map<std::uint16_t, SwathTrack> tracks;  ///< of some of the points, by point source id
  bool has_time = true;
  std::uint64_t zeros = 0;  ///< points of intensity 0
  double largest = 0.0;     ///< intensity
  double first_time = 0.0, last_time = 0.0;
};

/// Specification of a window.
struct WindowRequest {
  const StripAssignment* arrangement = nullptr;  ///< needed: the strips of the points
  std::size_t file = 0;                          ///< place of the input in it
  /// Whether surfaces will be computed: points of other windows within this distance (metres) of
  /// the points of each source are included; sources without a margin have none.
  bool surfaces = true;
  std::map<std::uint16_t, double> margins;
  /// The records of the window, where the caller has them (LAS): the file is not read again.
  const std::byte* records = nullptr;
  std::size_t record_length = 0;
};

/** \brief A point file, read window by window.
 *
 * LAS: windows are runs of records. The first pass stores a box for every 4096 records and strip
 * (32 bytes each); a window is read with the records of blocks within the margin. A file in order
 * of time or of place therefore needs the memory of a window; a file whose windows have more than
 * kMostNeighbours points around them is unordered and refused (InputError). PCD: one window, the
 * whole file.
 */
class IntensityInput {
 public:
  static constexpr std::size_t kWindow = std::size_t{1} << 17;
  /// Without surfaces, windows larger than the cache of a processor have no advantage.
  static constexpr std::size_t kSmallWindow = std::size_t{1} << 13;
  static constexpr std::size_t kMostNeighbours = std::size_t{1} << 22;

  virtual ~IntensityInput() = default;
  struct Options {
    std::string gain_control;  ///< name of an extra field to read; empty: none
    std::size_t window = kWindow;
    int threads = 0;  ///< 0: all cores
    /// Intensities are the energies of echoes, amplitude times echo_width (extra bytes of
    /// decomposed LAS files); 0 for points without an echo. InputError for files without them.
    bool echo_energy = false;
  };
  /// Opens a file according to its extension.
  static std::unique_ptr<IntensityInput> open(const std::string& path, const Options& options);

  const std::string& path() const { return path_; }
  const IntensitySurvey& survey() const { return survey_; }
  virtual std::size_t windows() const = 0;
  std::size_t windowSize() const { return window_; }  ///< points
  virtual void load(std::size_t window, const WindowRequest& request,
                    IntensityWindow& out) const = 0;
  /// The file; null for a PCD.
  virtual const LasFile* las() const { return nullptr; }
  /// The whole cloud; null for a LAS.
  virtual const Strip<PointLidar>* strip() const { return nullptr; }
  /// What a copy of the file loses, and what is assumed of it (PointReader::remarks()).
  virtual std::vector<std::string> remarks() const { return {}; }

 protected:
  explicit IntensityInput(std::string path) : path_(std::move(path)) {}
  std::string path_;
  std::size_t window_ = kWindow;
  IntensitySurvey survey_;
};

}  // namespace pcl_als
