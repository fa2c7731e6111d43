// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/simulation/radiometry.h>

namespace pcl_als::simulation {

namespace {

constexpr double kAxisEnergy = 0.5, kRingEnergy = 1.0 / 12.0;
/// Largest tangent of the incidence; of walls it would be without limit.
constexpr double kSteepestTangent = 3.0;

}  // namespace

double tangentOfIncidence(double cosine) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return sine < kSteepestTangent * cosine ? sine / cosine : kSteepestTangent;
}

double returnedShare(double cosine, double exponent) {
  return exponent == 1.0 ? cosine : std::pow(cosine, exponent);
}

void appendBackscatter(const std::vector<SurfaceHit>& hits, const Eigen::Vector3d& direction,
                       double energy, double incidence_exponent, std::vector<Backscatter>& parts) {
  for (const SurfaceHit& hit : hits) {
    const double share = energy * hit.opacity;
    const bool leaves = hit.cover == LandCover::tree;
    const double cosine = std::abs(hit.normal.dot(direction));
    const double signal = share * hit.reflectance *
                          (leaves ? kFoliageCosine : returnedShare(cosine, incidence_exponent));
    parts.push_back({hit.range, share, signal, hit.reflectance,
                     leaves ? 0.0 : tangentOfIncidence(cosine), hit.cover});
    energy -= share;
  }
}

Echo joinedEchoes(const Echo& a, const Echo& b) {
  Echo sum = a.signal >= b.signal ? a : b;  // keeps the cover of the stronger
  sum.share = a.share + b.share;
  sum.signal = a.signal + b.signal;
  sum.reflectance = (a.share * a.reflectance + b.share * b.reflectance) / sum.share;
  const double p = sum.signal > 0.0 ? a.signal / sum.signal : a.share / sum.share, q = 1.0 - p;
  sum.range = p * a.range + q * b.range;
  sum.tangent = p * a.tangent + q * b.tangent;
  sum.spread = std::sqrt(p * a.spread * a.spread + q * b.spread * b.spread +
                         p * q * (a.range - b.range) * (a.range - b.range));
  return sum;
}

Echo echoOf(const Backscatter& part) {
  return {part.range, part.share, part.signal, 0.0, part.reflectance, part.tangent, part.cover};
}

void PulseTracer::addParts(const Eigen::Vector3d& direction, double energy) {
  appendBackscatter(hits_, direction, energy, scanner_.incidence_exponent, parts_);
}

/// The ring of six rays on the 1/e^2 circle of the beam.
void PulseTracer::addRing(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const double half = 0.5 * scanner_.divergence;
  const Eigen::Vector3d a = direction.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d b = direction.cross(a);
  const double third = std::sqrt(0.75);
  const std::array<Eigen::Vector2d, 6> ring = {
      {{1.0, 0.0}, {0.5, third}, {-0.5, third}, {-1.0, 0.0}, {-0.5, -third}, {0.5, -third}}};
  for (const Eigen::Vector2d& place : ring) {
    const Eigen::Vector3d ray = (direction + half * (place.x() * a + place.y() * b)).normalized();
    if (scene_.trace(origin, ray, hits_)) addParts(ray, kRingEnergy);
  }
}

/// On open ground the ring would see the same plane: its mean is the axis, its spread is known.
bool PulseTracer::formOpenGroundEcho(const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) {
  const SurfaceHit& hit = hits_.front();
  if (hit.object != SurfaceHit::kGround) return false;
  if (!scene_.isOpen(origin, direction, hit.range, scanner_.divergence * hit.range)) return false;
  const double cosine = std::abs(hit.normal.dot(direction));
  Echo& echo = echoes_.emplace_back();
  echo.range = hit.range;
  echo.share = 1.0;
  echo.signal = hit.reflectance * returnedShare(cosine, scanner_.incidence_exponent);
  echo.tangent = tangentOfIncidence(cosine);
  echo.spread = 0.25 * scanner_.divergence * hit.range * echo.tangent;
  echo.reflectance = hit.reflectance;
  echo.cover = hit.cover;
  return true;
}

/// Greedy from the nearest part: what lies within the separation of an echo's start belongs to it.
void PulseTracer::formEchoes() {
  std::stable_sort(parts_.begin(), parts_.end(),
                   [](const Backscatter& a, const Backscatter& b) { return a.range < b.range; });
  double start = 0.0;
  for (const Backscatter& part : parts_) {
    const Echo echo = echoOf(part);
    if (echoes_.empty() || part.range - start >= scanner_.return_separation) {
      echoes_.push_back(echo);
      start = part.range;
      continue;
    }
    Echo& last = echoes_.back();
    const Echo first = last;
    last = joinedEchoes(first, echo);
    if (footprint_) continue;
    last.range = start;  // the point lies on the surface that was met first
    last.cover = first.cover;
  }
}

void PulseTracer::mergeCloseEchoes() {
  for (std::size_t i = 1; i < echoes_.size();) {
    if (echoes_[i].range - echoes_[i - 1].range >= scanner_.return_separation) {
      ++i;
      continue;
    }
    echoes_[i - 1] = joinedEchoes(echoes_[i - 1], echoes_[i]);
    echoes_.erase(echoes_.begin() + static_cast<std::ptrdiff_t>(i));
    if (i > 1) --i;  // the joint range has moved: look at the pair before again
  }
}

const std::vector<Echo>& PulseTracer::trace(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) {
  parts_.clear();
  echoes_.clear();
  if (!scene_.trace(origin, direction, hits_)) return echoes_;
  if (footprint_) {
    if (formOpenGroundEcho(origin, direction)) return echoes_;
    addParts(direction, kAxisEnergy);
    addRing(origin, direction);
  } else {
    addParts(direction, 1.0);
  }
  formEchoes();
  if (footprint_) mergeCloseEchoes();
  const auto faint = [this](const Echo& e) { return e.share < scanner_.detection_threshold; };
  echoes_.erase(std::remove_if(echoes_.begin(), echoes_.end(), faint), echoes_.end());
  const auto limit = static_cast<std::size_t>(scanner_.max_returns);
  if (echoes_.size() > limit) echoes_.resize(limit);
  return echoes_;
}

}  // namespace pcl_als::simulation
