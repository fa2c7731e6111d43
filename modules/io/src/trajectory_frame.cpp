// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Records of a trajectory file brought to the frame of the points.
#include <cmath>
#include <cstdio>
#include <memory>

#include <pcl_als/common/attitude_form.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/crs/map_projection.h>

#include "trajectory_records.h"

namespace pcl_als::detail {
namespace {

/// Undulations to subtract: a number of metres or a grid.
class Undulation {
 public:
  explicit Undulation(const std::string& text) {
    if (const auto metres = finiteNumber(text))
      constant_ = *metres;
    else
      grid_ = std::make_unique<GeoidGrid>(text);
  }
  double at(double latitude, double longitude) const {
    return grid_ ? grid_->undulation(latitude, longitude) : constant_;
  }
  bool isConstant() const { return !grid_; }

 private:
  double constant_ = 0.0;
  std::unique_ptr<GeoidGrid> grid_;
};

/// One file on its way to the frame of the points.
class FrameChange {
 public:
  FrameChange(TrajectoryRecords& records, const std::filesystem::path& path,
              const TrajectoryReading& reading)
      : records_(records), path_(path), reading_(reading) {
    map_ = records.coordinates == TrajectoryCoordinates::map;
    const bool other_map = map_ && !reading.own_crs.empty() && !reading.crs.empty() &&
                           !sameGroundFrame(reading.own_crs, reading.crs);
    if (!reading.geoid.empty()) undulation_ = std::make_unique<Undulation>(reading.geoid);
    if (!map_ || other_map) projection_ = std::make_unique<MapProjection>(targetCrs(), sourceCrs());
    const bool geographic = records.coordinates == TrajectoryCoordinates::geographic;
    if ((!map_ || !headingIsTrue()) && (!needsGeodetic() || geographic)) return;
    if (reading.crs.empty()) {
      throw UsageError(
          path.string() +
              ": the CRS of the points is needed for the direction of true north and for "
              "a grid of the geoid, such as EPSG:25832",
          Hint::crs);
    }
    geodetic_ = std::make_unique<MapProjection>(targetCrs());
  }

  void apply() {
    for (std::size_t i = 0; i < records_.samples.size(); ++i) {
      TrajectorySample& sample = records_.samples[i];
      if (reading_.axes == AttitudeAxes::enu) takeAsEastNorthUp(sample, AttitudeForm::heading, 0.0);
      const double turn = place(sample);
      if (!sample.position.allFinite()) {
        throw InputError(path_.string() + ": record " + std::to_string(i + 1) +
                         ": the position is outside the CRS");
      }
      if (records_.attitude != AttitudeForm::heading) records_.turns.push_back(turn);
      if (!std::isnan(sample.heading)) {
        if (turn != 0.0 || projection_) sample.heading = wholeTurn(sample.heading + turn);
        largest_turn_ = std::max(largest_turn_, std::abs(turn));
      }
    }
    if (largest_turn_ == 0.0) records_.turns.clear();
    remark();
  }

 private:
  bool headingIsTrue() const {
    if (reading_.north == NorthReference::by_coordinates) return !map_ || records_.heading_is_true;
    return reading_.north == NorthReference::true_north;
  }
  bool needsGeodetic() const { return undulation_ && !undulation_->isConstant(); }

  /// Orthometric heights are not changed: PROJ is given the horizontal part, which hands them
  /// through.
  std::string targetCrs() const {
    return records_.orthometric || undulation_ ? horizontalCrs(reading_.crs) : reading_.crs;
  }
  std::string sourceCrs() const {
    if (!reading_.own_crs.empty()) return reading_.own_crs;
    return records_.coordinates == TrajectoryCoordinates::geocentric ? "EPSG:4978" : "";
  }

