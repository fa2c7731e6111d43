// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/strip_naming.h>

#include "point_fill.h"

namespace pcl_als {
namespace {

// The corner of a square is 3.54 km from its centre, within LocalFrame::kReach.
constexpr double kSquare = 5000.0;
static_assert(kSquare * 0.7072 < LocalFrame::kReach);

/// A strip while it is filled: one part, or one per square of the grid.
class StripBuilder {
 public:
  void extend(const PointSource& source) {
    low_ = points_ == 0 ? source.minimum : low_.cwiseMin(source.minimum);
    high_ = points_ == 0 ? source.maximum : high_.cwiseMax(source.maximum);
    points_ += source.points;
  }

  void begin(const std::string& id, const std::string& crs) {
    id_ = id;
    crs_ = crs;
    whole_ = 0.5 * (high_ - low_).head<2>().norm() < LocalFrame::kReach - 10.0;
    if (whole_) newPart({0, 0}, 0.5 * (low_ + high_)).cloud->reserve(points_);
  }

  void add(const PointChunk& chunk, std::size_t row) {
    Strip<PointLidar>& part = whole_ ? parts_.begin()->second : partAt(chunk.x[row], chunk.y[row]);
    part.cloud->push_back(detail::pointOf(chunk, row, part.frame.origin));
  }

  void moveTo(std::vector<Strip<PointLidar>>& strips) {
    for (auto& part : parts_) strips.push_back(std::move(part.second));
  }

 private:
  using Square = std::pair<long, long>;

  Strip<PointLidar>& newPart(const Square& square, const Eigen::Vector3d& centre) {
    Strip<PointLidar>& part = parts_[square];
    part.id = id_;
    part.frame = LocalFrame::around(centre, crs_);
    part.cloud->sensor_origin_.head<3>() = part.frame.origin.cast<float>();
    return part;
  }

  Strip<PointLidar>& partAt(double x, double y) {
    const Square square{std::lround(std::floor(x / kSquare)), std::lround(std::floor(y / kSquare))};
    const auto found = parts_.find(square);
    if (found != parts_.end()) return found->second;
    return newPart(square, {(square.first + 0.5) * kSquare, (square.second + 0.5) * kSquare,
                            0.5 * (low_.z() + high_.z())});
  }

  std::string id_, crs_;
  std::uint64_t points_ = 0;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
  bool whole_ = true;
  std::map<Square, Strip<PointLidar>> parts_;
};

std::string commonCrs(const std::vector<PointFileSources>& files) {
  std::vector<PointFileInfo> infos;
  infos.reserve(files.size());
  for (const PointFileSources& file : files) infos.push_back(file.info);
  return commonReference(infos).crs;
}

void checkTimes(const std::vector<PointFileSources>& files) {
  for (const PointFileSources& file : files)
    if (file.info.time_kind != files[0].info.time_kind)
      throw InputError(file.info.path.string() + ": has another kind of GPS time than " +
                       files[0].info.path.string() +
                       " (seconds of the week, adjusted standard time, or none)");
}

}  // namespace

std::vector<Strip<PointLidar>> loadStrips(const std::vector<std::filesystem::path>& paths) {
  std::vector<PointFileSources> files;
  files.reserve(paths.size());
  for (const auto& path : paths) files.push_back(surveySources(path));
  checkTimes(files);
  const std::string crs = commonCrs(files);
  const StripNaming naming(files);
  std::map<std::string, StripBuilder> builders;
  for (std::size_t f = 0; f < files.size(); ++f)
    for (const PointSource& source : files[f].sources)
      builders[naming.nameOf(f, source.id)].extend(source);
  for (auto& [name, builder] : builders) builder.begin(name, crs);

  PointChunk chunk;
  for (std::size_t f = 0; f < paths.size(); ++f) {
    std::map<std::uint16_t, StripBuilder*> of_id;
    for (const PointSource& source : files[f].sources)
      of_id[source.id] = &builders[naming.nameOf(f, source.id)];
    const auto reader = PointReader::open(paths[f]);
    while (reader->read(chunk))
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const auto builder = of_id.find(chunk.point_source_id[i]);
        if (builder == of_id.end())
          throw InputError(paths[f].string() + ": was changed while it was read");
        builder->second->add(chunk, i);
      }
  }
  std::vector<Strip<PointLidar>> strips;
  for (const std::string& name : naming.names()) builders[name].moveTo(strips);
  return strips;
}

}  // namespace pcl_als
