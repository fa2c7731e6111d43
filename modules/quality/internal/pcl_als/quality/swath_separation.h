// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/raster.h>
#include <pcl_als/quality/checked_points.h>

namespace pcl_als {

/** \brief The vertical separation of strips on a grid, and the swath separation image of the USGS
 * Lidar Base Specification: that separation as green, yellow or red over the intensity.
 *
 * For every cell and strip the mean position, height and intensity of the last returns are stored
 * (withheld points and noise excluded, as the specification requires; no threshold), and the return
 * nearest to the centre of the cell, which replaces the mean where the cell contains several
 * surfaces (a step of half a metre). Where strips share a cell, the height of each is reduced to
 * the centre of the cell along the local slope, which is estimated from the neighbouring cells
 * unless these do not form a plane (eaves, trees). The separation is the largest height minus the
 * smallest; a slope alone causes none.
 *
 * Different strips may be added from different threads. Memory: 40 bytes per cell and strip, in
 * blocks of 32 x 32 cells where a strip has points.
 */
class SwathSeparation {
 public:
  /// \param grid of the image; points outside are ignored
  SwathSeparation(RasterGrid grid, std::size_t strips);

  void add(int strip, const LidarReturn& point);
  const RasterGrid& grid() const { return grid_; }

  struct Cell {
    std::uint8_t strips = 0;  ///< with points in the cell
    float separation = 0.0F;  ///< metres; where two or more strips have points
    float intensity = 0.0F;   ///< mean of all strips
  };
  /// The cells of \a rows rows from \a first_row on, row by row.
  std::vector<Cell> rows(int first_row, int rows) const;

  /// Intensities that 2 % and 98 % of the cells do not exceed, from a regular sample of cells.
  struct Stretch {
    float low = 0.0F, high = 1.0F;
  };
  Stretch intensityStretch() const;

 private:
  static constexpr int kBlock = 32;  // cells per side
  using Place = Eigen::Vector3f;     ///< metres: east and north of the cell's centre, and height
  struct Sum {
    Place mean = Place::Zero(), nearest = Place::Zero();
    float low = 0.0F, high = 0.0F, intensity = 0.0F;
    std::uint32_t count = 0;

    /// Position of the surface of a strip in a cell.
    const Place& place() const;
  };
  using Block = std::vector<Sum>;
  struct StripBlocks {
    std::unordered_map<std::int64_t, Block> blocks;
    double height = 0.0;  ///< origin of z: the height of the strip's first point, metres
    bool any = false;
    std::int64_t last_key = -1;
    Block* last = nullptr;  ///< block of the last point; neighbouring points belong to the same
  };

  const Sum* at(const StripBlocks& strip, int column, int row) const;
  float heightAtCentre(const StripBlocks& strip, int column, int row, const Sum& sum) const;
  Cell cellAt(int column, int row) const;

  RasterGrid grid_;
  std::deque<StripBlocks> strips_;
};

/// Colours of swath separation images, by the breaks of a quality level.
enum class SeparationColour : std::uint8_t { none, green, yellow, red };

/// \param limit metres: the swath overlap difference (RMSDz) of the quality level; green up to it,
/// yellow up to twice as much
SeparationColour separationColour(float separation, double limit);

/// One pixel: the colour over the grey of the intensity, half each; grey alone where one strip
/// covers the cell; black where none does.
struct SeparationPixel {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 0;
};
SeparationPixel separationPixel(const SwathSeparation::Cell& cell,
                                const SwathSeparation::Stretch& stretch, double limit);

}  // namespace pcl_als
