// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pcl/filters/filter.h>

#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/common/raster.h>

namespace pcl_als {

/** \brief Classifies single points by their own values and those of their raster cell.
 *
 * The band height is the height of the point above the terrain of its cell, surface its height and
 * intensity its own intensity; all other bands are those of the cell. A return from under a tree
 * can therefore be ground. Thread-safe.
 */
class PointClassifier {
 public:
  /// UsageError if the raster lacks a band that the model needs (terrain for height).
  PointClassifier(std::shared_ptr<const MaximumLikelihood> classifier,
                  std::shared_ptr<const Raster> raster);

  /// The class of a point. \a x, \a y, \a z: metres, ground frame. No class outside the raster.
  MaximumLikelihood::Decision classify(double x, double y, double z, double intensity) const;
  /// The class of a point whose cell is known. \a cell: RasterGrid::index().
  MaximumLikelihood::Decision classifyIn(std::size_t cell, double z, double intensity) const;
  const GaussianModel& model() const { return classifier_->model(); }

 private:
  enum class Source { cell, above_terrain, elevation, intensity };

  std::shared_ptr<const MaximumLikelihood> classifier_;
  std::shared_ptr<const Raster> raster_;
  std::vector<Source> sources_;
  std::vector<const float*> bands_;
};

/// ASPRS class code of a land cover class: tree, trees and vegetation 5, grass 3, soil and ground
/// 2, built-up and building 6, road 11, water 9; 1 (unclassified) for other names.
std::uint8_t asprsCodeOf(const std::string& class_name);

/// Whether an ASPRS class code is that of noise (7 low, 18 high).
constexpr bool isNoise(std::uint8_t code) {
  return code == 7 || code == 18;
}

/** \brief Writes into each point's classification the ASPRS code of its land cover.
 *
 * Points that are not classified (outside the raster, rejected, not finite) and noise points (7,
 * 18) keep their code. All other fields and the order of the points are kept; the input is not
 * changed. UsageError (in filter()) without a classifier. For other point types with x, y, z,
 * intensity and classification include impl/land_cover_filter.hpp.
 * \code
 * pcl_als::LandCoverFilter<pcl_als::PointLidar> filter;
 * filter.setClassifier(std::make_shared<pcl_als::PointClassifier>(likelihood, raster));
 * filter.setLocalFrame(strip.frame);
 * filter.setInputCloud(strip.cloud);
 * filter.filter(classified);
 * \endcode
 */
template <typename PointT>
class LandCoverFilter : public pcl::Filter<PointT> {
 public:
  using Ptr = std::shared_ptr<LandCoverFilter<PointT>>;
  using ConstPtr = std::shared_ptr<const LandCoverFilter<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  LandCoverFilter() { this->filter_name_ = "LandCoverFilter"; }

  void setClassifier(std::shared_ptr<const PointClassifier> classifier) {
    classifier_ = std::move(classifier);
  }
  std::shared_ptr<const PointClassifier> getClassifier() const { return classifier_; }

  /// Frame of the cloud's coordinates, Strip::frame; default: the origin of the ground frame.
  void setLocalFrame(const LocalFrame& frame) { frame_ = frame; }
  const LocalFrame& getLocalFrame() const { return frame_; }

  /// ASPRS codes by class name; other classes have the code of asprsCodeOf().
  void setCodes(std::map<std::string, std::uint8_t> codes) { codes_ = std::move(codes); }
  const std::map<std::string, std::uint8_t>& getCodes() const { return codes_; }

  /// Number of points of the last filter() that were not classified, including noise points.
  std::size_t getUnclassified() const { return unclassified_; }

 protected:
  void applyFilter(PointCloud& output) override;

 private:
  std::shared_ptr<const PointClassifier> classifier_;
  LocalFrame frame_;
  std::map<std::string, std::uint8_t> codes_;
  std::size_t unclassified_ = 0;
};

extern template class LandCoverFilter<PointLidar>;

}  // namespace pcl_als
