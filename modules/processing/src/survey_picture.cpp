// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/pixel_thinning.h>
#include <pcl_als/drawing/voxel_thinning.h>
#include <pcl_als/processing/picture/picture_source.h>
#include <pcl_als/processing/picture/survey_picture.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {
namespace {

PointPicture pictureOf(const SurveyPictureOptions& options) {
  if (!options.color_map.empty()) ColorMap::named(options.color_map);
  PointPicture picture(options.width, options.height, options.bare);
  picture.setShade(options.shade);
  picture.setPointSize(options.point_size);
  picture.setTitle(options.title);
  return picture;
}

std::string found(const PictureSource& source, const PixelThinning& points) {
  return grouped(source.pointCount()) + " points, " + grouped(points.seen()) + " in the picture, " +
         grouped(points.shown()) + " shown" +
         (points.invalid() > 0 ? ", " + grouped(points.invalid()) + " without coordinates" : "");
}

}  // namespace

std::string extentText(const Eigen::Vector3d& minimum, const Eigen::Vector3d& maximum) {
  return "x " + numberText(minimum.x(), 1) + " to " + numberText(maximum.x(), 1) + ", y " +
         numberText(minimum.y(), 1) + " to " + numberText(maximum.y(), 1);
}

/// The points of a picture and all that draws them.
class SurveyPicture::Drawing {
 public:
  Drawing(const std::vector<std::string>& files, const SurveyPictureOptions& options,
          const ProgressCallback& callback);
  const OrthographicCamera& camera() const { return camera_; }
  std::uint64_t shownPoints() const { return points_->shown(); }
  Canvas draw() const { return picture_.draw(*points_, coloring_); }
  ColoredPoints thinned() const;

 private:
  bool shows(const PictureSource::Point& point) const;
  void select();
  void frame();
  void fitColours();

  SurveyPictureOptions options_;
  PointPicture picture_;
  OrthographicCamera camera_;
  PictureSource source_;
  PointAttribute attribute_;
  std::vector<bool> chosen_;
  int hidden_ = -1;  ///< strip that is not drawn
  std::unique_ptr<PixelThinning> points_;
  PointColoring coloring_;
};

SurveyPicture::Drawing::Drawing(const std::vector<std::string>& files,
                                const SurveyPictureOptions& options,
                                const ProgressCallback& callback)
    : options_(options),
      picture_(pictureOf(options)),
      camera_(options.azimuth, options.elevation),
      source_(files, options.strips.split, options.window),
      attribute_(options.attribute, source_, options.reference) {
  ProgressReport progress(callback);
  progress.begin("Reading " + counted(files.size(), "file"));
  select();
  attribute_.prepare(options_.difference_cell);
  frame();
  points_ = std::make_unique<PixelThinning>(camera_);
  source_.read(
      [&](const PictureSource::Point& point) {
        if (shows(point)) points_->add(point.position, attribute_.valueOf(point));
      },
      attribute_.extraField());
  if (points_->seen() == 0) throw InputError("no point lies in the picture");
  fitColours();
  picture_.setSubtitle(grouped(points_->seen()) + " points");
  progress.end(found(source_, *points_));
  for (const std::string& remark : source_.remarks()) progress.remark(remark);
}

bool SurveyPicture::Drawing::shows(const PictureSource::Point& point) const {
  if (point.strip == hidden_ || !chosen_[static_cast<std::size_t>(point.strip)]) return false;
  return !options_.extent || options_.extent->contains(point.position.head<2>());
}

void SurveyPicture::Drawing::select() {
  chosen_ = chosenStrips(options_.strips, source_.strips());
  if (options_.strips.only.empty()) hidden_ = attribute_.hiddenStrip();
}

/// The camera shows the points, or in a top view the whole of the extent.
void SurveyPicture::Drawing::frame() {
  ViewExtent extent;
  extent.reference = 0.5 * (source_.minimum() + source_.maximum());
  source_.read([&](const PictureSource::Point& point) {
    if (shows(point)) camera_.add(point.position, extent);
  });
  if (extent.empty()) {
    throw InputError("no point to draw: the files cover " +
                     extentText(source_.minimum(), source_.maximum()));
  }
  if (options_.extent && camera_.isTopView()) {
    extent.low.head<2>() = options_.extent->min() - extent.reference.head<2>();
    extent.high.head<2>() = options_.extent->max() - extent.reference.head<2>();
  }
  camera_.frame(extent, picture_.mapWidth(), picture_.mapHeight(), options_.zoom);
}

void SurveyPicture::Drawing::fitColours() {
  coloring_ = attribute_.coloring();
  if (!coloring_.categories.empty()) {
    coloring_.keepShown(*points_);
    return;
  }
  if (!options_.color_map.empty()) coloring_.map = ColorMap::named(options_.color_map);
  if (options_.range) {
    coloring_.low = options_.range->first, coloring_.high = options_.range->second;
  } else {
    coloring_.fitScale(*points_, attribute_.symmetric() ? 0.05 : 0.01, attribute_.symmetric());
  }
}

ColoredPoints SurveyPicture::Drawing::thinned() const {
  VoxelThinning voxels(camera_.center(), source_.maximum() - source_.minimum());
  source_.read(
      [&](const PictureSource::Point& point) {
        if (shows(point)) voxels.add(point.position, attribute_.valueOf(point));
      },
      attribute_.extraField());
  ColoredPoints points{voxels.positions(), {}};
  for (const float value : voxels.values()) points.colors.push_back(coloring_(value));
  return points;
}

SurveyPicture::SurveyPicture(const std::vector<std::string>& files,
                             const SurveyPictureOptions& options, const ProgressCallback& progress)
    : drawing_(std::make_unique<const Drawing>(files, options, progress)) {}

SurveyPicture::~SurveyPicture() = default;

const OrthographicCamera& SurveyPicture::camera() const {
  return drawing_->camera();
}

std::uint64_t SurveyPicture::shownPoints() const {
  return drawing_->shownPoints();
}

Canvas SurveyPicture::draw() const {
  return drawing_->draw();
}

ColoredPoints SurveyPicture::thinned() const {
  return drawing_->thinned();
}

}  // namespace pcl_als
