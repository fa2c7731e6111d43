// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "echo_cross_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/las/las_sample.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "file_times.h"

namespace pcl_als::detail {
namespace {

/// Pulses from which the coefficient of the whole pulse is estimated, about.
constexpr std::uint64_t kPulsesForCoefficient = 20000;
/// Single echoes that this needs.
constexpr std::size_t kLeastSingles = 20;

}  // namespace

EchoCrossSections::EchoCrossSections(const LasFile& las, const CrossSectionSettings& settings)
    : las_(las),
      settings_(settings),
      metres_(las.toMetres()),
      metres_per_unit_(metres_.scale.cwiseQuotient(las.header().scale).cwiseAbs()),
      model_(settings.model) {
  model_.check();
  if (las.layout().gps_time < 0)
    throw InputError(las.path().string() + ": point format " + std::to_string(las.layout().format) +
                     " has no GPS time; the range of a point needs it");
  times_ = alignmentOf(las, *settings.trajectory, settings.gps_week);
  result_.constant = model_.constant;
  result_.calibrated = !settings.targets.empty() || model_.constant != 1.0;
  if (!settings.force) requireReach();
}

/// Ranges from a trajectory of another flight, or in other units, are numbers without meaning.
void EchoCrossSections::requireReach() const {
  TrajectoryPlausibility check(settings_.trajectory,
                               TrajectoryPlausibility::Attitude::not_compared);
  const int strip = check.addStrip(las_.path().string());
  samplePoints(las_, SampleSize(), [&](const PointChunk& chunk) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const double time = times_(chunk.gps_time[i]);
      check.add(strip, time, chunk.point(i, time).position);
    }
  });
  const std::string reason = check.whyOutOfReach(strip);
  if (!reason.empty())
    throw InputError(las_.path().string() +
                     ": its points cannot have been measured from the trajectory, " + reason);
}

bool EchoCrossSections::sightOf(const std::byte* record, std::size_t& node, Sight& sight) const {
  SensorPose pose;
  const double time = times_(las_.layout().timeOf(record));
  if (!settings_.trajectory->poseAt(time, pose, node)) return false;
  const Eigen::Vector3d up = pose.position - positionOf(record);
  sight.range = up.norm();
  sight.cosine = up.z() / sight.range;
  return up.z() > 0.0;
}

void EchoCrossSections::evaluate(const WaveformPulse& pulse, const PulseEchoes& echoes,
                                 std::size_t& node, PulseSections& out) const {
  out.covered = true;
  out.cross_section.clear();
  out.coefficient.clear();
  for (int e = 0; e < echoes.count() && out.covered; ++e) {
    const std::byte* record = pulse.records + echoes.nearestReturn(e) * las_.header().record_length;
    const WaveformReference own = WaveformReference::of(record, las_.layout());
    Sight sight;
    out.covered = sightOf(record, node, sight);
    const double behind = echoes.timeOf(e) - static_cast<double>(own.location_ps);
    const double range =
        sight.range + behind * own.alongPulse().cwiseProduct(metres_per_unit_).norm();
    out.cross_section.push_back(model_.crossSection(range, echoes.energyOf(e)));
    out.coefficient.push_back(model_.coefficient(range, out.cross_section.back()));
  }
  out.transmission.assign(out.coefficient.size(), 1.0);
  if (!out.covered || !(result_.full_coefficient > 0.0)) return;
  out.transmission = pulseTransmissions(out.coefficient, result_.full_coefficient,
                                        CrossSectionResult::kLeastTransmission);
  for (std::size_t e = 0; e < out.transmission.size(); ++e) {
    out.cross_section[e] /= out.transmission[e];
    out.coefficient[e] /= out.transmission[e];
  }
}

void EchoCrossSections::useTargets(const ReferenceCalibration& calibration) {
  result_.reference = calibration.solve();
  if (!(result_.reference->constant > 0.0))
    throw InputError(las_.path().string() + ": no reference target has " +
                     std::to_string(ReferenceCalibration::kLeastPoints) +
                     " pulses with a single echo: cross sections cannot be calibrated");
  result_.constant = model_.constant = 1.0 / result_.reference->constant;
}

void EchoCrossSections::calibrate(const WaveformSource& source,
                                  const std::map<unsigned, PulseResponse>& responses,
                                  const EchoSettings& echo_settings) {
  const bool with_targets = !settings_.targets.empty();
  if (!with_targets && !settings_.correct_attenuation) return;
  std::optional<ReferenceCalibration> targets;
  if (with_targets) {
    targets.emplace(settings_.targets, settings_.target_radius);
    model_.constant = 1.0;
  }
  const std::uint64_t every = 1 + las_.header().point_count / kPulsesForCoefficient;
  WaveformReader reader(source);
  PulseEchoes echoes(responses, echo_settings);
  Waveform waveform;
  std::vector<double> coefficients;
  std::size_t node = 0;
  std::uint64_t pulses = 0;
  readPulses(las_, [&](const std::vector<WaveformPulse>& block) {
    for (const WaveformPulse& pulse : block) {
      const Eigen::Vector3d at = positionOf(pulse.records);
      const bool near = targets && targets->touches(at.x(), at.y(), at.x(), at.y());
      const bool sampled = settings_.correct_attenuation && pulses++ % every == 0;
      Sight sight;
      if ((!near && !sampled) || pulse.count > 1 ||
          las_.layout().numberOfReturnsOf(pulse.records) > 1 ||
          !sightOf(pulse.records, node, sight) ||
          !reader.read(pulse.records, pulse.first, waveform))
        continue;
      echoes.decompose(waveform, {static_cast<double>(waveform.reference.location_ps)});
      if (echoes.count() != 1 || echoes.echoOf(0) < 0 || echoes.found().saturated > 0) continue;
      const double energy = echoes.energyOf(0);
      if (near) targets->add(at.x(), at.y(), model_.reflectance(sight.range, energy, sight.cosine));
      if (sampled)
        coefficients.push_back(
            model_.coefficient(sight.range, model_.crossSection(sight.range, energy)));
    }
  });
  if (targets) useTargets(*targets);
  if (!settings_.correct_attenuation) return;
  if (coefficients.size() < kLeastSingles)
    throw InputError(las_.path().string() +
                     ": too few pulses have a single echo to estimate the backscatter coefficient "
                     "of a whole pulse");
  result_.full_coefficient = (targets ? model_.constant : 1.0) * medianInPlace(coefficients);
}

}  // namespace pcl_als::detail
