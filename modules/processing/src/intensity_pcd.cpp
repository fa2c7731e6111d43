// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intensity_pcd.h"

#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>

#include "intensity_survey.h"
#include "surface_points.h"

namespace pcl_als {
namespace {

class PcdInput : public IntensityInput {
 public:
  PcdInput(const std::string& path, const Options& options)
      : IntensityInput(path), strip_(loadPcd(path, {}, findings_)) {
    if (!options.gain_control.empty())
      throw UsageError(path + ": is a PCD; gain control is read from LAS");
    survey_.sources.info = PointReader::open(path)->info();
    SurveyStatistics counters;
    PointChunk places;
    std::uint16_t source = 0;
    for (const PointLidar& point : *strip_.cloud) {
      const PointRun run = runOf(point);
      counters.add(run);
      if (run.source != source) counters.addPlaces(source, std::exchange(places, {}));
      source = run.source;
      places.x.push_back(run.minimum.x());
      places.y.push_back(run.minimum.y());
      places.gps_time.push_back(secondsOfTime(point.gps_time));
    }
    counters.addPlaces(source, places);
    counters.store(survey_);
  }

  std::size_t windows() const override { return strip_.cloud->empty() ? 0 : 1; }
  const Strip<PointLidar>* strip() const override { return &strip_; }
  std::vector<std::string> remarks() const override { return findings_.remarks; }

  void load(std::size_t, const WindowRequest& request, IntensityWindow& out) const override {
    out.origin = strip_.frame.origin;
    out.points.clear();
    out.surface_points.clear();
    out.gain_control.clear();
    StripAssignment::Assigner sorter(*request.arrangement, request.file);
    SurfacePoints surface_points(*request.arrangement, out);
    for (const PointLidar& p : *strip_.cloud) {
      IntensityPoint& point = out.points.emplace_back(pointOf(p));
      point.label = labelOf(sorter, point);
      surface_points.add(point);
    }
  }

 private:
  IntensityPoint pointOf(const PointLidar& p) const {
    IntensityPoint point;
    point.position = strip_.frame.toGround(p.getVector3fMap());
    point.time = secondsOfTime(p.gps_time);
    point.intensity = p.intensity;
    point.return_number = p.return_number;
    point.number_of_returns = p.number_of_returns;
    point.classification = p.classification;
    point.source = p.point_source_id;
    return point;
  }
  PointRun runOf(const PointLidar& point) const {
    PointRun run;
    run.source = point.point_source_id;
    run.points = 1;
    run.zeros = point.intensity == 0.0F ? 1 : 0;
    run.largest = static_cast<double>(point.intensity);
    run.zero_time = point.gps_time == 0.0;
    if (!run.zero_time) run.times.add(secondsOfTime(point.gps_time));
    run.minimum = run.maximum = strip_.frame.toGround(point.getVector3fMap());
    return run;
  }

  PcdFindings findings_;  // filled with the strip, so before it
  Strip<PointLidar> strip_;
};

}  // namespace

std::unique_ptr<IntensityInput> openIntensityPcd(const std::string& path,
                                                 const IntensityInput::Options& options) {
  return std::make_unique<PcdInput>(path, options);
}

}  // namespace pcl_als
