// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The first looks of IntensityRun at the files.
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/las/las_sample.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/survey/survey_messages.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "flight_check.h"

namespace pcl_als {
namespace {

constexpr std::size_t kProbes = 8;  ///< windows sampled for the spacing of points

/// A file that another process reads: only the result of its first pass is known.
class ForeignInput : public IntensityInput {
 public:
  explicit ForeignInput(const std::string& path) : IntensityInput(path) {}
  std::size_t windows() const override { return 0; }
  void load(std::size_t, const WindowRequest&, IntensityWindow&) const override {
    throw InputError(path_ + ": is read by another process");
  }
  void get(ByteReader& in) {
    detail::get(in, survey_.sources);
    in.getMap(survey_.tracks, [](ByteReader& i, SwathTrack& track) { track.get(i); });
    in.get(survey_.zeros).get(survey_.largest).get(survey_.first_time).get(survey_.last_time);
  }
};

void putSurvey(ByteWriter& out, const IntensitySurvey& survey) {
  detail::put(out, survey.sources);
  out.putMap(survey.tracks, [](ByteWriter& o, const SwathTrack& track) { track.put(o); });
  out.put(survey.zeros).put(survey.largest).put(survey.first_time).put(survey.last_time);
}

}  // namespace

void IntensityRun::shareInputs(const std::vector<std::string>& paths) {
  IntensityInput::Options options;
  options.gain_control = settings_.gain_control;
  options.echo_energy = settings_.echo_energy;
  options.threads = settings_.threads;
  if (!settings_.find_surfaces) options.window = IntensityInput::kSmallWindow;
  inputs_.resize(paths.size());
  doTogether(settings_.processes, [&] {
    for (const std::size_t file : shares_.ownItems()) {
      inputs_[file] = IntensityInput::open(paths[file], options);
      if (inputs_[file]->survey().has_time) continue;
      throw InputError(paths[file] + ": point format " +
                       std::to_string(inputs_[file]->las()->layout().format) +
                       " has no GPS time; the range of a point needs it");
    }
  });
  shareValues(
      settings_.processes, shares_, inputs_,
      [](ByteWriter& out, const std::unique_ptr<IntensityInput>& input) {
        out.put(input->path());
        putSurvey(out, input->survey());
      },
      [](ByteReader& in, std::unique_ptr<IntensityInput>& input) {
        auto foreign = std::make_unique<ForeignInput>(in.take<std::string>());
        foreign->get(in);
        input = std::move(foreign);
      });
}

void IntensityRun::visit(
    std::size_t file,
    const std::function<void(int strip, const Eigen::Vector3d& place)>& each) const {
  SurveyReader::Reading reading;
  reading.files = {file};
  reading.threads = 1;
  survey_->read(
      [&each](const SurveyReader::Run& run) {
        for (std::size_t row = run.from; row < run.to; ++row) each(run.strip, run.position(row));
      },
      reading);
}

struct IntensityRun::Sample {
  int strip;
  LidarReturn point;
};

std::vector<IntensityRun::Sample> IntensityRun::samplesOf(std::size_t file) const {
  const SampleSize size = trajectory_->hasAttitude() ? SampleSize::forAttitude() : SampleSize();
  std::vector<Sample> samples;
  StripAssignment::Assigner sorter(arrangement(), file);
  const auto add = [&](std::uint16_t source, double time, const LidarReturn& point) {
    const int strip = arrangement().labels()[sorter.label(source, time)].index;
    if (strip >= 0) samples.push_back({strip, point});
  };
  const TimeAlignment& align = times_[file];
  if (const LasFile* las = inputs_[file]->las()) {
    samplePoints(*las, size, [&](const PointChunk& chunk) {
      for (std::size_t i = 0; i < chunk.size(); ++i)
        add(chunk.point_source_id[i], chunk.gps_time[i], chunk.point(i, align(chunk.gps_time[i])));
    });
    return samples;
  }
  const Strip<PointLidar>& strip = *inputs_[file]->strip();
  // Runs of consecutive points, which hold all returns of their pulses.
  const std::size_t every =
      size.points_per_run * std::max<std::size_t>(1, strip.cloud->size() / size.points());
  for (std::size_t run = 0; run < strip.cloud->size(); run += every) {
    const std::size_t end = std::min(strip.cloud->size(), run + size.points_per_run);
    for (std::size_t i = run; i < end; ++i) {
      const PointLidar& point = (*strip.cloud)[i];
      add(point.point_source_id, secondsOfTime(point.gps_time),
          detail::returnOf(strip, i, align(point.gps_time)));
    }
  }
  return samples;
}

/// Ranges from a trajectory of another flight, or in other units, are numbers without meaning.
void IntensityRun::checkTrajectory() {
  std::vector<std::vector<Sample>> samples(files());
  doTogether(settings_.processes, [&] {
    for (const std::size_t file : shares_.ownItems()) samples[file] = samplesOf(file);
  });
  shareVectors(settings_.processes, shares_, samples);
  // Positions alone enter the intensities.
  TrajectoryPlausibility check(trajectory_, TrajectoryPlausibility::Attitude::not_used);
  for (const std::string& strip : strips()) check.addStrip(strip);
  for (const std::vector<Sample>& of_file : samples) {
    for (const Sample& sample : of_file) {
      check.add(sample.strip, sample.point.time, sample.point.position, sample.point.scan_angle);
      check.addTime(sample.strip, sample.point.time);
      check.addReturn(sample.strip, sample.point);
    }
  }
  warnings_ = check.check(settings_.force);
}

std::vector<std::pair<int, double>> IntensityRun::radiiOf(std::size_t file) const {
  std::vector<std::pair<int, double>> radii;
  const std::size_t windows = inputs_[file]->windows();
  const std::size_t probes = std::min(windows, kProbes);
  for (std::size_t probe = 0; probe < probes; ++probe) {
    IntensityWindow window;
    WindowRequest request;
    request.arrangement = &arrangement();
    request.file = file;
    inputs_[file]->load(probe * windows / probes, request, window);
    std::size_t cursor = 0;
    for (const auto& [strip, points] : window.surface_points) {
      double radius = LocalSurfaces::radiusFor(points);
      const auto first = std::find_if(window.points.begin(), window.points.end(),
                                      [&, wanted = strip](const IntensityPoint& p) {
                                        return arrangement().labels()[p.label].index == wanted;
                                      });
      SensorPose pose;
      if (trajectory_->poseAt(times_[file](first->time), pose, cursor)) {
        const double range = (pose.position - first->position).norm();
        radius = std::max(radius, 0.5e-3 * settings_.footprint_mrad * range);
      }
      radii.emplace_back(strip, radius);
    }
  }
  return radii;
}

/// The radius of each strip's surfaces: from the spacing of its points in some windows, and at
/// least half the footprint.
void IntensityRun::chooseRadii() {
  std::vector<std::vector<std::pair<int, double>>> of_files(files());
  doTogether(settings_.processes, [&] {
    if (!settings_.find_surfaces) return;
    for (const std::size_t file : shares_.ownItems()) of_files[file] = radiiOf(file);
  });
  shareVectors(settings_.processes, shares_, of_files);
  std::vector<std::vector<double>> found(strips().size());
  for (const auto& radii : of_files)
    for (const auto& [strip, radius] : radii)
      found[static_cast<std::size_t>(strip)].push_back(radius);
  for (std::vector<double>& radii : found) {
    double radius = radii.empty() ? 2.0 : medianInPlace(radii);
    if (settings_.surfaces.radius > 0.0) radius = settings_.surfaces.radius;
    radii_.push_back(radius);
  }
}

}  // namespace pcl_als
