// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "coordinate_cause.h"
#include "ray_offset.h"

namespace pcl_als {
namespace {

// Half of the widest field of view of airborne scanners, and of the widest forward directions (the
// fore and aft planes of a multi-look scanner, the skew of a slanted mirror) with attitude motion
// on top.
constexpr double kWidest = 75.0 * kRadiansPerDegree, kFarthestAhead = 35.0 * kRadiansPerDegree;
constexpr double kHighest = 20e3;     // metres above the ground: beyond what aircraft reach
constexpr double kSlowest = 1.0;      // m/s: below it the course is that of the noise
constexpr double kLongestStep = 1.0;  // seconds: of a strip with one time, which has no step
// The firing point is wrong by up to half the way flown in a step; as a share of the height that
// is an angle of the pulse. A hundredth is 0.6 degrees, as much as AttitudeRecovery corrects.
constexpr double kCoarseRefused = 0.01, kCoarseSuspicious = 0.001;
constexpr double kLargestDatumShift = 1000.0;  // metres: most national datums against WGS 84

// Shares of the height above ground. A trajectory that is displaced by one percent changes the
// corrections of a calibration by as much; beyond three, intensities and incidence angles as well.
constexpr double kDisplacedSuspicious = 0.01, kDisplacedRefused = 0.03;

std::string metres(double value) {
  return std::to_string(std::lround(value)) + " m";
}

const char* const kRemedy =
    ": give the trajectory of this flight, on the clock and in the coordinates and units of the "
    "points";

}  // namespace

TrajectoryPlausibility::TrajectoryPlausibility(std::shared_ptr<const Trajectory> flight,
                                               Attitude attitude)
    : flight_(std::move(flight)), attitude_(attitude) {
  if (attitude != Attitude::not_compared && flight_->hasAttitude() &&
      !flight_->attitudeIsNominal()) {
    path_ = std::make_shared<const Trajectory>(flight_->withoutAttitude());
  }
}

int TrajectoryPlausibility::addStrip(const std::string& name) {
  strips_.emplace_back().name = name;
  if (path_) strips_.back().recovery.emplace(path_);
  return static_cast<int>(strips_.size()) - 1;
}

void TrajectoryPlausibility::release() {
  for (Strip& strip : strips_) strip.recovery.reset();
  path_.reset();
}

std::size_t TrajectoryPlausibility::spacing(std::size_t count, double duration) const {
  constexpr double kMaximumSpacing = 32.0, kPointsPerSecond = 1e4;
  if (!path_) return static_cast<std::size_t>(kMaximumSpacing);
  const double every = static_cast<double>(count) / (kPointsPerSecond * std::abs(duration));
  return every < kMaximumSpacing ? std::max<std::size_t>(1, static_cast<std::size_t>(every))
                                 : static_cast<std::size_t>(kMaximumSpacing);
}

void TrajectoryPlausibility::addRun(int strip, const LidarReturn* points, std::size_t count) {
  if (count == 0) return;
  const std::size_t every = spacing(count, points[count - 1].time - points[0].time);
  for (std::size_t i = 0; i < count; ++i) {
    addTime(strip, points[i].time);
    if (i % every == 0) add(strip, points[i].time, points[i].position, points[i].scan_angle);
  }
}

void TrajectoryPlausibility::add(int strip, double time, const Eigen::Vector3d& point,
                                 double scan_angle) {
  Strip& s = strips_[static_cast<std::size_t>(strip)];
  SensorPose pose;
  PathSpan path;
  if (!point.allFinite() || !flight_->poseAt(time, pose, s.cursor) ||
      !flight_->pathAt(time, path, s.path_cursor)) {
    return;
  }
  ++s.count;
  if (s.recovery) s.recovery->add(time, point, scan_angle * kRadiansPerDegree);
  const double speed = path.velocity.head<2>().norm();
  s.speed_sum += speed;
  const Eigen::Vector3d forward = pose.rotation.col(1);
  if (flight_->hasAttitude() && speed > kSlowest) {
    s.heading.add(std::atan2(path.velocity.x(), path.velocity.y()),
                  std::atan2(forward.x(), forward.y()));
  }
  const Eigen::Vector3d d = point - pose.position;
  s.point_sum += point, s.sensor_sum += pose.position;
  if (speed > kSlowest) s.along_sum += path.velocity.head<2>().dot(d.head<2>()) / speed;
  if (d.z() >= 0.0) {
    ++s.above;
    return;
  }
  // Seen along the course: a wrong heading is another finding.
  const Eigen::Vector2d direction = speed > kSlowest
                                        ? Eigen::Vector2d(path.velocity.head<2>() / speed)
                                        : Eigen::Vector2d(forward.head<2>().normalized());
  const double along = direction.dot(d.head<2>());
  const double lateral = direction.y() * d.x() - direction.x() * d.y();
  if (std::isfinite(scan_angle))
    s.angles.add(lateral, along, -d.z(), scan_angle * kRadiansPerDegree);
  s.direction_sum += direction;
  s.mean_ahead_sum += forward.dot(d);
  s.height_sum -= d.z();
  s.slope_sum -= along / d.z(), s.slope_sum_sq += along * along / (d.z() * d.z());
  if (std::abs(lateral) > -std::tan(kWidest) * d.z()) {
    ++s.beside;
    s.beside_sum += std::abs(lateral);
  }
  // From the height, not the range: the edge of a wide swath is far, and not ahead.
  if (std::abs(along) > std::tan(kFarthestAhead) * std::hypot(d.z(), lateral)) {
    ++s.ahead;
    s.ahead_sum += std::abs(along);
  }
}

void TrajectoryPlausibility::putStrip(int strip, ByteWriter& out) const {
  const Strip& s = strips_[static_cast<std::size_t>(strip)];
  out.put(s.count).put(s.above).put(s.beside).put(s.ahead).put(s.beside_sum).put(s.ahead_sum);
  out.put(s.direction_sum).put(s.mean_ahead_sum).put(s.height_sum).put(s.slope_sum);
  out.put(s.slope_sum_sq).put(s.speed_sum).put(s.along_sum).put(s.point_sum).put(s.sensor_sum);
  out.plain(s.heading).plain(s.angles);
  s.times.put(out);
  if (s.recovery) s.recovery->put(out);
}

void TrajectoryPlausibility::getStrip(int strip, ByteReader& in) {
  Strip& s = strips_[static_cast<std::size_t>(strip)];
  in.get(s.count).get(s.above).get(s.beside).get(s.ahead).get(s.beside_sum).get(s.ahead_sum);
  in.get(s.direction_sum).get(s.mean_ahead_sum).get(s.height_sum).get(s.slope_sum);
  in.get(s.slope_sum_sq).get(s.speed_sum).get(s.along_sum).get(s.point_sum).get(s.sensor_sum);
  in.plain(s.heading).plain(s.angles);
  s.times.get(in);
  if (s.recovery) s.recovery->get(in);
}

std::string TrajectoryPlausibility::objection(const Strip& strip) {
  const auto most = [&strip](std::size_t some) { return 2 * some > strip.count; };
  const auto mean = [](double sum, std::size_t some) {
    return metres(sum / static_cast<double>(some));
  };
  if (most(strip.above)) return "its points lie above the trajectory";
  const double below = static_cast<double>(strip.count - strip.above);
  if (below > 0.0 && strip.height_sum > kHighest * below) {
    return "its points lie " + metres(strip.height_sum / below) + " below the trajectory";
  }
  if (most(strip.beside)) {
    return "its points lie " + mean(strip.beside_sum, strip.beside) + " beside the trajectory";
  }
  if (most(strip.ahead)) {
    return "its points lie " + mean(strip.ahead_sum, strip.ahead) +
           " ahead of or behind where they were fired";
  }
  return {};
}

Warning TrajectoryPlausibility::causeOf(const Strip& strip) {
  const auto count = static_cast<double>(strip.count);
  const std::string place =
      detail::coordinateCause(strip.sensor_sum / count, strip.point_sum / count);
  if (!place.empty() || strip.speed_sum <= kSlowest * count) return place;
  return detail::timeCause(strip.along_sum / strip.speed_sum);
}

Warning TrajectoryPlausibility::outOfReach(const Strip& strip) {
  const std::string found = objection(strip);
  if (found.empty()) return found;
  Warning cause = causeOf(strip);
  return {cause.text.empty() ? found : found + "; " + cause.text, cause.hint};
}

std::string TrajectoryPlausibility::whyOutOfReach(int strip) const {
  return outOfReach(strips_[static_cast<std::size_t>(strip)]).text;
}

void TrajectoryPlausibility::checkStrips(std::vector<Finding>& findings) const {
  for (const Strip& strip : strips_) {
    if (!strip.used) continue;
    const Warning found = outOfReach(strip);
    if (found.text.empty()) continue;
    findings.push_back({true, {"strip " + strip.name + ": " + found.text + kRemedy, found.hint}});
  }
}

double TrajectoryPlausibility::distancePerStep(int strip) const {
  const Strip& s = strips_[static_cast<std::size_t>(strip)];
  const double step = s.times.step();
  if (s.count == 0 || step == 0.0) return 0.0;
  return std::min(step, kLongestStep) * s.speed_sum / static_cast<double>(s.count);
}

bool TrajectoryPlausibility::timesTooCoarse(int strip) const {
  return 0.5 * distancePerStep(strip) > kCoarseRefused * meanHeight(strip);
}

void TrajectoryPlausibility::checkTimes(std::vector<Finding>& findings) const {
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Strip& s = strips_[i];
    const double height = meanHeight(static_cast<int>(i));
    const double distance = distancePerStep(static_cast<int>(i));
    if (!s.used || height == 0.0 || 0.5 * distance < kCoarseSuspicious * height) continue;
    char moved[32];
    std::snprintf(moved, sizeof moved, "%.2g m", distance);
    findings.push_back({timesTooCoarse(static_cast<int>(i)),
                        "strip " + s.name + ": its times are " + s.times.describe() +
                            ", in a step of which the sensor moves " + moved +
                            ": the place each point was measured from is not known well enough; "
                            "use the points with their original times"});
  }
}

