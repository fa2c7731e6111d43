// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/intensity_output.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/survey/coverage_limit.h>

#include "correction_record.h"
#include "intensity_columns.h"

namespace pcl_als {
namespace {

constexpr const char* kOriginal = "original_intensity";
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The values of one point that are written.
struct CorrectedPoint {
  double intensity = 0.0;  ///< not scaled for the 16-bit field
  double reflectance = kNothing, range = kNothing, incidence = kNothing;  ///< m, degrees
};

CorrectedPoint correctedPoint(const IntensityRun& run, const EvaluatedWindow& found,
                              std::size_t i) {
  const auto given = static_cast<double>(found.window.points[i].intensity);
  const PointRadiometry& radiometry = found.radiometry[i];
  CorrectedPoint point;
  point.intensity = given;
  if (!radiometry.corrected()) return point;
  const double gain = run.estimatedGains()[static_cast<std::size_t>(found.strip[i])];
  point.intensity = given * radiometry.factor / (found.divisor[i] * gain);
  if (run.constant() > 0.0) point.reflectance = point.intensity / run.constant();
  point.range = static_cast<double>(radiometry.range);
  point.incidence = static_cast<double>(radiometry.incidence) / kRadiansPerDegree;
  return point;
}

/// Counts and statistics of a block of points.
struct BlockOutcome {
  explicit BlockOutcome(const IntensityRun& run) : statistics(run.strips().size()) {
    counts.labels.resize(run.arrangement().labels().size());
  }
  IntensityCounts counts;
  IntensityStatistics statistics;
};

void countPoint(const IntensityRun& run, const EvaluatedWindow& found, std::size_t i,
                const CorrectedPoint& point, double stored, BlockOutcome& out) {
  const IntensityPoint& given = found.window.points[i];
  ++out.counts.points;
  ++out.counts.labels[given.label];
  const RadiometryStatus status = found.radiometry[i].status;
  if (found.strip[i] < 0)
    ++out.counts.excluded;
  else
    ++out.counts.status[static_cast<std::size_t>(status)];
  if (found.strip[i] >= 0 && status == RadiometryStatus::uncovered)
    ++out.counts.uncovered[{given.label, run.whyUncovered(found.file, given.time)}];
  out.counts.zeros += given.intensity == 0.0F ? 1 : 0;
  out.counts.saturated += static_cast<double>(given.intensity) >= run.saturation() ? 1 : 0;
  out.counts.clipped += stored > kLargestIntensity ? 1 : 0;
  out.counts.rounded_to_zero += given.intensity > 0.0F && stored < 0.5 ? 1 : 0;
  if (!run.settings().statistics || !found.radiometry[i].corrected() ||
      !run.usable(given.intensity))
    return;
  double slope = kNothing;
  if (found.surfaces[i].found())
    slope = std::acos(std::clamp(static_cast<double>(found.surfaces[i].normal.z()), 0.0, 1.0)) /
            kRadiansPerDegree;
  out.statistics.add(static_cast<std::size_t>(found.strip[i]), static_cast<double>(given.intensity),
                     point.intensity, slope, given.classification);
}

std::uint16_t rounded(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, kLargestIntensity)));
}

/// Takes in blocks as they come and merges them in their order, so that threads change no sum.
class OrderedOutcome {
 public:
  OrderedOutcome(IntensityOutcome& outcome, IntensityCounts& counts)
      : outcome_(outcome), counts_(counts) {}

  /// Returns the number of points so far.
  std::uint64_t add(std::size_t block, BlockOutcome part) {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.emplace(block, std::move(part));
    while (!waiting_.empty() && waiting_.begin()->first == next_) {
      counts_.merge(waiting_.begin()->second.counts);
      outcome_.statistics.merge(waiting_.begin()->second.statistics);
      waiting_.erase(waiting_.begin());
      ++next_;
    }
    return counts_.points;
  }

