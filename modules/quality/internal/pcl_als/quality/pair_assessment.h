// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/quality/offset_sample.h>
#include <pcl_als/quality/overlap_trends.h>

namespace pcl_als {

/** \brief The movement of strip a onto strip b from signed point-to-plane offsets on slopes (ASPRS
 * Guidelines on Geometric Inter-Swath Accuracy, 2018): n . s = d, with the surface normals n of
 * slopes over 10 degrees.
 */
struct HorizontalShift {
  bool determined = false;
  std::string reason;  ///< why it is not determined
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d std_formal = Eigen::Vector3d::Zero();  ///< metres; with independent cells
  std::size_t count = 0;
  double rms = 0.0;  ///< of the residuals, metres
};

/// Normal distances on slopes of one class of slope and aspect.
struct SlopeAspectClass {
  double slope_from = 0.0, slope_to = 0.0;  ///< degrees
  int aspect = -1;  ///< downhill direction: 0 north, 1 north-east … 7 north-west; -1: all
  std::size_t count = 0;
  double mean = 0.0, rms = 0.0;  ///< a - b along the normal, metres
};
const char* aspectName(int aspect);

/// Agreement of two overlapping strips. Signs are those of a - b, movements take a onto b.
struct PairAssessment {
  enum class Status {
    judged,
    too_little,  ///< too few places of comparison
    copy,        ///< both strips contain the same points
    too_far,     ///< further apart than surfaces are compared
  };
  Status status = Status::too_little;
  std::string reason;  ///< why it is not judged
  double apart = 0.0;  ///< too_far: height of a above b, metres, to decimetres

  OffsetSummary vertical;            ///< smooth ground of single returns below 10 degrees
  OffsetSummary vertical_cells;      ///< of the means of cells of OffsetSample::kCluster metres
  OffsetSummary normal;              ///< all smooth surfaces, along the normal
  std::optional<int> quality_level;  ///< by vertical.rms; empty: none
  HorizontalShift horizontal;
  std::vector<SlopeAspectClass> classes;
  OverlapTrends trends;
};

const char* toString(PairAssessment::Status status);
const char* toString(FlightRelation relation);

PairAssessment assessPair(const std::vector<OffsetSample>& samples,
                          const std::optional<Eigen::Vector2d>& course_a,
                          const std::optional<Eigen::Vector2d>& course_b);

/// Mean height differences of cells of OffsetSample::kCluster metres, by OffsetSample::cluster().
using CellMeans = std::map<std::int64_t, double>;
CellMeans cellMeans(const std::vector<OffsetSample>& samples);

/// The offsets of a pair, for the closure of triangles.
struct PairOffset {
  std::string a, b;
  CellMeans cells;
};

/// Three strips that cover the same ground: closure of the offsets, a-b + b-c - (a-c), as the mean
/// over the cells that all three pairs have. On different ground the trajectory errors of the
/// strips differ, and closure is not expected.
struct TriangleClosure {
  std::string a, b, c;
  std::size_t cells = 0;
  double closure = 0.0, std = 0.0;  ///< metres; of the mean, from the scatter of the cells
};
std::vector<TriangleClosure> closeTriangles(const std::vector<PairOffset>& pairs);

}  // namespace pcl_als
