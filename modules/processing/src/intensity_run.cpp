// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/radiometry/radiometric_cells.h>
#include <pcl_als/survey/strip_assignment.h>
#include <pcl_als/survey/survey_messages.h>

namespace pcl_als {
namespace {

constexpr double kPointsPerCell = 6.0;  ///< of the sparsest strip
constexpr double kCellShare = 0.7;      ///< of the strips' area that their boxes hold, roughly

}  // namespace

IntensityRun::IntensityRun(const std::vector<std::string>& paths,
                           std::shared_ptr<const Trajectory> trajectory,
                           const IntensitySettings& settings)
    : settings_(settings), trajectory_(std::move(trajectory)), model_(settings.model) {
  model_.check();
  settings_.surfaces.check();
  openFiles(paths);
  alignTimes();
  arrangeStrips(paths);
  checkTrajectory();
  warnOfLines();
  chooseRadii();
  chooseCells();
}

void IntensityRun::openFiles(const std::vector<std::string>& paths) {
  double largest = 0.0;
  std::vector<double> costs;
  for (const std::string& path : paths) costs.push_back(detail::readingCost(path));
  shares_ = SharedItems(settings_.processes, costs);
  shareInputs(paths);
  for (std::size_t file = 0; file < paths.size(); ++file) {
    const std::string& path = paths[file];
    const IntensitySurvey& survey = inputs_[file]->survey();
    if (!survey.sources.sources.empty() && survey.largest == 0.0)
      throw InputError(path + ": all intensities are zero; there is nothing to correct");
    largest = std::max(largest, survey.largest);
  }
  saturation_ = settings_.saturation > 0.0 ? settings_.saturation
                : settings_.echo_energy    ? std::numeric_limits<double>::infinity()
                : largest <= 255.0         ? 255.0
                                           : 65535.0;
  if (settings_.echo_energy)
    remarks_.push_back(
        "intensities are the energies of echoes: amplitude times echo_width, counts ns");
}

void IntensityRun::arrangeStrips(const std::vector<std::string>& paths) {
  StripChoice choice = settings_.strips;
  choice.keep_timeless = true;  // they are counted among the points without a trajectory
  std::vector<SurveyInput> inputs;
  std::vector<SurveyedFile> surveyed;
  for (const std::string& path : paths) inputs.push_back(SurveyInput::ofFile(path));
  for (const auto& input : inputs_) surveyed.push_back(withoutTracks(input->survey().sources));
  if (choice.split) surveyed = surveyFiles(inputs, settings_.threads, settings_.processes);
  survey_.emplace(SurveyReader::ofSurveyed(std::move(surveyed), choice,
                                           FlownTimes{trajectory_.get(), times_, false},
                                           settings_.threads));
  if (strips().empty()) throw InputError("no strip is left: all are excluded or have no times");
  for (const auto* given : {&settings_.gains, &settings_.pulse_rates}) {
    for (const auto& [name, value] : *given) {
      if (std::find(strips().begin(), strips().end(), name) == strips().end())
        throw UsageError(std::string(given == &settings_.gains ? "gains" : "pulse rates") +
                         ": there is no strip " + name);
    }
  }
  for (const std::string& strip : strips()) known_gains_.push_back(knownGain(strip));
  estimated_gains_.assign(strips().size(), 1.0);
}

void IntensityRun::warnOfLines() {
  StripChoice choice = settings_.strips;
  if (choice.split) return;
  choice.divide_lines = choice.keep_timeless = true;
  std::vector<SurveyedFile> sampled;
  for (const auto& input : inputs_)
    sampled.push_back({input->survey().sources, input->survey().tracks, {}, {}});
  const StripAssignment lines(sampled, choice, {trajectory_.get(), times_, false});
  const std::size_t divided = lines.divisions().size();
  if (divided == 0) return;
  warnings_.push_back((divided == 1 ? "a strip holds" : counted(divided, "strip") + " hold") +
                      " several flight lines, which lead back and forth: their surfaces and "
                      "intensities are those of one line unless strips are split into lines");
}

bool IntensityRun::allChosen(std::size_t file) const {
  if (settings_.strips.split) return false;
  const std::vector<PointSource>& ids = sources(file).sources;
  return std::all_of(ids.begin(), ids.end(), [&](const PointSource& source) {
    return !arrangement().stripsOf(file, source.id).empty();
  });
}

/// Given gain, times the energy of a pulse against the mean of the strips' (constant power).
double IntensityRun::knownGain(const std::string& strip) const {
  double gain = 1.0;
  const auto given = settings_.gains.find(strip);
  if (given != settings_.gains.end()) gain = given->second;
  if (settings_.pulse_rates.empty()) return gain;
  const auto rate = settings_.pulse_rates.find(strip);
  if (rate == settings_.pulse_rates.end())
    throw UsageError("pulse rates: strip " + strip + " has none; give all or none");
  double logs = 0.0;
  for (const auto& [name, hertz] : settings_.pulse_rates) logs += std::log(hertz);
  const double mean = std::exp(logs / static_cast<double>(settings_.pulse_rates.size()));
  return gain * mean / rate->second;
}

void IntensityRun::alignTimes() {
  const TimeRange flight{trajectory_->startTime(), trajectory_->endTime()};
  std::string objection;
  std::size_t met = 0;
  for (const auto& input : inputs_) {
    TimeAlignment& alignment = times_.emplace_back();
    const IntensitySurvey& survey = input->survey();
    if (survey.sources.sources.empty()) continue;
    try {
      alignment = reconcileTimes(survey.sources.info, {survey.first_time, survey.last_time}, flight,
                                 settings_.gps_week);
      ++met;
    } catch (const InputError& error) {
      if (objection.empty()) objection = error.what();
    }
    if (!alignment.remark.empty()) remarks_.push_back(alignment.remark);
  }
  if (objection.empty()) return;
  if (met == 0 || !settings_.keep_uncovered) throw InputError(objection);
  remarks_.push_back(objection + ": left as it is");
}

/// Cells contain some points of the sparsest strip; a share of the cells is excluded to bound
/// memory.
void IntensityRun::chooseCells() {
  const double widest = radii_.empty() ? 2.0 : *std::max_element(radii_.begin(), radii_.end());
  const double sparsest = 16.0 / (kPi * widest * widest);
  cell_size_ = settings_.cell;
  if (cell_size_ == 0.0) cell_size_ = std::clamp(std::sqrt(kPointsPerCell / sparsest), 0.5, 20.0);
  double area = 0.0;
  for (const auto& input : inputs_) {
    for (const PointSource& source : input->survey().sources.sources) {
      const Eigen::Vector3d size = source.maximum - source.minimum;
      area += kCellShare * size.x() * size.y();
    }
  }
  const double cells = area / (cell_size_ * cell_size_);
  const auto most = static_cast<double>(settings_.most_cells);
  one_cell_in_ = static_cast<std::uint32_t>(std::clamp(std::ceil(cells / most), 1.0, 1e9));
}

double IntensityRun::gainControl(double value, const std::string& path) const {
  const std::vector<GainStep>& steps = settings_.gain_steps;
  if (!(value >= steps.front().value && value <= steps.back().value)) {
    throw InputError(path + ": a gain control value of " + std::to_string(value) +
                     " lies outside the table of gains (" + std::to_string(steps.front().value) +
                     " to " + std::to_string(steps.back().value) + ")");
  }
  const auto above =
      std::lower_bound(steps.begin(), steps.end(), value,
                       [](const GainStep& step, double v) { return step.value < v; });
  if (above->value == value) return above->gain;
  const GainStep& below = *(above - 1);
  const double t = (value - below.value) / (above->value - below.value);
  return below.gain + t * (above->gain - below.gain);
}

std::map<int, LocalSurfaces> IntensityRun::surfacesOf(const IntensityWindow& window) const {
  std::map<int, LocalSurfaces> surfaces;
  for (const auto& [strip, neighbours] : window.surface_points) {
    LocalSurfaceSettings settings = settings_.surfaces;
    settings.radius = radius(strip);
    surfaces.emplace(strip, LocalSurfaces(neighbours, settings));
  }
  return surfaces;
}

/// A window with what surfaces need around it.
WindowRequest IntensityRun::requestFor(std::size_t file) const {
  WindowRequest request;
  request.arrangement = &arrangement();
  request.file = file;
  request.surfaces = settings_.find_surfaces;
  if (!request.surfaces) return request;
  for (const PointSource& source : sources(file).sources) {
    for (const int strip : arrangement().stripsOf(file, source.id))
      request.margins[source.id] = std::max(request.margins[source.id], radius(strip));
  }
  return request;
}

void IntensityRun::evaluate(std::size_t file, std::size_t window, EvaluatedWindow& out,
                            const WindowChoice& choice) const {
  WindowRequest request = requestFor(file);
  request.records = choice.records;
  request.record_length = choice.record_length;
  inputs_[file]->load(window, request, out.window);
  out.file = file;
  const std::vector<IntensityPoint>& points = out.window.points;
  const std::map<int, LocalSurfaces> surfaces = surfacesOf(out.window);
  const RadiometricEvaluator evaluator(trajectory_, model_);
  const TimeAlignment& times = times_[file];
  out.radiometry.resize(points.size());
  out.surfaces.assign(request.surfaces ? points.size() : 0, LocalSurface());
  out.strip.resize(points.size());
  out.divisor.resize(points.size());
  RadiometryCursor cursor;
  const LocalSurface none;
  const LocalSurfaces* of_strip = nullptr;
  int strip = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const IntensityPoint& point = points[i];
    LidarReturn aligned = point;
    aligned.time = times(point.time);
    if (i == 0 || points[i - 1].label != point.label) {
      strip = arrangement().labels()[point.label].index;
      const auto at = surfaces.find(strip);
      of_strip = at == surfaces.end() ? nullptr : &at->second;
    }
    out.strip[i] = strip;
    out.divisor[i] = 1.0;
    out.radiometry[i] = PointRadiometry();
    if (strip < 0) continue;
    out.divisor[i] = known_gains_[static_cast<std::size_t>(strip)];
    if (choice.wanted && !choice.wanted(point.position.x(), point.position.y())) continue;
    const bool on_surface = of_strip != nullptr && point.isLast();
    if (on_surface) out.surfaces[i] = of_strip->at(out.window.relative(point.position));
    out.radiometry[i] = evaluator.evaluate(aligned, on_surface ? out.surfaces[i] : none, cursor);
    if (!out.window.gain_control.empty())
      out.divisor[i] *= gainControl(out.window.gain_control[i], inputs_[file]->path());
  }
}