  void addHistogram(const EvaluatedWindow& found, const IntensityRun& run,
                    const std::vector<std::uint16_t>& after) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const IntensityPoint& point = found.window.points[i];
      if (outcome_.seen && found.strip[i] >= 0) outcome_.seen(found.strip[i], point.position);
      const float before = point.intensity;
      if (!found.radiometry[i].corrected() || !run.usable(before)) continue;
      IntensityHistogram& histogram = outcome_.histograms[static_cast<std::size_t>(found.strip[i])];
      ++histogram.before[rounded(static_cast<double>(before))];
      ++histogram.after[after[i]];
    }
  }

 private:
  std::mutex mutex_;
  std::map<std::size_t, BlockOutcome> waiting_;
  std::size_t next_ = 0;
  IntensityOutcome& outcome_;
  IntensityCounts& counts_;
};

std::uint64_t countOf(const IntensityCounts& counts, RadiometryStatus status) {
  return counts.status[static_cast<std::size_t>(status)];
}

/// Refuses files that cannot be corrected.
void checkCounts(const std::string& name, const IntensityCounts& counts, bool keep_uncovered) {
  const std::uint64_t uncovered = countOf(counts, RadiometryStatus::uncovered);
  std::ostringstream text;
  text << name << ": ";
  if (!keep_uncovered && !fewUncovered(uncovered, counts.points)) {
    text << "the trajectory does not cover the times of " << uncovered << " of " << counts.points
         << " points";
    throw InputError(text.str(), Hint::keep_uncovered);
  }
  const std::uint64_t above = countOf(counts, RadiometryStatus::above_sensor);
  if (2 * above > counts.points) {
    text << above << " of " << counts.points
         << " points lie above the sensor; do points and trajectory have the same heights?";
    throw InputError(text.str());
  }
}

/// The extra fields of the output, in order; positions by name.
class OutputFields {
 public:
  OutputFields(const IntensityOutput& output, bool reflectance) {
    if (output.keep_original) add(kOriginal, "digital number as received", LasExtraType::u16);
    if (!output.extra_fields) return;
    if (reflectance) add("reflectance", "at normal incidence, 1: white", LasExtraType::f32);
    add("range", "sensor to point, m", LasExtraType::f32);
    add("incidence_angle", "degrees; NaN: no surface", LasExtraType::f32);
  }
  /// A name that the file has already (of something else) is followed by a number.
  void avoid(const LasFile& file) {
    for (LasExtraField& field : fields) {
      const std::string name = field.name;
      for (int n = 2; has(file, field.name); ++n) {
        if (name == kOriginal)
          throw InputError(file.path().string() + ": has a field " + name +
                           ": its intensity was corrected before; give the file it came from, or "
                           "do not keep the original intensity to correct it again");
        field.name = name + '_' + std::to_string(n);
      }
    }
  }
  std::vector<LasExtraField> fields;

 private:
  static bool has(const LasFile& file, const std::string& name) {
    const std::vector<LasExtraField>& there = file.extraFields();
    return std::any_of(there.begin(), there.end(),
                       [&name](const LasExtraField& f) { return f.name == name; });
  }
  void add(const char* name, const char* description, LasExtraType type) {
    LasExtraField field;
    field.name = name;
    field.description = description;
    field.type = type;
    fields.push_back(field);
  }
};

double valueOf(const std::string& field, const CorrectedPoint& point) {
  if (field.rfind("reflectance", 0) == 0) return point.reflectance;
  return field.rfind("range", 0) == 0 ? point.range : point.incidence;
}

/// Positions of the values of a point in its record; -1: not written.
struct FieldPlaces {
  std::ptrdiff_t original = -1, reflectance = -1, range = -1, incidence = -1;

  explicit FieldPlaces(const std::vector<LasExtraField>& fields) {
    for (const LasExtraField& field : fields) {
      const auto at = static_cast<std::ptrdiff_t>(field.position);
      if (field.name == kOriginal)
        original = at;
      else if (field.name.rfind("reflectance", 0) == 0)
        reflectance = at;
      else
        (field.name.rfind("range", 0) == 0 ? range : incidence) = at;
    }
  }
  void store(std::byte* record, const CorrectedPoint& point) const {
    if (original >= 0) storeLas(record + original, LasRecordLayout::intensityOf(record));
    if (reflectance >= 0) storeLas(record + reflectance, static_cast<float>(point.reflectance));
    if (range >= 0) storeLas(record + range, static_cast<float>(point.range));
    if (incidence >= 0) storeLas(record + incidence, static_cast<float>(point.incidence));
  }
};

