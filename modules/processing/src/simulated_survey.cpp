// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/simulated_images.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/simulation/radiometry.h>

namespace pcl_als {
namespace {

using simulation::SimulationOptions;
using simulation::Simulator;

/// printf of numbers into a line of a text file.
template <typename... Values>
void appendLine(std::string& text, const char* format, Values... values) {
  char line[256];
  const int length = std::snprintf(line, sizeof line, format, values...);
  text.append(line, static_cast<std::size_t>(length));
}

std::string trajectoryText(const std::vector<TrajectorySample>& samples) {
  std::string text = "time,x,y,z,roll,pitch,heading\n";
  for (const TrajectorySample& s : samples)
    appendLine(text, "%.6f,%.5f,%.5f,%.5f,%.8f,%.8f,%.8f\n", s.time, s.position.x(), s.position.y(),
               s.position.z(), s.roll / kRadiansPerDegree, s.pitch / kRadiansPerDegree,
               s.heading / kRadiansPerDegree);
  return text;
}

/// Columns only where there is something to state.
std::string controlText(const std::vector<ControlPoint>& points, const SimulationOptions& options) {
  const bool with_sigma = options.noise.control > 0.0, with_targets = options.targets > 0;
  std::string text = "id,x,y,z";
  if (with_sigma) text += ",sigma";
  if (with_targets) text += ",diameter";
  text += '\n';
  for (const ControlPoint& p : points) {
    appendLine(text, "%s,%.4f,%.4f,%.4f", p.id.c_str(), p.position.x(), p.position.y(),
               p.position.z());
    if (with_sigma) appendLine(text, ",%.4f", p.sigma);
    if (with_targets) text += ',';
    if (p.kind == ControlPoint::Kind::target) appendLine(text, "%.3f", p.diameter);
    text += '\n';
  }
  return text;
}

/// The true centres of the targets.
nlohmann::ordered_json targetsJson(const Simulator& simulator) {
  auto json = nlohmann::ordered_json::array();
  for (const ControlPoint& point : simulator.controlPoints()) {
    if (point.kind != ControlPoint::Kind::target) continue;
    const auto& disc = simulator.scene().targets()[json.size()].disc;
    const Eigen::Vector3d centre = simulator.options().origin + disc.centre;
    json.push_back({{"id", point.id},
                    {"centre_m", {centre.x(), centre.y(), centre.z()}},
                    {"diameter_m", 2.0 * disc.radius}});
  }
  return json;
}

std::string sitesText(const std::vector<simulation::LandCoverSite>& sites) {
  std::string text = "x,y,class\n";
  for (const auto& site : sites) {
    appendLine(text, "%.3f,%.3f,", site.x, site.y);
    text += std::string(classNameOf(site.cover)) + '\n';
  }
  return text;
}

nlohmann::ordered_json biasJson(const SystemVector& bias) {
  nlohmann::ordered_json json;
  for (const SystemParameterInfo& info : systemParameters()) {
    std::string key(info.name);
    if (info.unit == "arcsec") key += "_arcsec";
    if (info.parameter == SystemParameter::range_bias) key += "_m";
    // Without the last digits that the conversion of units adds.
    const double value = bias[indexOf(info.parameter)] / info.internal_per_unit;
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.12g", value);
    json[key] = std::stod(digits);
  }
  return json;
}

nlohmann::ordered_json noiseJson(const simulation::NoiseOptions& noise, const std::string& name) {
  nlohmann::ordered_json json = {{"level", name},
                                 {"range_m", noise.range},
                                 {"refraction_ppm", 1e6 * noise.refraction},
                                 {"scan_angle_arcsec", noise.scan_angle / kRadiansPerArcsec},
                                 {"footprint", noise.footprint},
                                 {"intensity_relative", noise.intensity},
                                 {"control_m", noise.control}};
  if (!noise.trajectory()) {
    json["trajectory"] = "none";
    return json;
  }
  const bool standard = noise.process == simulation::ErrorProcess::gauss_markov;
  json["trajectory"] = {{"process", standard ? "first-order Gauss-Markov" : nameOf(noise.process)},
                        {"correlation_time_s", noise.correlation_time},
                        {"position_m", noise.position},
                        {"roll_pitch_arcsec", noise.roll_pitch / kRadiansPerArcsec},
                        {"heading_arcsec", noise.heading / kRadiansPerArcsec}};
  return json;
}

nlohmann::ordered_json errorsJson(const simulation::ErrorSources& errors) {
  auto json = nlohmann::ordered_json::array();
  for (const simulation::ErrorSources::Entry& entry : errors.entries())
    json.push_back({{"name", entry.name},
                    {"of", entry.scopeName()},
                    {"value", entry.value},
                    {"unit", entry.unit}});
  return json;
}

nlohmann::ordered_json scannerJson(const SimulationOptions& options) {
  const simulation::ScannerOptions& scanner = options.scanner;
  nlohmann::ordered_json json = {{"type", nameOf(scanner.type)}, {"channels", scanner.channels}};
  if (scanner.channels > 1) {
    json["channel_angle_deg"] = scanner.channel_angle / kRadiansPerDegree;
    json["channel_field"] = scanner.channels <= 4 ? "scanner channel" : "user data";
  }
  if (options.errors.any(simulation::ErrorSource::range_walk))
    json["range_walk_reference"] = options.rangeWalkReference();
  return json;
}

nlohmann::ordered_json waveformJson(const simulation::WaveformOptions& waveform) {
  nlohmann::ordered_json json;
  if (waveform.pulse.empty()) {
    json["pulse_width_ns"] = waveform.pulse_width;
    json["pulse_skewness"] = waveform.pulse_skewness;
  } else {
    json["pulse"] = waveform.pulse;
    json["pulse_spacing_ns"] = waveform.pulse_spacing;
  }
  json["sample_spacing_ns"] = waveform.sample_spacing;
  json["bits"] = waveform.bits;
  json["baseline_counts"] = waveform.baseline * waveform.largestCount();
  json["noise_counts"] = waveform.noise * waveform.largestCount();
  json["counts_per_intensity"] = waveform.largestCount() / waveform.full_scale;
  json["sub_rays"] = 3 * waveform.rings * waveform.rings;
  json["detection_threshold_std"] = waveform.detection_threshold;
  return json;
}

nlohmann::ordered_json stripJson(const SimulationOptions& options, std::size_t i,
                                 const StripSummary& summary) {
  const simulation::PlannedLine& line = options.lines[i];
  const Eigen::Vector2d course = line.end - line.start;
  const double degrees = std::atan2(course.x(), course.y()) / kRadiansPerDegree;
  return {{"id", std::to_string(line.id)},
          {"file", summary.file},
          {"height_m", line.height},
          {"course_deg", std::round(degrees < 0.0 ? degrees + 360.0 : degrees)},
          {"speed_m_s", line.speed},
          {"pulses_per_m2", line.density},
          {"gain", line.gain},
          {"session", line.session},
          {"pulses", summary.pulses},
          {"points", summary.points}};
}

nlohmann::ordered_json sceneJson(const Simulator& simulator) {
  const simulation::Scene& scene = simulator.scene();
  std::size_t flat = 0;
  for (const simulation::Building& b : scene.buildings()) flat += b.pitch == 0.0 ? 1 : 0;
  const double z = simulator.options().origin.z();
  return {{"gable_roofs", scene.buildings().size() - flat},
          {"flat_roofs", flat},
          {"trees", scene.treeCount()},
          {"lowest_ground_m", z + scene.terrain().lowest()},
          {"highest_ground_m", z + scene.terrain().highest()}};
}

}  // namespace

std::string writeSurveyFiles(const Simulator& simulator, const std::filesystem::path& folder) {
  const auto samples = simulator.trajectory();
  const auto control = simulator.controlPoints();
  const auto training = simulator.landCoverSites(60, 0), check = simulator.landCoverSites(150, 1);
  writeFile(folder / "trajectory.csv", trajectoryText(samples));
  writeFile(folder / "control.csv", controlText(control, simulator.options()));
  writeFile(folder / "training.csv", sitesText(training));
  writeFile(folder / "checkpoints.csv", sitesText(check));
  return grouped(samples.size()) + " samples, " + grouped(control.size()) + " control points, " +
         grouped(training.size()) + " training and " + grouped(check.size()) + " check points";
}

void writeTruth(const Simulator& simulator, const std::string& noise_name,
                const StripFileOptions& options, const std::vector<StripSummary>& strips) {
  const SimulationOptions& s = simulator.options();
  nlohmann::ordered_json json;
  json["format"] = "pcl_als simulation truth";
  json["version"] = 1;
  json["convention"] = "bias = assumed - true (Habib et al. 2011, Eq. 8)";
  json["bias"] = biasJson(s.bias);
  json["errors"] = errorsJson(s.errors);
  json["scanner"] = scannerJson(s);
  json["noise"] = noiseJson(s.noise, noise_name);
  json["pairs"] = nlohmann::ordered_json::array();
  for (const auto& [a, b] : s.pairs)
    json["pairs"].push_back({std::to_string(a), std::to_string(b)});
  json["strips"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < strips.size(); ++i)
    json["strips"].push_back(stripJson(s, i, strips[i]));
  json["preset"] = s.name;
  json["seed"] = s.seed;
  json["vertical"] = s.vertical;
  json["origin"] = {s.origin.x(), s.origin.y(), s.origin.z()};
  json["crs"] = s.crs;
  json["gps_week"] = kSimulatedWeek;
  json["point_time"] = options.adjusted_time ? "adjusted standard GPS time" : "seconds of the week";
  json["field_of_view_deg"] = s.scanner.field_of_view / kRadiansPerDegree;
  json["beam_divergence_mrad"] = s.scanner.divergence * 1e3;
  json["intensity"] = {{"gain_at_1000_m", s.scanner.gain},
                       {"range_exponent", s.scanner.range_exponent},
                       {"incidence_exponent", s.scanner.incidence_exponent},
                       {"extinction_per_km", simulation::extinctionPerKilometre(s.atmosphere)},
                       {"visibility_km", s.atmosphere.visibility_km},
                       {"temperature_c", s.atmosphere.temperature_c},
                       {"pressure_kpa", s.atmosphere.pressure_kpa}};
  if (s.waveform) json["waveform"] = waveformJson(*s.waveform);
  json["scene"] = sceneJson(simulator);
  if (s.targets > 0) json["targets"] = targetsJson(simulator);
  json["tool_version"] = PCL_ALS_VERSION;
  writeFile(options.folder / "truth.json", json.dump(1) + "\n");
}

namespace {

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(folder.string() + ": the folder cannot be made");
}

/// Whatever the user put into the folder stays there.
void refuseForeignFiles(const SimulationOptions& options, const StripFileOptions& files) {
  std::vector<std::filesystem::path> written;
  for (const char* name :
       {"trajectory.csv", "control.csv", "training.csv", "checkpoints.csv", "truth.json"})
    written.push_back(files.folder / name);
  for (const simulation::PlannedLine& line : options.lines) {
    written.push_back(files.folder / files.nameOf(line.id));
    if (options.waveform) written.push_back(files.folder / files.packetsOf(line.id));
  }
  refuseForeign(written);
}

void refuseForeignStrips(const SimulationOptions& options, const StripFileOptions& files) {
  std::set<std::string> ours;
  for (const simulation::PlannedLine& line : options.lines) ours.insert(files.nameOf(line.id));
  for (const auto& entry : std::filesystem::directory_iterator(files.folder)) {
    const std::string name = entry.path().filename().string();
    const std::string extension = entry.path().extension().string();
    if (name.rfind("strip", 0) != 0 || (extension != ".las" && extension != ".laz")) continue;
    if (ours.count(name) == 0)
      throw UsageError(entry.path().string() +
                       ": is a strip of another block; delete it or name another folder");
  }
}

}  // namespace