RadiometricCells IntensityRun::cellsOf(std::size_t file,
                                       const std::function<void(double)>& progress) const {
  RadiometricCells cells(cell_size_, one_cell_in_);
  // Windows are merged in their order, a few at a time: threads change no sum.
  const std::size_t at_once = 2 * threadCount(settings_.threads),
                    windows = inputs_[file]->windows();
  for (std::size_t first = 0; first < windows; first += at_once) {
    const std::size_t count = std::min(at_once, windows - first);
    std::vector<RadiometricCells> parts(count, RadiometricCells(cell_size_, one_cell_in_));
    parallelFor(count, settings_.threads, [&](std::size_t part) {
      EvaluatedWindow found;
      WindowChoice choice;
      choice.wanted = [&](double x, double y) { return parts[part].wants(x, y); };
      evaluate(file, first + part, found, choice);
      for (std::size_t i = 0; i < found.window.points.size(); ++i) {
        const IntensityPoint& point = found.window.points[i];
        if (found.strip[i] < 0) continue;
        const Eigen::Vector3d& place = point.position;
        parts[part].add(found.strip[i], place.x(), place.y(),
                        static_cast<double>(point.intensity) / found.divisor[i],
                        usable(point.intensity) && point.isSingle(), found.radiometry[i],
                        found.surfaces[i]);
      }
    });
    for (const RadiometricCells& part : parts) cells.merge(part);
    progress(static_cast<double>(first + count) / static_cast<double>(windows));
  }
  return cells;
}