/// What the run corrects: the terms of the radar equation, gains, both or nothing.
std::string correctedBy(const IntensityRun& run) {
  const IntensitySettings& settings = run.settings();
  const RadiometricModel& model = run.model();
  std::string text;
  if (model.range_exponent != 0.0 || model.incidence_exponent != 0.0 ||
      model.extinction_per_km != 0.0)
    text = "range, incidence, atmosphere";
  const std::vector<double>& estimated = run.estimatedGains();
  const bool gains =
      !settings.gains.empty() || !settings.pulse_rates.empty() || !settings.gain_steps.empty() ||
      std::any_of(estimated.begin(), estimated.end(), [](double gain) { return gain != 1.0; });
  if (gains) text += text.empty() ? "gains" : ", gains";
  if (settings.echo_energy) text += text.empty() ? "echo energy" : ", echo energy";
  return text;
}

/// The record of corrections of the output. InputError where the same was corrected before.
std::string recordOf(const IntensityRun& run, const std::string& before, const std::string& name) {
  AppliedCorrection correction;
  correction.kind = CorrectionKind::intensity;
  correction.values = correctedBy(run);
  if (correction.values.empty()) return before;
  // Gains may follow the terms.
  correction.id = correction.values == "gains" ? "gains" : "terms";
  Warnings ignored;
  return detail::recordWith(before, correction, name, run.settings().force, ignored);
}

LasExtension extensionOf(const IntensityRun& run, std::size_t file,
                         const std::vector<LasExtraField>& fields) {
  const LasFile& las = *run.input(file).las();
  LasExtension extension;
  extension.fields = fields;
  extension.block_records = run.input(file).windowSize();
  extension.keeps_coordinates = true;
  extension.corrections = recordOf(run, las.info().corrections, las.path().string());
  return extension;
}

/// As writeLas(), where no surfaces are needed.
void writeRangeOnly(const IntensityRun& run, std::size_t file, const std::filesystem::path& path,
                    const IntensityOutput& output, const std::function<void(double)>& progress,
                    IntensityOutcome& outcome) {
  IntensityCounts& counts = outcome.counts[file];
  const LasFile& las = *run.input(file).las();
  OutputFields wanted(output, false);
  wanted.avoid(las);
  const FieldPlaces places(placeExtension(las, wanted.fields));
  const RangeOnlyCorrection correction(run, file, output.scale, places.original);
  const std::uint64_t all = las.header().point_count;
  std::mutex mutex;
  const LasEdit edit = [&](const LasRecordBlock& block) {
    const IntensityCounts part = correction.apply(block);
    const std::lock_guard<std::mutex> lock(mutex);
    counts.merge(part);
    progress(static_cast<double>(counts.points) / static_cast<double>(all));
    // With the counts of all points, but before the output gets its name.
    if (counts.points == all)
      checkCounts(las.path().string(), counts, run.settings().keep_uncovered);
  };
  outcome.addRemarks(las.path(), extendLas(las, path, extensionOf(run, file, wanted.fields), edit,
                                           run.settings().threads)
                                     .remarks);
}

void writeLas(const IntensityRun& run, std::size_t file, const std::filesystem::path& path,
              const IntensityOutput& output, const std::function<void(double)>& progress,
              IntensityOutcome& outcome) {
  const LasFile& las = *run.input(file).las();
  IntensityCounts& counts = outcome.counts[file];
  OutputFields wanted(output, run.constant() > 0.0);
  wanted.avoid(las);
  const FieldPlaces places(placeExtension(las, wanted.fields));
  OrderedOutcome ordered(outcome, counts);
  const std::uint64_t all = las.header().point_count;
  const std::size_t per_window = run.input(file).windowSize();
  const LasEdit edit = [&](const LasRecordBlock& block) {
    thread_local EvaluatedWindow found;
    thread_local std::vector<std::uint16_t> stored;
    const std::size_t window = block.first / per_window;
    run.evaluate(file, window, found, {{}, block.records, block.record_length});
    BlockOutcome part(run);
    stored.resize(block.count);
    for (std::size_t i = 0; i < block.count; ++i) {
      std::byte* record = block.records + i * block.record_length;
      const CorrectedPoint point = correctedPoint(run, found, i);
      const double scaled =
          found.radiometry[i].corrected() ? output.scale * point.intensity : point.intensity;
      // With energies of echoes the intensity of the record is another value than the given one.
      stored[i] =
          found.radiometry[i].corrected() ? rounded(scaled) : LasRecordLayout::intensityOf(record);
      places.store(record, point);
      LasRecordLayout::storeIntensity(stored[i], record);
      countPoint(run, found, i, point, scaled, part);
    }
    if (run.settings().statistics) ordered.addHistogram(found, run, stored);
    const std::uint64_t done = ordered.add(window, std::move(part));
    progress(static_cast<double>(done) / static_cast<double>(all));
    // With the counts of all points, but before the output gets its name.
    if (done == all) checkCounts(las.path().string(), counts, run.settings().keep_uncovered);
  };
  outcome.addRemarks(las.path(), extendLas(las, path, extensionOf(run, file, wanted.fields), edit,
                                           run.settings().threads)
                                     .remarks);
}

