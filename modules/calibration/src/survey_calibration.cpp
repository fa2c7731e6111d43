// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/measured_box.h>
#include <pcl_als/io/new_las_file.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/survey/offset_from_block.h>
#include <pcl_als/survey/strip_assignment.h>

#include "block_advice.h"
#include "block_calibration.h"

namespace pcl_als {
namespace {

using StripNames = std::vector<std::pair<std::string, std::string>>;

/// The label of a strip that has no usable points; null for a strip in use and for unknown names,
/// which the calibration lists.
const StripAssignment::Label* labelOfMissing(const SurveyReader& survey, const std::string& name) {
  const std::vector<std::string>& strips = survey.strips();
  if (std::find(strips.begin(), strips.end(), name) != strips.end()) return nullptr;
  for (const StripAssignment::Label& label : survey.arrangement().labels()) {
    if (label.strip == name) return &label;
  }
  return nullptr;
}

/// Without the pairs of strips that have no usable points; those are named in \a warnings.
StripNames usablePairs(const StripNames& pairs, const SurveyReader& survey, Warnings& warnings) {
  StripNames usable;
  for (const auto& [a, b] : pairs) {
    const StripAssignment::Label* label = labelOfMissing(survey, a);
    if (label == nullptr) label = labelOfMissing(survey, b);
    if (label == nullptr) {
      usable.emplace_back(a, b);
      continue;
    }
    if (label->reason == ExclusionReason::excluded)
      throw UsageError("pairs: strip '" + label->strip + "' is not among the strips in use",
                       Hint::strips);
    warnings.push_back("pair " + a + ":" + b + " is excluded with strip " + label->strip);
  }
  if (usable.empty() && !pairs.empty())
    throw InputError("pairs: no pair is left; " + warnings.back().text);
  return usable;
}

std::string excludedText(const std::vector<ExcludedPoints>& parts) {
  std::string text;
  for (const std::string& part : describe(parts)) text += "; " + part;
  return text;
}

/// Reference surfaces, whose indices follow those of the strips, and the part of them that is used.
struct References {
  const std::vector<ReferenceSource>& sources;
  int first = 0;
  Eigen::AlignedBox2d box;

  References(const SurveyReader& survey, const std::vector<ReferenceSource>& given)
      : sources(given), first(static_cast<int>(survey.strips().size())), box(survey.extent()) {
    constexpr double kMargin = 20.0;  // metres: more than areas have
    box.min().array() -= kMargin;
    box.max().array() += kMargin;
  }

