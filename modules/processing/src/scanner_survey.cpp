// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/scanner_survey.h>

namespace pcl_als {

std::vector<StripScanner> detectScanners(SurveyReader& survey, const StripChoice& choice,
                                         const SurveyReader::Flight& flight) {
  survey.choose(choice, flight);
  const std::shared_ptr<const Trajectory> shared(std::shared_ptr<const Trajectory>(),
                                                 flight.trajectory);
  std::vector<ScannerDetection> strips(survey.strips().size(), ScannerDetection(shared));
  survey.read([&strips](int strip, const LidarReturn* points, std::size_t count) {
    ScannerDetection& detection = strips[static_cast<std::size_t>(strip)];
    for (std::size_t i = 0; i < count; ++i) detection.add(points[i]);
  });
  std::vector<StripScanner> found;
  for (std::size_t i = 0; i < strips.size(); ++i)
    found.push_back({survey.strips()[i], strips[i].assess()});
  return found;
}

std::vector<std::string> detectScanners(const std::vector<std::string>& files,
                                        const PointWindow& window, const StripChoice& choice,
                                        const std::vector<std::filesystem::path>& trajectory,
                                        const TrajectoryReading& reading, int threads,
                                        std::vector<StripScanner>& found) {
  try {
    SurveyReader survey(files, threads, window);
    FlightFileOptions options;
    static_cast<TrajectoryReading&>(options) = reading;
    if (options.crs.empty()) options.crs = survey.reference().crs;
    const FlightFile flight = readFlight(trajectory, options);
    found = detectScanners(survey, choice, {flight.trajectory.get(), std::nullopt, true});
    return describe(found);
  } catch (const Error& error) {
    return {std::string("scanner not detected: ") + error.what()};
  }
}

std::vector<std::string> describe(const std::vector<StripScanner>& scanners) {
  std::vector<std::pair<std::string, std::string>> lines;  // text and strips
  for (const StripScanner& entry : scanners) {
    const std::string text = entry.scanner.text();
    const auto known = std::find_if(lines.begin(), lines.end(),
                                    [&](const auto& line) { return line.first == text; });
    if (known == lines.end())
      lines.emplace_back(text, entry.strip);
    else
      known->second += ", " + entry.strip;
  }
  std::vector<std::string> texts;
  texts.reserve(lines.size());
  for (const auto& [text, strips] : lines) texts.push_back("scanner of " + strips + ": " + text);
  return texts;
}

}  // namespace pcl_als