bool TrajectoryPlausibility::viewOf(const Strip& strip, View& view) {
  const auto below = static_cast<double>(strip.count - strip.above);
  if (!strip.used || below == 0.0 || strip.direction_sum.norm() < 0.5 * below) return false;
  view.direction = strip.direction_sum.normalized();
  view.ahead = strip.mean_ahead_sum / below;
  view.height = strip.height_sum / below;
  const double mean = strip.slope_sum / below;
  view.spread = std::sqrt(std::max(0.0, strip.slope_sum_sq / below - mean * mean));
  return true;
}

/// With a displaced trajectory, strips of one direction appear to be measured ahead and strips of
/// the opposite direction behind, which no mounting of the scanner explains:
/// ahead = c height - offset . direction, for all strips together. A displacement across parallel
/// lines is not visible.
Eigen::Vector2d TrajectoryPlausibility::offset(const std::vector<View>& views) const {
  double hh = 0.0, ha = 0.0;
  Eigen::Vector2d hd = Eigen::Vector2d::Zero(), da = hd;
  Eigen::Matrix2d dd = Eigen::Matrix2d::Zero();
  for (const View& view : views) {
    hh += view.height * view.height, ha += view.height * view.ahead;
    hd += view.height * view.direction, da += view.ahead * view.direction;
    dd += view.direction * view.direction.transpose();
  }
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  if (hh == 0.0) return offset;
  // The common forward direction c is eliminated; then each axis with strips of both directions.
  constexpr double kCoveredDirections =
      0.3;  // two strips at a right angle: 1; a turn of 30 degrees: 0.13
  const SymmetricEigen<2> axes = symmetricEigen2(dd - hd * hd.transpose() / hh);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = axes.vectors.col(i);
    if (axes.values[i] < kCoveredDirections) continue;
    offset -= axis * (axis.dot(da - hd * ha / hh) / axes.values[i]);
  }
  return offset;
}

