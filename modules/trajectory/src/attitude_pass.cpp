// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "attitude_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <Eigen/LU>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {
namespace {

constexpr double kDegree = kRadiansPerDegree;
// Estimation.
constexpr double kWalk = 2.5e-3;  // rad per bin: 1.4 degrees per second, a bumpy flight
constexpr double kPrior =
    0.1;  // rad, of both angles over a pass: where pulses contain no information
constexpr double kMostCounted = 100.0;  // pulses of a bin: motion within it is common to all
constexpr double kLeastNoise = 5e-4, kMostNoise = 1e-2;  // rad, of a pulse against its plane
constexpr double kWellDetermined = 3e-3;                 // rad, standard deviation of an angle
constexpr std::size_t kFewestBins = 5;                   // of a pass that is judged
// Linear scanners: pulses of a bin are plane to the motion in it (some mrad at most).
constexpr double kOffPlane = 0.01, kFarOffPlane = 0.02;  // rad: median, and of single bins
constexpr double kShareOff = 0.15;                       // of bins that may be far off
// A cone: attitude motion moves pulses off a plane as much as off a cone, so a ratio decides.
constexpr double kFarOffConstant = 2.5 * kDegree, kConeRatio = 3.0;
constexpr double kLeastCone = 5.0 * kDegree, kWidestCone = 60.0 * kDegree;
// Flight practice with a margin: drones fly nose down, small aircraft crab in the wind.
constexpr double kPitchRange = 15.0 * kDegree, kCrabRange = 30.0 * kDegree;
constexpr double kMostPitch = 25.0 * kDegree, kMostCrab = 35.0 * kDegree;
constexpr double kRate = 20.0 * kDegree;  // per second, exceeded by one step in ten

struct Equations {
  Eigen::Matrix2d normal;
  Eigen::Vector2d right;
};

/// y = across x + below z over unit vectors.
Equations equationsOf(const PulseSums& sums) {
  const Eigen::Matrix3d& p = sums.products;
  Equations e;
  e.normal << p(0, 0), p(0, 2), p(0, 2), p(2, 2);
  e.right << p(0, 1), p(1, 2);
  return e;
}

double rmsOffPlane(const PulseSums& sums, const Eigen::Vector2d& plane) {
  const Equations e = equationsOf(sums);
  const double left = sums.products(1, 1) - 2.0 * plane.dot(e.right) + plane.dot(e.normal * plane);
  return std::sqrt(std::max(0.0, left) / std::max(1.0, sums.n));
}

Eigen::Vector2d ownPlane(const PulseSums& sums) {
  Equations e = equationsOf(sums);
  e.normal.diagonal().array() += 1e-6;
  return e.normal.inverse() * e.right;
}

/// Noise of a pulse: the median of the bins' own.
double noiseOf(const std::vector<PassBin>& bins) {
  std::vector<double> off;
  for (const PassBin& bin : bins) {
    if (bin.sums.n >= kFewestOfBin) off.push_back(bin.off_plane);
  }
  return off.empty() ? kMostNoise : std::clamp(medianInPlace(off), kLeastNoise, kMostNoise);
}

AttitudeRecovery::Range rangeOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(0.02), at(0.98)};
}

double middle(const AttitudeRecovery::Range& range) {
  return 0.5 * (range.low + range.high);
}

/// Whether steps from bin to bin are faster than anything flies.
bool jumps(const std::vector<PassBin>& bins) {
  std::size_t steps = 0, fast = 0;
  for (std::size_t i = 1; i < bins.size(); ++i) {
    if (!bins[i].well_determined || !bins[i - 1].well_determined) continue;
    ++steps;
    const double most = std::max(std::abs(bins[i].pitch() - bins[i - 1].pitch()),
                                 std::abs(bins[i].crab() - bins[i - 1].crab()));
    if (most > kRate * kAttitudeBin) ++fast;
  }
  return steps >= 2 * kFewestBins && 10 * fast > steps;
}

/// The whole pass against one plane and one cone, e . m = 1 for unit vectors e.
void fitWhole(const PulseSums& all, AttitudeRecovery::Pass& pass) {
  pass.off_constant = rmsOffPlane(all, ownPlane(all));
  Eigen::Matrix3d products = all.products;
  products.diagonal().array() += 1e-9 * all.n;
  const Eigen::Vector3d m = products.inverse() * all.sum;
  const double length = m.norm();
  if (!(length > 1.0)) return;
  const double left = std::max(0.0, all.n - 2.0 * m.dot(all.sum) + m.dot(all.products * m));
  pass.cone_angle = std::acos(1.0 / length);
  pass.off_cone = std::sqrt(left / all.n) / std::tan(pass.cone_angle);
}

AttitudeRecovery::Verdict verdictOn(const AttitudeRecovery::Pass& pass, bool jumping) {
  using Verdict = AttitudeRecovery::Verdict;
  const bool cone = pass.off_constant > kFarOffConstant &&
                    kConeRatio * pass.off_cone < pass.off_constant &&
                    pass.cone_angle > kLeastCone && pass.cone_angle < kWidestCone;
  if (cone) return Verdict::conical;
  if (pass.off_plane > kOffPlane || pass.share_off > kShareOff) return Verdict::not_planar;
  const bool flown = pass.pitch.high - pass.pitch.low < kPitchRange &&
                     pass.crab.high - pass.crab.low < kCrabRange &&
                     std::abs(middle(pass.pitch)) < kMostPitch &&
                     std::abs(middle(pass.crab)) < kMostCrab && !jumping;
  return flown ? Verdict::linear : Verdict::implausible;
}

}  // namespace

