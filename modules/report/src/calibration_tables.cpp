// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iomanip>
#include <sstream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/report/calibration_tables.h>

namespace pcl_als {
namespace {

std::string pairsCsv(const CalibrationResult& result) {
  std::ostringstream out;
  out << "a,b,correspondences,rms_before_m,rms_after_m,mean_before_m,mean_after_m\n"
      << std::setprecision(9);
  for (const PairFit& pair : result.pairs) {
    out << pair.a << ',' << pair.b << ',' << pair.correspondences << ',' << pair.rms_before << ','
        << pair.rms_after << ',' << pair.mean_before << ',' << pair.mean_after << '\n';
  }
  return out.str();
}

std::string iterationsCsv(const CalibrationResult& result) {
  std::ostringstream out;
  out << "iteration,correspondences,sigma0,largest_update_m\n" << std::setprecision(9);
  int number = 0;
  for (const CalibrationIteration& iteration : result.iterations) {
    out << ++number << ',' << iteration.correspondences << ',' << iteration.sigma0 << ','
        << iteration.largest_update << '\n';
  }
  return out.str();
}

std::string areasCsv(const std::vector<SurveyArea>& areas, const std::vector<double>& information) {
  std::ostringstream out;
  out << "x_min,y_min,x_max,y_max,information\n" << std::fixed;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const SurveyArea& area = areas[i];
    out << std::setprecision(3) << area.minimum.x() << ',' << area.minimum.y() << ','
        << area.minimum.x() + area.size << ',' << area.minimum.y() + area.size << ','
        << std::setprecision(6) << information[i] << '\n';
  }
  return out.str();
}

}  // namespace

void writeCalibrationCsv(const std::filesystem::path& folder, const CalibrationResult& result,
                         const std::vector<SurveyArea>& areas,
                         const std::vector<double>& information) {
  writeFile(folder / "pairs.csv", pairsCsv(result));
  writeFile(folder / "iterations.csv", iterationsCsv(result));
  writeFile(folder / "areas.csv", areasCsv(areas, information));
}

}  // namespace pcl_als
