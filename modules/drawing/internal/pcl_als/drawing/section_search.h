// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/plane_grid.h>
#include <pcl_als/drawing/section.h>

namespace pcl_als {

/** \brief Finds the places where a misfit of strips is seen best: across gable roofs, and where
 * there are none across opposite slopes and along slopes.
 *
 * Planes are fitted to square cells strip by strip. Cells that slope, are smooth and alike in at
 * least two strips are candidates; two of them that fall away from each other make opposite slopes.
 * These are a gable roof only where both sides are faces of several cells in one plane, the surface
 * between them follows the two planes up to a sharp ridge, and the ground beyond lies well below.
 * Places are ranked by the height difference of the strips on both sides, more strips before fewer,
 * and kept apart.
 *
 * Memory: 44 bytes per cell and strip, of all strips together at most some 400 MB (cells grow).
 */
class SectionSearch {
 public:
  struct Place {
    SectionLine line;
    enum class Kind { gable, opposite_slopes, slope } kind = Kind::slope;
    std::size_t strips = 0;   ///< that see both sides
    double difference = 0.0;  ///< mean over the sides of the strips' largest height difference, m
  };

  /// \param strips number of strips; \param cell about ten points of a strip should fall in one
  SectionSearch(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double cell,
                std::size_t strips);

  void add(const Eigen::Vector3d& ground, std::size_t strip) { grids_[strip].add(ground); }

  /// The best places, up to a number; fewer where there are no more, none where strips do not
  /// overlap on slopes.
  std::vector<Place> find(std::size_t most) const;

 private:
  /// A cell that two strips or more see as the same slope.
  struct Slope {
    Eigen::Vector2d center, downhill;  ///< downhill: unit
    double height, tangent, difference;
    std::size_t strips;

    double heightAt(const Eigen::Vector2d& place) const {
      return height - tangent * downhill.dot(place - center);
    }
  };
  using Slopes = std::map<std::pair<int, int>, Slope>;  ///< by row and column
  std::optional<Slope> slopeAt(int column, int row) const;
  std::optional<Place> oppositeOf(const Slopes& slopes, const std::pair<int, int>& cell) const;
  bool isGable(const Slopes& slopes, const Slope& side, const Slope& other) const;
  std::size_t faceCells(const Slopes& slopes, const Slope& face) const;
  bool fallsBeyond(const Slope& face) const;
  std::optional<double> surfaceAt(const Eigen::Vector2d& place) const;
  std::optional<Place> slopeAround(const Slopes& slopes, const std::pair<int, int>& cell) const;

  std::vector<PlaneGrid> grids_;
};

}  // namespace pcl_als
