// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/strip_census.h>
#include <pcl_als/processing/survey_reader.h>

namespace pcl_als {
namespace {

FlightFile censusFlight(const CensusRequest& request, const SurveyReader& survey) {
  FlightFileOptions options;
  static_cast<TrajectoryReading&>(options) = request.reading;
  if (options.crs.empty()) options.crs = survey.reference().crs;
  return readFlight(request.trajectory, options);
}

}  // namespace

StripCensusResult takeCensus(const CensusRequest& request,
                             const std::function<void(double)>& progress) {
  StripCensusResult result;
  FlightFile flight;
  std::optional<SurveyReader> survey;
  try {
    if (!request.trajectory.empty()) {
      std::vector<std::string> paths;
      for (const std::filesystem::path& file : request.files) paths.push_back(file.string());
      survey.emplace(paths, request.threads, request.window);
      flight = censusFlight(request, *survey);
      result.notes = survey->choose(request.strips, {flight.trajectory.get(), std::nullopt, false});
    }
  } catch (const InputError& error) {
    survey.reset();
    result.notes = {std::string("strips are divided without the trajectory: ") + error.what()};
  }
  if (!survey) {
    result.census = takeCensus(request.files, request.cell, progress, request.strips,
                               request.window, result.left_out);
    return result;
  }
  std::vector<std::uint64_t> counts;
  result.census = takeCensus(request.files, request.cell, progress,
                             censusStrips(survey->arrangement(), counts), request.window);
  result.left_out = survey->arrangement().leftOut(counts);
  return result;
}

}  // namespace pcl_als