double PassBin::crab() const {
  return std::atan(plane[0]);
}
double PassBin::pitch() const {
  return std::atan(-plane[1] * std::cos(crab()));
}

/// Forward elimination and back substitution of the block tridiagonal normal equations.
void smoothPlanes(std::vector<PassBin>& bins) {
  for (PassBin& bin : bins) bin.off_plane = rmsOffPlane(bin.sums, ownPlane(bin.sums));
  const double noise = noiseOf(bins);
  const double prior = 1.0 / (kPrior * kPrior * static_cast<double>(bins.size()));
  std::vector<Equations> reduced(bins.size());
  std::vector<double> ties(bins.size(), 0.0);  // to the bin before
  for (std::size_t i = 0; i < bins.size(); ++i) {
    PassBin& bin = bins[i];
    const double weight = std::min(1.0, kMostCounted / std::max(1.0, bin.sums.n)) / (noise * noise);
    Equations e = equationsOf(bin.sums);
    e.normal *= weight, e.right *= weight;
    const double weakest = symmetricEigenvalues2(e.normal)[0];
    bin.well_determined =
        bin.sums.n >= kFewestOfBin && weakest * kWellDetermined * kWellDetermined > 1.0;
    e.normal.diagonal().array() += prior;
    if (i > 0) {
      ties[i] = 1.0 / (kWalk * kWalk * static_cast<double>(bin.index - bins[i - 1].index));
      e.normal.diagonal().array() += ties[i];
      Equations& last = reduced[i - 1];
      last.normal.diagonal().array() += ties[i];
      const Eigen::Matrix2d inverse = last.normal.inverse();
      e.normal -= ties[i] * ties[i] * inverse;
      e.right += ties[i] * (inverse * last.right);
    }
    reduced[i] = e;
  }
  for (std::size_t i = bins.size(); i-- > 0;) {
    Eigen::Vector2d right = reduced[i].right;
    if (i + 1 < bins.size()) right += ties[i + 1] * bins[i + 1].plane;
    bins[i].plane = reduced[i].normal.inverse() * right;
  }
}

AttitudeRecovery::Pass judgePass(const std::vector<PassBin>& bins) {
  AttitudeRecovery::Pass pass;
  std::vector<double> pitch, crab, off;
  PulseSums all;
  double far = 0.0;
  for (const PassBin& bin : bins) {
    all.add(bin.sums);
    if (bin.sums.n < kFewestOfBin) continue;
    off.push_back(bin.off_plane);
    if (bin.off_plane > kFarOffPlane) far += 1.0;
    if (!bin.well_determined) continue;
    pitch.push_back(bin.pitch()), crab.push_back(bin.crab());
  }
  pass.points = all.n;
  if (off.size() < kFewestBins) return pass;
  pass.share_off = far / static_cast<double>(off.size());
  pass.off_plane = medianInPlace(off);
  const bool enough = pitch.size() >= kFewestBins;
  pass.pitch = rangeOf(std::move(pitch)), pass.crab = rangeOf(std::move(crab));
  fitWhole(all, pass);
  pass.verdict = verdictOn(pass, jumps(bins));
  if (pass.verdict == AttitudeRecovery::Verdict::linear && !enough) {
    pass.verdict = AttitudeRecovery::Verdict::undetermined;
  }
  return pass;
}

double recordedScale(const std::vector<PassBin>& bins) {
  // Whole degrees in a narrow part of a swath still correlate by 0.9; angles are those of pulses,
  // so the scale is 1 to the crab and pitch of a flight.
  constexpr double kFollows = 0.9, kLargestChange = 0.25;
  double n = 0.0, ss = 0.0, sr = 0.0, rr = 0.0;
  for (const PassBin& bin : bins) {
    const PulseSums& b = bin.sums;
    if (b.angles < kFewestOfBin) continue;
    n += b.angles;
    ss += b.seen_sq - b.seen * b.seen / b.angles;
    sr += b.seen_recorded - b.seen * b.recorded / b.angles;
    rr += b.recorded_sq - b.recorded * b.recorded / b.angles;
  }
  const bool follows = n > 0.0 && ss > 0.0 && rr > 0.0 && sr * sr > kFollows * kFollows * ss * rr;
  const double scale = follows ? sr / ss : 0.0;
  return std::abs(std::abs(scale) - 1.0) < kLargestChange
             ? scale
             : std::numeric_limits<double>::quiet_NaN();
}

std::string objectionTo(const AttitudeRecovery::Pass& pass) {
  char text[200];
  switch (pass.verdict) {
    case AttitudeRecovery::Verdict::conical:
      std::snprintf(text, sizeof text,
                    "the pulses lie on a cone of %.0f degrees around the vertical",
                    pass.cone_angle / kDegree);
      break;
    case AttitudeRecovery::Verdict::not_planar:
      if (pass.off_plane > kOffPlane)
        std::snprintf(text, sizeof text, "the pulses lie in no plane (%.2f degrees off it)",
                      pass.off_plane / kDegree);
      else
        std::snprintf(text, sizeof text,
                      "in %.0f %% of the tenths of a second the pulses lie in no plane (more than "
                      "%.1f degrees off it)",
                      100.0 * pass.share_off, kFarOffPlane / kDegree);
      break;
    case AttitudeRecovery::Verdict::implausible:
      std::snprintf(text, sizeof text,
                    "the pulses of short times lie in planes that nothing flies with: %s",
                    AttitudeRecovery::describe(pass.pitch, pass.crab).c_str());
      break;
    case AttitudeRecovery::Verdict::linear:
    case AttitudeRecovery::Verdict::undetermined:
      return {};
  }
  return text;
}

}  // namespace pcl_als::detail
