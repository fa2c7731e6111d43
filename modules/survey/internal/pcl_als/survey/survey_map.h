// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

class ByteReader;
class ByteWriter;

/// True for a point that may be part of a solid surface: a last return, not withheld, not noise,
/// not vegetation.
bool isSurfacePoint(const LidarReturn& point);

/// Two strips by their index; first < second.
using StripPair = std::pair<int, int>;

/** \brief First pass over a survey: the ground that each strip covers, and the areas suitable for
 * calibration.
 *
 * Points are added in any order, strip by strip (different strips may be added from different
 * threads). Sums for every 10 m cell of a strip are stored (56 bytes), not the points.
 */
class SurveyMap {
 public:
  static constexpr double kCell = 10.0;  ///< metres

  /// \param anchor south-west corner of the block, origin of the cells (metres, ground frame)
  explicit SurveyMap(const Eigen::Vector2d& anchor);

  int addStrip();  ///< returns its index; not while another thread adds points
  /// A strip whose points are those of a surface and may be few, such as cells of a raster: one
  /// point in a cell of 10 m is enough.
  int addSurface();

  /// Adds points to a strip. Points that are not finite are not added and counted.
  void add(int strip, const LidarReturn* points, std::size_t count);

  std::size_t pointCount(int strip) const { return strips_[strip].points; }
  std::size_t invalidCount(int strip) const { return strips_[strip].invalid; }
  double startTime(int strip) const { return strips_[strip].start; }
  double endTime(int strip) const { return strips_[strip].end; }
  /// Area of the cells with points of a strip, m^2.
  double coveredArea(int strip) const {
    return static_cast<double>(strips_[strip].cells.size()) * kCell * kCell;
  }

  /// All that is known of a strip, for another process.
  void putStrip(int strip, ByteWriter& out) const;
  void getStrip(int strip, ByteReader& in);

  /// The lowest last return of a strip within the cell of 10 m that contains a position, metres;
  /// none where the strip has no point there.
  std::optional<double> lowestAt(int strip, const Eigen::Vector3d& position) const;
  /// Box in plan of the cells with points of a strip, metres; empty where it has none.
  Eigen::AlignedBox2d boxOf(int strip) const;

  struct Overlap {
    StripPair strips;
    double area = 0.0;  ///< m^2 of cells with points of both strips
  };
  /// Every pair of strips with at least \a minimum_area in common, in order.
  std::vector<Overlap> overlaps(double minimum_area) const;

  /// Height of the first strip above the second, however far apart they are: the median over common
  /// cells of the difference of the lowest surface points. Because of slopes it is accurate to
  /// decimetres only. Zero where fewer than 20 cells are common.
  struct HeightOffset {
    double offset = 0.0;  ///< metres
    std::size_t cells = 0;
  };
  HeightOffset heightOffset(const StripPair& pair) const;

  /// Whether two strips hold the same points: as many in the same cells, at the same times.
  bool areCopies(int a, int b) const;

  /// Deletes the cells: from then on strips have numbers of points and times only.
  void releaseCells();

  /** \brief Areas covered by one of the pairs, best first within each part of the block, up to the
   * number of points.
   *
   * The score of an area is its relief of solid surfaces: height variation inside cells, without
   * cells with many multiple returns. The pairs choose in turn, one area from every 4 x 4 group of
   * areas before a second from any, so that the choice is spread along and across the strips.
   */
  std::vector<SurveyArea> selectAreas(const std::vector<StripPair>& pairs,
                                      const AreaSelection& selection) const;

 private:
  struct Cell {
    std::uint32_t points = 0, last_returns = 0, multiple = 0;
    double z_sum = 0.0, z_sq_sum = 0.0, z_reference = 0.0, lowest = 0.0;
  };
  struct StripCells {
    std::unordered_map<std::int64_t, Cell> cells;
    std::size_t points = 0, invalid = 0;
    double start = 0.0, end = 0.0;
    std::uint32_t enough = 10;  ///< last returns of a cell that is compared
  };

  std::int64_t keyOf(const Eigen::Vector3d& position) const;
  static double score(const StripCells& a, const Cell& in_a, const StripCells& b, const Cell& in_b);

  Eigen::Vector2d anchor_;
  std::deque<StripCells> strips_;
};

/// "strip 3 lies 50.12 m above strip 2 (median of 4100 cells of 10 m)"
std::string describe(const SurveyMap::HeightOffset& height, const std::string& a,
                     const std::string& b);

}  // namespace pcl_als
