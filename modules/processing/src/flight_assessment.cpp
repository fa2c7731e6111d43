// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/flight_assessment.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {
namespace {

constexpr std::uint64_t kFewPoints = 1000;  // of a strip: too few to judge a trajectory by

/// Reads all points once.
void compare(const SurveyReader& survey, const std::shared_ptr<const Trajectory>& flight,
             FlightAssessment& assessment) {
  TrajectoryPlausibility plausibility(flight);
  std::vector<ScannerDetection> scanners(survey.strips().size(), ScannerDetection(flight));
  for (const std::string& strip : survey.strips()) plausibility.addStrip(strip);
  const auto add = [&](int strip, const LidarReturn* points, std::size_t count) {
    plausibility.addRun(strip, points, count);
    ScannerDetection& scanner = scanners[static_cast<std::size_t>(strip)];
    for (std::size_t i = 0; i < count; ++i) {
      plausibility.addReturn(strip, points[i]);
      scanner.add(points[i]);
    }
  };
  const std::vector<ExcludedPoints> excluded = survey.read(SurveyReader::asReturns(add));
  for (std::size_t i = 0; i < scanners.size(); ++i) {
    assessment.scanners.push_back({survey.strips()[i], scanners[i].assess()});
    if (survey.pointsByStrip()[i] < kFewPoints) plausibility.exclude(static_cast<int>(i));
  }
  for (const ExcludedPoints& part : excluded) {
    if (part.reason != ExclusionReason::excluded) assessment.warnings.push_back(describe(part));
  }
  for (const TrajectoryPlausibility::Finding& finding : plausibility.findings()) {
    const Warning& found = finding.warning;
    assessment.warnings.emplace_back(
        finding.refuse ? "the trajectory would be refused: " + found.text : found.text, found.hint);
  }
}

}  // namespace

FlightAssessment assessFlight(const std::vector<std::string>& files, const PointWindow& window,
                              StripChoice choice,
                              const std::vector<std::filesystem::path>& trajectory,
                              const TrajectoryReading& reading, int threads) {
  FlightAssessment assessment;
  try {
    SurveyReader survey(files, threads, window);
    TrajectoryLoadingOptions options;
    static_cast<TrajectoryReading&>(options) = reading;
    if (options.crs.empty()) options.crs = survey.reference().crs;
    const LoadedTrajectory flight = loadTrajectory(trajectory, options);
    choice.divide_lines = true;
    assessment.notes = survey.choose(choice, {flight.trajectory.get(), std::nullopt, true});
    compare(survey, flight.trajectory, assessment);
  } catch (const Error& error) {
    assessment.warnings.emplace_back(
        std::string("the trajectory cannot be used with the points: ") + error.what(),
        error.hint());
  }
  return assessment;
}

std::vector<std::string> describe(const std::vector<StripScanner>& scanners) {
  constexpr std::size_t kMostNamed = 20;
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // text and strips
  for (const StripScanner& entry : scanners) {
    const std::string text = entry.scanner.text();
    auto known = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& group) { return group.first == text; });
    if (known == groups.end()) known = groups.insert(known, {text, {}});
    known->second.push_back(entry.strip);
  }
  std::vector<std::string> lines;
  for (const auto& [text, strips] : groups) {
    std::string names;
    for (std::size_t i = 0; i < std::min(kMostNamed, strips.size()); ++i)
      names += (i == 0 ? "" : ", ") + strips[i];
    if (strips.size() > kMostNamed)
      names += " and " + std::to_string(strips.size() - kMostNamed) + " more";
    lines.push_back("scanner of " + names + ": " + text);
  }
  return lines;
}

}  // namespace pcl_als