  /// Moves a sample into the frame; the return value is what its heading is turned by.
  double place(TrajectorySample& sample) const {
    if (map_) sample.position *= reading_.unit.metres;
    Eigen::Vector3d ground = sample.position, geodetic = sample.position;
    double turn = 0.0;
    if (projection_) {
      // Map coordinates count their headings from their own grid north.
      const MapProjection::Result mapped = projection_->project(sample.position);
      ground = mapped.position;
      turn = map_ || headingIsTrue() ? mapped.north_azimuth : 0.0;
    }
    if (geodetic_) {
      geodetic = geodetic_->unproject(ground);
      if (map_ && headingIsTrue()) turn = geodetic_->project(geodetic).north_azimuth;
    }
    if (undulation_) ground.z() -= undulation_->at(geodetic.x(), geodetic.y());
    sample.position = ground;
    return turn;
  }

  void remark() {
    char text[200];
    if (headingIsTrue() && largest_turn_ > 0.0) {
      std::snprintf(text, sizeof text,
                    "headings are from true north: turned to grid north, by up to %.3f degrees",
                    largest_turn_ / kRadiansPerDegree);
      records_.remarks.emplace_back(text);
    }
    if (!map_ && !records_.orthometric && !undulation_) {
      records_.remarks.emplace_back(
          horizontalCrs(reading_.crs) != reading_.crs
              ? "ellipsoidal heights are brought to the vertical part of the CRS of the points"
              : "its heights are ellipsoidal; the CRS of the points has no vertical part: where "
                "theirs are above a geoid, the undulation has to be given");
    }
    if (undulation_) records_.remarks.push_back("geoid undulation subtracted from its heights");
    if (records_.orthometric)
      records_.remarks.push_back("its heights are above a geoid by their name: taken as they are");
  }

  TrajectoryRecords& records_;
  const std::filesystem::path& path_;
  const TrajectoryReading& reading_;
  bool map_ = true;
  double largest_turn_ = 0.0;
  std::unique_ptr<MapProjection> projection_, geodetic_;
  std::unique_ptr<Undulation> undulation_;
};

}  // namespace

std::string frameText(const TrajectoryRecords& records, const TrajectoryReading& reading) {
  const std::string own =
      reading.own_crs.empty() ? std::string() : ", " + shortCrsName(reading.own_crs);
  const std::string height = records.orthometric ? "height above a geoid" : "ellipsoidal height";
  switch (records.coordinates) {
    case TrajectoryCoordinates::geographic:
      return "latitude, longitude and " + height +
             (own.empty() ? ", datum not stated: WGS 84 (ITRF) assumed" : own);
    case TrajectoryCoordinates::geocentric:
      return "geocentric" + (own.empty() ? ", datum not stated: WGS 84 (ITRF) assumed" : own);
    case TrajectoryCoordinates::map:
      break;
  }
  return "map coordinates" + (own.empty() ? ", those of the points assumed" : own);
}

TrajectoryFile inPointFrame(TrajectoryRecords records, const std::filesystem::path& path,
                            const TrajectoryReading& reading) {
  if (records.coordinates != TrajectoryCoordinates::map) {
    const std::string what = records.format == "SBET" ? "an SBET is in latitude and longitude"
                                                      : "its coordinates are not on a map";
    if (reading.crs.empty()) {
      throw UsageError(path.string() + ": " + what +
                           ", and the points name no CRS to project it to, such as EPSG:25832",
                       Hint::crs);
    }
    if (!reading.unit.isMetre()) {
      throw UsageError(path.string() + ": " + what + " and metres; its unit is not " +
                       reading.unit.name);
    }
  }
  TrajectoryFile file;
  file.format = records.format;
  file.columns = records.columns;
  file.frame = frameText(records, reading);
  FrameChange(records, path, reading).apply();
  if (reading.axes == AttitudeAxes::by_course && records.attitude != AttitudeForm::heading) {
    file.attitude = records.attitude;
    file.turns = std::move(records.turns);
  }
  file.samples = std::move(records.samples);
  file.places = std::move(records.places);
  file.accuracy = std::move(records.accuracy);
  file.remarks = std::move(records.remarks);
  return file;
}

}  // namespace pcl_als::detail