OverlapResult IntensityRun::adjust(const std::function<void(double)>& progress) {
  std::vector<RadiometricCells> of_files(files(), RadiometricCells(cell_size_, one_cell_in_));
  const std::vector<std::size_t>& own = shares_.ownItems();
  doTogether(settings_.processes, [&] {
    for (std::size_t i = 0; i < own.size(); ++i) {
      of_files[own[i]] = cellsOf(own[i], [&](double part) {
        progress((static_cast<double>(i) + part) / static_cast<double>(own.size()));
      });
    }
  });
  shareValues(
      settings_.processes, shares_, of_files,
      [](ByteWriter& out, const RadiometricCells& cells) { cells.put(out); },
      [](ByteReader& in, RadiometricCells& cells) { cells.get(in); });
  RadiometricCells cells(cell_size_, one_cell_in_);
  for (const RadiometricCells& part : of_files) cells.merge(part);
  OverlapResult overlaps =
      adjustOverlaps(cells.shared(), cell_size_, strips(), model_, settings_.overlaps);
  model_ = overlaps.model;
  estimated_gains_ = overlaps.gainFactors();
  return overlaps;
}

std::vector<Eigen::Vector3d> IntensityRun::targetPoints(
    std::size_t file, const ReferenceCalibration& calibration) const {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t window = 0; window < inputs_[file]->windows(); ++window) {
    EvaluatedWindow found;
    WindowChoice choice;
    choice.wanted = [&](double x, double y) { return calibration.touches(x, y, x, y); };
    evaluate(file, window, found, choice);
    for (std::size_t i = 0; i < found.window.points.size(); ++i) {
      const IntensityPoint& point = found.window.points[i];
      if (found.radiometry[i].status != RadiometryStatus::surface || !usable(point.intensity) ||
          !point.isSingle())
        continue;
      const Eigen::Vector3d& place = point.position;
      const double divisor =
          found.divisor[i] * estimated_gains_[static_cast<std::size_t>(found.strip[i])];
      points.emplace_back(
          place.x(), place.y(),
          static_cast<double>(point.intensity) * found.radiometry[i].factor / divisor);
    }
  }
  return points;
}

ReferenceResult IntensityRun::refer(std::vector<ReferenceTarget> targets, double radius) {
  ReferenceCalibration calibration(std::move(targets), radius);
  std::vector<std::vector<Eigen::Vector3d>> points(files());
  doTogether(settings_.processes, [&] {
    for (const std::size_t file : shares_.ownItems())
      points[file] = targetPoints(file, calibration);
  });
  shareVectors(settings_.processes, shares_, points);
  for (const std::vector<Eigen::Vector3d>& of_file : points)
    for (const Eigen::Vector3d& point : of_file) calibration.add(point.x(), point.y(), point.z());
  ReferenceResult reference = calibration.solve();
  constant_ = reference.constant;
  return reference;
}

}  // namespace pcl_als
