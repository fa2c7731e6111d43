// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <tuple>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/path_evidence.h>

#include "pulse_pairing.h"

namespace pcl_als {
namespace {

constexpr double kLeastSeparation = 0.3;  // metres: shorter spans show no direction
constexpr double kLargestAngle = 75.0;    // degrees

/// Rays with larger separations first; the rest makes the order unique.
bool better(const PulseRay& a, const PulseRay& b) {
  const auto key = [](const PulseRay& r) {
    return std::make_tuple(-r.span.squaredNorm(), r.time, r.lower.x(), r.lower.y());
  };
  return key(a) < key(b);
}

}  // namespace

class PathEvidence::State {
 public:
  detail::PulsePairing pairing;
};

PathEvidence::PathEvidence() : state_(std::make_unique<State>()) {}
PathEvidence::~PathEvidence() = default;
PathEvidence::PathEvidence(PathEvidence&&) noexcept = default;
PathEvidence& PathEvidence::operator=(PathEvidence&&) noexcept = default;

PathEvidence::Bin& PathEvidence::binOf(double time) {
  const auto index = static_cast<std::int64_t>(std::floor(time / kBin));
  if (current_bin_ == nullptr || index != current_) {
    current_ = index;
    current_bin_ = &bins_[index];
  }
  return *current_bin_;
}

void PathEvidence::add(const LidarReturn& point) {
  ++counts_.points;
  if (!std::isfinite(point.time) || point.time == 0.0 || !point.position.allFinite()) {
    ++counts_.timeless;
    return;
  }
  if (point.isWithheld() || point.isNoise()) {
    ++counts_.excluded;
    return;
  }
  if (bins_.empty()) {
    origin_ = point.position;
    counts_.first = counts_.last = point.time;
  }
  counts_.first = std::min(counts_.first, point.time);
  counts_.last = std::max(counts_.last, point.time);
  times_.add(point.time);
  Bin& bin = binOf(point.time);
  if (bin.points == 0.0) bin.first = bin.last = point.time;
  bin.first = std::min(bin.first, point.time);
  bin.last = std::max(bin.last, point.time);
  bin.points += 1.0;
  if (point.number_of_returns > 1 && counts_.multiple++ == 0) dropRaysByTime();
  if (std::isfinite(point.scan_angle)) addAngle(bin, point);
  state_->pairing.add(
      point, [this](const LidarReturn& lower, const LidarReturn& upper) { addRay(lower, upper); });
}

void PathEvidence::Counts::merge(const Counts& other) {
  const bool fresh = points == timeless + excluded;
  const bool none = other.points == other.timeless + other.excluded;
  if (!none) {
    first = fresh ? other.first : std::min(first, other.first);
    last = fresh ? other.last : std::max(last, other.last);
  }
  points += other.points;
  timeless += other.timeless;
  excluded += other.excluded;
  rays += other.rays;
  multiple += other.multiple;
  ambiguous += other.ambiguous;
  duplicates += other.duplicates;
  by_time += other.by_time;
  angles += other.angles;
  whole_degrees = whole_degrees && other.whole_degrees;
}

/// Adds sums that are relative to a place \a shift from the own origin.
void PathEvidence::mergeAngles(Bin& bin, const ScanAngleSums& sums, const Eigen::Vector3d& shift) {
  ScanAngleSums& own = classOf(bin, sums.index);
  own.n += sums.n;
  own.time += sums.time;
  own.plan_z += sums.plan_z + shift.z() * sums.position.head<2>() +
                (sums.position.z() + sums.n * shift.z()) * shift.head<2>();
  own.position += sums.position + sums.n * shift;
  own.tangent += sums.tangent;
  own.tangent_z += sums.tangent_z + shift.z() * sums.tangent;
}

ScanAngleSums& PathEvidence::classOf(Bin& bin, int index) {
  const auto place =
      std::lower_bound(bin.angles.begin(), bin.angles.end(), index,
                       [](const ScanAngleSums& sums, int value) { return sums.index < value; });
  if (place != bin.angles.end() && place->index == index) return *place;
  ScanAngleSums fresh;
  fresh.index = index;
  return *bin.angles.insert(place, fresh);
}

void PathEvidence::addAngle(Bin& bin, const LidarReturn& point) {
  const auto angle = static_cast<double>(point.scan_angle);
  if (std::abs(angle) > kLargestAngle) return;
  if (angle != 0.0) ++counts_.angles;
  if (angle != std::round(angle)) counts_.whole_degrees = false;
  const int index = static_cast<int>(std::lround(angle / kClassWidth));
  ScanAngleSums& sums = classOf(bin, index);
  const Eigen::Vector3d position = point.position - origin_;
  const double tangent = std::tan(angle * kRadiansPerDegree);
  sums.n += 1.0;
  sums.time += point.time - static_cast<double>(current_) * kBin;
  sums.position += position;
  sums.plan_z += position.z() * position.head<2>();
  sums.tangent += tangent;
  sums.tangent_z += tangent * position.z();
}

/// Points of equal, rounded times are not pulses.
void PathEvidence::dropRaysByTime() {
  counts_.rays = 0;
  for (auto& entry : bins_) {
    Bin& bin = entry.second;
    const auto end = std::remove_if(bin.rays.begin(), bin.rays.end(),
                                    [](const PulseRay& ray) { return ray.by_time; });
    bin.rays.erase(end, bin.rays.end());
    counts_.rays += bin.rays.size();
    std::make_heap(bin.rays.begin(), bin.rays.end(), better);
  }
}

void PathEvidence::addRay(const LidarReturn& lower, const LidarReturn& upper) {
  PulseRay ray;
  ray.time = lower.time;
  ray.lower = lower.position;
  ray.span = (upper.position - lower.position).cast<float>();
  if (ray.separation() < kLeastSeparation) return;
  ray.by_time = lower.number_of_returns < 2 && upper.number_of_returns < 2 &&
                lower.return_number < 2 && upper.return_number < 2;
  if (ray.by_time && counts_.multiple > 0) return;
  ++counts_.rays;
  std::vector<PulseRay>& rays = bins_[static_cast<std::int64_t>(std::floor(ray.time / kBin))].rays;
  if (rays.size() < kRays) {
    rays.push_back(ray);
    std::push_heap(rays.begin(), rays.end(), better);
  } else if (better(ray, rays.front())) {  // the worst is in front
    std::pop_heap(rays.begin(), rays.end(), better);
    rays.back() = ray;
    std::push_heap(rays.begin(), rays.end(), better);
  }
}

void PathEvidence::finish() {
  state_->pairing.finish(
      [this](const LidarReturn& lower, const LidarReturn& upper) { addRay(lower, upper); });
  counts_.ambiguous = state_->pairing.ambiguous();
  counts_.duplicates = state_->pairing.duplicates();
  counts_.by_time = counts_.multiple > 0 ? 0 : state_->pairing.byTime();
  for (auto& entry : bins_) std::sort(entry.second.rays.begin(), entry.second.rays.end(), better);
}

void PathEvidence::merge(const PathEvidence& other) {
  if (bins_.empty()) origin_ = other.origin_;
  for (const auto& [index, bin] : other.bins_) {
    auto [place, fresh] = bins_.try_emplace(index);
    Bin& own = place->second;
    own.first = fresh ? bin.first : std::min(own.first, bin.first);
    own.last = fresh ? bin.last : std::max(own.last, bin.last);
    own.points += bin.points;
    own.rays.insert(own.rays.end(), bin.rays.begin(), bin.rays.end());
    std::sort(own.rays.begin(), own.rays.end(), better);
    own.rays.resize(std::min(own.rays.size(), kRays));
    for (const ScanAngleSums& sums : bin.angles) mergeAngles(own, sums, other.origin_ - origin_);
  }
  counts_.merge(other.counts_);
  if (counts_.multiple > 0 && counts_.by_time > 0) {
    dropRaysByTime();
    counts_.by_time = 0;
  }
  times_.add(other.times_);
}

std::vector<TimeRange> PathEvidence::passes(double gap) const {
  std::vector<TimeRange> found;
  for (const auto& entry : bins_) {
    const Bin& bin = entry.second;
    if (found.empty() || bin.first - found.back().last > gap) found.emplace_back();
    found.back().add(bin.first);
    found.back().add(bin.last);
  }
  return found;
}

}  // namespace pcl_als