/// The tolerance allows for differences in pitch (5 degrees; one where the attitude is known), and
/// for scanners that measure ahead and behind, of which a part of a strip may contain one more.
void TrajectoryPlausibility::checkOffset(std::vector<Finding>& findings) const {
  std::vector<View> views;
  View view;
  double highest = 0.0, spread = 0.0;
  for (const Strip& strip : strips_) {
    if (!viewOf(strip, view)) continue;
    views.push_back(view);
    highest = std::max(highest, view.height);
    spread = std::max(spread, view.spread);
  }
  const double angle = (path_ ? 1.0 : 5.0) * kRadiansPerDegree;
  const double tolerance = spread > 2.0 * std::tan(angle) ? 2.0 * spread : std::tan(angle);
  const Eigen::Vector2d found = offset(views);
  if (found.norm() <= tolerance * highest) return;
  findings.push_back(
      {true, "the trajectory lies " + metres(found.norm()) + " (east " +
                 std::to_string(std::lround(found.x())) + ", north " +
                 std::to_string(std::lround(found.y())) +
                 ") beside where its points were measured from" +
                 (found.norm() < kLargestDatumShift ? ", as between two geodetic datums" : "") +
                 ": give it in the coordinates of the points"});
}

void TrajectoryPlausibility::checkRays(std::vector<Finding>& findings) const {
  for (const Strip& strip : strips_) {
    if (!strip.used) continue;
    const auto found = detail::rayOffset(strip.rays, *flight_);
    if (!found || !found->exceeds(kDisplacedSuspicious)) continue;
    char text[300];
    std::snprintf(text, sizeof text,
                  "strip %s: the trajectory lies %ld m (east %ld, north %ld, up %ld) beside "
                  "where its points were measured from, as the rays through several returns of a "
                  "pulse show",
                  strip.name.c_str(), std::lround(found->offset.norm()),
                  std::lround(-found->offset.x()), std::lround(-found->offset.y()),
                  std::lround(-found->offset.z()));
    const Warning cause = found->cause();
    findings.push_back(
        {found->exceeds(kDisplacedRefused),
         {text + (cause.text.empty() ? "" : "; " + cause.text) + kRemedy, cause.hint}});
    return;
  }
}