void simulateSurvey(const SimulationOptions& options, const std::string& noise_name,
                    const StripFileOptions& files, int threads, const ProgressCallback& callback) {
  makeFolder(files.folder);
  FileProtection protection;
  protection.guard(files.folder);
  if (files.images) protection.guard(files.folder / "images");
  refuseForeignStrips(options, files);
  refuseForeignFiles(options, files);
  std::filesystem::remove(files.folder / "truth.json");  // until all is written there is no truth
  ProgressReport progress(callback);
  progress.begin("Building the scene");
  const Simulator simulator(options);
  progress.end(grouped(simulator.scene().buildings().size()) + " houses, " +
               grouped(simulator.scene().treeCount()) + " trees");
  progress.begin("Writing trajectory and control");
  progress.end(writeSurveyFiles(simulator, files.folder));
  std::vector<StripSummary> strips;
  for (std::size_t i = 0; i < simulator.stripCount(); ++i) {
    progress.begin("Simulating " + files.nameOf(options.lines[i].id));
    strips.push_back(writeStrip(simulator, i, files, threads,
                                [&progress](double share) { progress.advance(share); }));
    progress.end(grouped(strips.back().points) + " points");
  }
  if (files.images) {
    progress.begin("Taking images");
    const auto images = simulation::simulateImages(
        simulator.scene(), options, imageFlightOver(options), simulator.controlPoints());
    progress.end(writeImageFiles(images, files.folder / "images"));
  }
  writeTruth(simulator, noise_name, files, strips);
}

}  // namespace pcl_als