void writePcd(const IntensityRun& run, std::size_t file, const std::filesystem::path& path,
              const IntensityOutput& output, IntensityOutcome& outcome) {
  const Strip<PointLidar>& strip = *run.input(file).strip();
  Strip<PointLidar> corrected = strip;
  corrected.cloud = pcl::PointCloud<PointLidar>::Ptr(new pcl::PointCloud<PointLidar>(*strip.cloud));
  const OutputFields wanted(output, run.constant() > 0.0);
  std::vector<PcdColumn> columns;
  for (const LasExtraField& field : wanted.fields)
    columns.push_back({field.name, std::vector<float>(strip.cloud->size())});
  EvaluatedWindow found;
  if (run.input(file).windows() > 0) run.evaluate(file, 0, found);
  BlockOutcome part(run);
  std::vector<std::uint16_t> stored(strip.cloud->size());
  for (std::size_t i = 0; i < strip.cloud->size(); ++i) {
    const CorrectedPoint point = correctedPoint(run, found, i);
    const double scaled =
        found.radiometry[i].corrected() ? output.scale * point.intensity : point.intensity;
    (*corrected.cloud)[i].intensity = static_cast<float>(scaled);  // a float: nothing is clipped
    stored[i] = rounded(scaled);
    for (PcdColumn& column : columns)
      column.values[i] = column.name == kOriginal ? (*strip.cloud)[i].intensity
                                                  : static_cast<float>(valueOf(column.name, point));
    countPoint(run, found, i, point, std::clamp(scaled, 0.5, kLargestIntensity), part);
  }
  OrderedOutcome ordered(outcome, outcome.counts[file]);
  if (run.settings().statistics && !stored.empty()) ordered.addHistogram(found, run, stored);
  ordered.add(0, std::move(part));
  checkCounts(run.input(file).path(), outcome.counts[file], run.settings().keep_uncovered);
  corrected.corrections = recordOf(run, strip.corrections, run.input(file).path());
  savePcd(path, corrected, columns);
  outcome.addRemarks(run.input(file).path(), run.input(file).remarks());
}

}  // namespace

void IntensityOutcome::addRemarks(const std::filesystem::path& path,
                                  const std::vector<std::string>& written) {
  for (const std::string& text : written) remarks.push_back(path.string() + ": " + text);
}

void writeCorrected(const IntensityRun& run, std::size_t file, const std::filesystem::path& path,
                    const IntensityOutput& output, const std::function<void(double)>& progress,
                    IntensityOutcome& outcome) {
  outcome.counts.resize(run.files());
  std::error_code absent;
  if (std::filesystem::equivalent(run.input(file).path(), path, absent))
    throw UsageError(path.string() + ": input and output are the same file");
  const bool pcd_out = path.extension() == ".pcd" || path.extension() == ".PCD";
  if (pcd_out != (run.input(file).las() == nullptr))
    throw UsageError(path.string() + ": input and output must be of one kind, .las/.laz or .pcd");
  if (pcd_out)
    writePcd(run, file, path, output, outcome);
  else if (RangeOnlyCorrection::serves(run.settings(), output) && run.allChosen(file))
    writeRangeOnly(run, file, path, output, progress, outcome);
  else
    writeLas(run, file, path, output, progress, outcome);
}

}  // namespace pcl_als
