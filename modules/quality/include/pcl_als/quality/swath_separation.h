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
#include <pcl_als/quality/swath_point.h>

namespace pcl_als {

/** \brief The vertical separation of strips on a grid, and the swath separation image of the USGS
 * Lidar Base Specification: that separation as green, yellow or red over the intensity.
 *
 * Of every cell and strip the mean position, height and intensity of the last returns are kept
 * (withheld points and noise left out, as the specification requires; no threshold), and the return
 * nearest to the cell's centre, which replaces the mean where the cell holds several surfaces (a
 * step of half a metre). Where strips share a cell, each one's height is carried to the cell's
 * centre along the local slope, found from its neighbours, unless these lie on no plane (eaves,
 * trees); the separation is the largest height minus the smallest. So a slope by itself separates
 * nothing.
 *
 * Different strips may be added from different threads. Memory: 40 bytes per cell and strip, in
 * blocks of 32 x 32 cells where a strip has points.
 */
class SwathSeparation {
 public:
  /// \param grid of the image; points beside it are ignored
  SwathSeparation(RasterGrid grid, std::size_t strips);

  void add(int strip, const SwathPoint& point);
  const RasterGrid& grid() const { return grid_; }

  struct Cell {
    std::uint8_t strips = 0;  ///< that see it
    float separation = 0.0F;  ///< metres; where two or more do
    float intensity = 0.0F;   ///< mean of all
  };
  /// The cells of \a rows rows from \a first_row on, row by row.
  std::vector<Cell> rows(int first_row, int rows) const;

  /// Intensities that 2 % and 98 % of the cells do not exceed, from every so manyth cell.
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

    /// Where the strip's surface is taken to be.
    const Place& place() const;
  };
  using Block = std::vector<Sum>;
  struct StripBlocks {
    std::unordered_map<std::int64_t, Block> blocks;
    double height = 0.0;  ///< that z counts from: of the strip's first point, metres
    bool any = false;
    std::int64_t last_key = -1;
    Block* last = nullptr;  ///< neighbouring points fall into the same block
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

/// One pixel: the colour over the grey of the intensity, half each; grey alone where one strip sees
/// the cell; black where none does.
struct SeparationPixel {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 0;
};
SeparationPixel separationPixel(const SwathSeparation::Cell& cell,
                                const SwathSeparation::Stretch& stretch, double limit);

}  // namespace pcl_als