  template <typename Use>
  void read(const Use& use) const {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      sources[i].read(box, [&](const LidarReturn* points, std::size_t count) {
        use(first + static_cast<int>(i), points, count);
      });
    }
  }
};

OffsetFromBlock placeOf(const SurveyReader& survey, const PointFileInfo& reference) {
  return {{reference.minimum.head<2>().eval(), reference.maximum.head<2>().eval()},
          survey.extent()};
}

/// Refuses a reference that its coordinates put elsewhere, whatever CRS it states. Its header is
/// believed where it puts the reference into the block.
void requirePlace(const SurveyReader& survey, const PointFileInfo& reference) {
  if (reference.point_count == 0 || placeOf(survey, reference).distance == 0.0) return;
  const std::string extension = lowerExtension(reference.path);
  const bool has_header = extension == ".las" || extension == ".laz";
  const OffsetFromBlock place =
      placeOf(survey, has_header ? measureBox(reference.path).info : reference);
  if (place.distance == 0.0) return;
  throw InputError(reference.path.string() + ": lies " + place.text() +
                   ": give a reference surface of this block, in its coordinate reference system");
}

/// Refuses references in another CRS than the survey; returns what is assumed of their units.
std::vector<std::string> checkReferences(const SurveyReader& survey,
                                         const std::vector<ReferenceSource>& references) {
  std::vector<PointFileInfo> files, alone;
  for (const SurveyedFile& file : survey.files()) files.push_back(file.sources.info);
  for (const ReferenceSource& reference : references) {
    files.push_back(reference.info);
    alone.push_back(reference.info);
  }
  commonReference(files);
  for (const PointFileInfo& reference : alone) requirePlace(survey, reference);
  return commonReference(alone).remarks;
}

struct IndexedBlock {
  SurveyBlock block;
  std::vector<ExcludedPoints> excluded;  ///< by the reader
};

/// First pass over all points.
IndexedBlock indexed(const SurveyReader& survey, const std::shared_ptr<const Trajectory>& flight,
                     const BlockRequest& request, const References& references,
                     const SurveyObserver& observer) {
  BlockIndex index(flight, survey.corner());
  for (const std::string& id : survey.strips()) index.addStrip(id);
  for (const ReferenceSource& reference : references.sources) index.addReference(reference.surface);
  if (observer.begin) observer.begin(survey);
  const auto add = [&](int strip, const LidarReturn* points, std::size_t count) {
    index.add(strip, points, count);
  };
  // An observer receives all points in the first process, which reads its own strips only.
  const bool apart = areShared(survey.processes());
  const auto pass = [&](int strip, const LidarReturn* points, std::size_t count) {
    add(strip, points, count);
    if (observer.points && !apart) observer.points(strip, points, count);
  };
  std::vector<ExcludedPoints> excluded = survey.read(SurveyReader::asReturns(pass));
  references.read(add);
  using Reading = SurveyReader::Reading;
  if (observer.points && apart)
    survey.read(SurveyReader::asReturns(observer.points), Reading::by(Reading::Share::first));
  shareIndex(survey.processes(), survey.stripShares(), index);
  try {
    return {chooseAreas(std::move(index), request), excluded};
  } catch (const InputError& error) {
    throw InputError(error.what() + excludedText(excluded), error.hint());
  }
}

/// Second pass over all points.
void loadAreas(const SurveyReader& survey, const References& references, bool use_range_std,
               AreaSample& sample) {
  SurveyReader::Reading reading;
  if (use_range_std) reading.extra_field = "range_std";
  survey.read(
      [&](const SurveyReader::Run& run) {
        thread_local std::vector<LidarReturn> points;
        run.points(points);
        const std::vector<double>& stds = run.chunk.extra;
        sample.add(run.strip, points.data(), points.size(),
                   stds.empty() ? nullptr : &stds[run.from]);
      },
      reading);
  references.read([&](int strip, const LidarReturn* points, std::size_t count) {
    sample.add(strip, points, count);
  });
  sample.distribute(survey.processes(), survey.stripShares());
}

BlockCalibration adjusted(AreaSample& sample, ProgressReport& progress) {
  progress.begin("Adjusting");
  int iteration = 0;
  BlockCalibration calibration = calibrate(sample, [&](const CalibrationIteration& last) {
    progress.remark("iteration " + std::to_string(++iteration) + ": " +
                    grouped(last.correspondences) + " pairs, sigma0 " +
                    std::to_string(last.sigma0) + ", largest update " +
                    std::to_string(1000.0 * last.largest_update) + " mm");
  });
  calibration.result.observability = describeObservability(sample.block(), calibration);
  progress.end(calibration.result.converged ? "converged" : "not converged");
  return calibration;
}

SurveyCalibration calibrateBlock(const SurveyReader& survey,
                                 const std::shared_ptr<const Trajectory>& flight,
                                 const CalibrationOptions& options, const BlockRequest& request,
                                 ProgressReport& progress) {
  const References references(survey, options.references);
  progress.begin("Surveying the block");
  const auto [block, excluded] = indexed(survey, flight, request, references, options.observer);
  progress.end(counted(block.pairs.size(), "overlapping pair") + ", " +
               counted(block.areas.size(), "area"));
  for (const std::string& text : block.flight.remarks) progress.remark(text);
  progress.begin("Reading the areas");
  AreaSample sample(block);
  loadAreas(survey, references, options.use_range_std, sample);
  progress.end(grouped(sample.pointCount()) + " points");
  if (sample.pointsWithRangeStd() > 0)
    progress.remark("a priori standard deviations of ranges: range_std of the echoes of " +
                    grouped(sample.pointsWithRangeStd()) +
                    " points, in addition to the common range noise");
  BlockCalibration calibration = adjusted(sample, progress);
  CalibrationResult& result = calibration.result;
  result.excluded.insert(result.excluded.end(), excluded.begin(), excluded.end());
  for (const ExcludedPoints& part : excluded) result.warnings.push_back(describe(part));
  return {std::move(result), block.areas, std::move(calibration.information),
          block.flight.trajectory};
}

/// The errors of a strip's trajectory are those of the whole flight solution: what its accuracy
/// says of single times holds for their sum of constant, smooth and random components.
std::string setPriors(const CalibrationOptions& options, const SurveyReader& survey,
                      SharedErrorModel& errors) {
  if (options.accuracy.empty()) return {};
  AccuracySummary summary = summarize(options.accuracy, survey.observedTimes());
  if (summary.records == 0) {
    char times[160];
    std::snprintf(times, sizeof times,
                  "accuracies of the trajectory: their times, %.3f to %.3f s, are not those of the "
                  "strips; give those of this flight",
                  options.accuracy.front().time, options.accuracy.back().time);
    throw InputError(times);
  }
  const auto set = [](bool keep, double& known, double& prior) {
    if (keep || !(known > 0.0)) known = TrajectoryAccuracy::kUnknown;
    if (std::isfinite(known)) prior = known;
  };
  set(options.keep_position, summary.position, errors.position);
  set(options.keep_roll_pitch, summary.roll_pitch, errors.roll_pitch);
  set(options.keep_heading, summary.heading, errors.heading);
  return "a priori standard deviations of trajectory errors, from its accuracies over the "
         "strips: " +
         describe(summary);
}

/// Adds to large corrections that the trajectory states a low accuracy there, first of the causes.
void addStatedAccuracy(const CalibrationOptions& options, const SurveyReader& survey,
                       std::vector<LargeCorrection>& corrections) {
  constexpr double kLow = 2.0;  // times the root mean square over the strips
  if (options.accuracy.empty()) return;
  const AccuracySummary usual = summarize(options.accuracy, survey.observedTimes());
  for (LargeCorrection& correction : corrections) {
    const TrajectoryAccuracy at = accuracyAt(options.accuracy, correction.time);
    const std::array<double, kTrajectoryAxes.size()> stated{at.position.x(), at.position.y(),
                                                            at.position.z(), at.angles.y(),
                                                            at.angles.x(),   at.angles.z()},
        mean{usual.position,   usual.position,   usual.position,
             usual.roll_pitch, usual.roll_pitch, usual.heading};
    const double here = stated[correction.axis], ratio = here / mean[correction.axis];
    if (!(ratio > kLow)) continue;
    const TrajectoryAxis& axis = correction.axisInfo();
    char text[160];
    std::snprintf(text, sizeof text,
                  "the trajectory states a standard deviation of %.3g %s there, %.1f times that "
                  "over the strips",
                  here / axis.internal_per_unit, std::string(axis.unit).c_str(), ratio);
    correction.causes.insert(correction.causes.begin(), {"stated_accuracy", text});
  }
}

/// The standard deviation of the heights of a reconstructed path during the strips. The errors of
/// the points are not those of the path: they are those of the trajectory that the points were
/// computed with.
double heightStd(const std::vector<TrajectoryAccuracy>& accuracy, const SurveyReader& survey) {
  const std::vector<TimeRange> observed = survey.observedTimes();
  double squares = 0.0, count = 0.0;
  for (const TrajectoryAccuracy& at : accuracy) {
    const bool used = std::any_of(observed.begin(), observed.end(), [&](const TimeRange& range) {
      return at.time >= range.first && at.time <= range.last;
    });
    if (!used || !std::isfinite(at.position.z())) continue;
    squares += at.position.z() * at.position.z();
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// Day of the first point, days since 1980-01-06, where the times or \a week tell it.
std::optional<long> dayOf(const PointFileSources& file, std::optional<int> week) {
  constexpr double kSecondsPerDay = 86400.0;
  TimeRange times;
  for (const PointSource& source : file.sources)
    if (source.hasTimes()) times.add(source.first_time);
  if (times.empty()) return {};
  // Many files state adjusted standard times and hold seconds of the week.
  const bool is_absolute = file.info.time_kind == TimeKind::adjusted_standard &&
                           probableTimeKind(times.first, times.last) == file.info.time_kind;
  if (!is_absolute && !week) return {};
  const double origin = is_absolute ? kAdjustedOffset : kSecondsPerWeek * *week;
  const double day = std::floor((times.first + origin) / kSecondsPerDay);
  constexpr double kLastDay = 80000.0;  // in the year 2199: later times are errors
  if (!(day >= 0.0 && day < kLastDay)) return {};
  return static_cast<long>(day);
}

/// What the files are and state of themselves.
void describeInputs(const SurveyReader& survey, const CalibrationOptions& options,
                    CalibrationResult& result) {
  bool corrected = false, one_system = true;
  std::string system;
  for (const SurveyedFile& file : survey.files()) {
    const PointFileInfo& info = file.sources.info;
    if (!file.sources.damage.empty()) result.warnings.push_back(file.sources.damage);
    result.inputs.push_back(info.path.string());
    if (result.crs.empty()) result.crs = info.crs;
    if (system.empty()) system = info.system;
    one_system = one_system && (info.system.empty() || info.system == system);
    const std::optional<long> day = dayOf(file.sources, options.gps_week);
    if (day && (!result.day || *day < *result.day)) result.day = day;
    corrected = corrected || !info.corrections.empty();
  }
  if (!options.system_name.empty())
    result.system_name = options.system_name;
  else if (one_system)
    result.system_name = system;
  if (corrected)
    result.warnings.emplace_back(
        "points were corrected before the calibration: its biases are those that remain in the "
        "corrected files, and do not belong to the files as delivered");
  for (const ReferenceSource& reference : options.references)
    result.inputs.push_back(reference.info.path.string());
  if (!options.settings.systems.empty() || !options.settings.fixed.empty())
    result.channel_field = survey.channelField();
}

}  // namespace

SurveyCalibration calibrateSurvey(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& flight,
                                  const CalibrationOptions& options,
                                  const ProgressCallback& callback) {
  if (!flight) throw UsageError("calibration: no trajectory is given");
  if (areShared(survey.processes()) &&
      !(options.references.empty() && options.settings.fixed.empty()))
    throw UsageError("fixed strips and reference surfaces need a calibration in one process");
  const UnchangedInputs unchanged;
  ProgressReport progress(sharedProgress(survey.processes(), callback));
  const ReadingProgress reading(survey, progress);
  StripChoice strips = options.strips;
  strips.divide_lines = true;
  for (const std::string& text : survey.choose(strips, {flight.get(), options.gps_week, true})) {
    progress.remark(text);
  }
  CalibrationSettings settings = options.settings;
  settings.resolution = survey.resolution();
  if (options.reconstructed)
    settings.reconstructed_height_std = heightStd(options.path_accuracy, survey);
  progress.remark(setPriors(options, survey, settings.shared_errors));
  Warnings warnings;
  const BlockRequest request{settings, options.control,
                             usablePairs(options.pairs, survey, warnings)};
  for (const std::string& text : checkReferences(survey, options.references)) progress.remark(text);
  SurveyCalibration made = calibrateBlock(survey, flight, options, request, progress);
  made.result.warnings.insert(made.result.warnings.end(), warnings.begin(), warnings.end());
  addStatedAccuracy(options, survey, made.result.large_corrections);
  describeInputs(survey, options, made.result);
  return made;
}

}  // namespace pcl_als
