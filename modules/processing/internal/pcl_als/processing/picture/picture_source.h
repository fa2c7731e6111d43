// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/plane_grid.h>
#include <pcl_als/drawing/point_picture.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/survey/surveyed_file.h>

namespace pcl_als {

/** \brief The point files of a picture: strips by name, extents, and all points with the attributes
 * by which they are coloured, chunk by chunk.
 */
class PictureSource {
 public:
  /// Reads all files once. InputError for a file that cannot be read and where no file has a
  /// point.
  /// \a split: divide into flight lines, as StripChoice. \a window: the part of the files that is
  /// read.
  explicit PictureSource(const std::vector<std::string>& paths, bool split = false,
                         const PointWindow& window = {});

  const std::vector<std::string>& strips() const { return survey_.strips(); }
  std::uint64_t pointCount() const { return survey_.pointCount(); }
  const Eigen::Vector3d& minimum() const { return minimum_; }  ///< of the finite points
  const Eigen::Vector3d& maximum() const { return maximum_; }
  double firstTime() const { return first_time_; }
  const std::vector<SurveyedFile>& files() const { return survey_.files(); }
  /// Units that are converted or assumed, one line each.
  const std::vector<std::string>& remarks() const { return survey_.reference().remarks; }

  /// Cells for a SectionSearch among the chosen strips.
  double sectionCell(const std::vector<bool>& chosen) const;
  /// Side of a cell in which a strip has a given number of points on average, 0.5 to 20 m.
  double cellFor(int strip, double points) const;

  /// Attributes of one point in a picture.
  struct Point {
    Eigen::Vector3d position;
    int strip;
    std::size_t index;        ///< in the chunk
    const PointChunk* chunk;  ///< with PointChunk::extra, if a field was requested
  };
  /// Calls \a sink with every point, in file order. \a extra_field: empty or the name of an
  /// extra-bytes field; UsageError where no file has it, points of files without it get NaN.
  void read(const std::function<void(const Point&)>& sink,
            const std::string& extra_field = {}) const;

 private:
  SurveyReader survey_;
  Eigen::Vector3d minimum_, maximum_;
  double first_time_ = 0.0;
};

/// The attribute by which points are coloured.
class PointAttribute {
 public:
  /// elevation, intensity, strip, class, return, scan_angle, time, difference, or an extra-bytes
  /// field. For difference, \a reference is the strip to which heights refer.
  PointAttribute(std::string name, const PictureSource& source, const std::string& reference);

  const std::string& extraField() const { return extra_field_; }
  /// Reads the data needed before the first value: for difference, the reference strip.
  void prepare(double cell);
  float valueOf(const PictureSource::Point& point) const;
  /// Colours and legend; the scale is not yet fitted.
  PointColoring coloring() const;
  bool symmetric() const { return name_ == "difference"; }
  /// Whether points of that strip are shown when no strips are chosen: all but the reference.
  int hiddenStrip() const { return reference_; }

 private:
  float differenceOf(const PictureSource::Point& point) const;

  std::string name_, extra_field_;
  const PictureSource& source_;
  int reference_ = -1;
  std::optional<PlaneGrid> planes_;
};

}  // namespace pcl_als