HeightError TrajectoryPlausibility::heightOfStrips() const {
  std::vector<HeightCheck> strips;
  for (const Strip& strip : strips_) {
    if (strip.used) strips.push_back(strip.angles);
  }
  return pcl_als::heightError(strips);
}

void TrajectoryPlausibility::checkHeight(std::vector<Finding>& findings) const {
  const HeightError error = heightOfStrips();
  if (error.kind == HeightError::Kind::none) return;
  const Hint hint = error.undulation ? Hint::geoid : Hint::none;
  findings.push_back({error.kind == HeightError::Kind::gross, {error.text, hint}, true});
}

HeightError TrajectoryPlausibility::heightError() const {
  const std::vector<Finding> all = findings();
  const bool found = std::any_of(all.begin(), all.end(), [](const auto& f) { return f.height; });
  return found ? heightOfStrips() : HeightError();
}

void TrajectoryPlausibility::nameReconstructed(std::vector<Finding>& findings) {
  const std::string given = "the trajectory", other = "the reconstructed trajectory";
  for (Finding& finding : findings) {
    std::string& text = finding.warning.text;
    for (std::size_t at = text.find(given); at != std::string::npos;
         at = text.find(given, at + other.size()))
      text.replace(at, given.size(), other);
  }
}

std::vector<TrajectoryPlausibility::Finding> TrajectoryPlausibility::findings() const {
  std::vector<Finding> findings;
  checkStrips(findings);
  if (!findings.empty()) return findings;  // what follows would repeat it
  checkTimes(findings);
  checkHeading(findings);
  const bool clean = findings.empty();
  checkHeight(findings);
  if (clean) checkRollAndPitch(findings);
  if (findings.empty()) checkOffset(findings);
  if (clean) checkRays(findings);
  if (reconstructed_) nameReconstructed(findings);
  return findings;
}

Warnings TrajectoryPlausibility::check(bool force, bool force_height) const {
  Warnings warnings;
  for (const Finding& finding : findings()) {
    if (finding.refuse && !force && !(finding.height && force_height))
      throw InputError(finding.warning.text, finding.warning.hint);
    warnings.push_back(finding.warning);
  }
  return warnings;
}

}  // namespace pcl_als
