// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/report/orientation_report.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMostNames = 12;

std::string blundersText(const BundleResult& bundle) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostNames, bundle.blunders.size()); ++i) {
    const Blunder& blunder = bundle.blunders[i];
    char line[200];
    const std::string what =
        blunder.image.empty()
            ? "control line " + blunder.feature
            : std::string(blunder.line ? "line " : "point ") + blunder.feature +
                  (blunder.localised ? " in image " + blunder.image : " in one of its images");
    std::snprintf(line, sizeof line, "  blunder: %s, %.1f standard deviations\n", what.c_str(),
                  blunder.standardised);
    text += line;
  }
  if (bundle.blunders.size() > kMostNames)
    text += "  and " + counted(bundle.blunders.size() - kMostNames, "further blunder") + "\n";
  return text;
}

/// Names, the first of many.
std::string namesText(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostNames, names.size()); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  return text + (names.size() > kMostNames ? ", …" : "");
}

std::string checkText(const ImageOrientationResult& result) {
  const CheckSummary summary = summaryOf(result.check_points);
  std::string text = "  check points (" + std::to_string(result.check_points.size()) +
                     ")        X m        Y m        Z m    total m\n";
  char line[200];
  const auto row = [&](const char* name, const Eigen::Vector3d& v) {
    std::snprintf(line, sizeof line, "  %-18s %10.3f %10.3f %10.3f\n", name, v.x(), v.y(), v.z());
    text += line;
  };
  row("mean", summary.mean);
  row("standard deviation", summary.std);
  row("RMSE", summary.rmse);
  text.back() = ' ';
  std::snprintf(line, sizeof line, "%10.3f\n", summary.total);
  return text + line;
}

}  // namespace

std::string orientationText(const ImageOrientationResult& result) {
  const BundleResult& bundle = result.bundle;
  char line[240];
  std::snprintf(
      line, sizeof line, "  %s, %s, %s used; sigma0 %.3f, redundancy %.0f\n",
      counted(bundle.images.size(), "image").c_str(),
      counted(bundle.points.size(), "point").c_str(),
      counted(static_cast<std::size_t>(std::count_if(bundle.lines.begin(), bundle.lines.end(),
                                                     [](const AdjustedLine& l) { return l.used; })),
              "control line")
          .c_str(),
      bundle.sigma0, bundle.redundancy);
  std::string text = line;
  if (bundle.reliable()) {
    Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
    for (const OrientedImage& image : bundle.images) squares += image.covariance.diagonal();
    squares = (squares / static_cast<double>(bundle.images.size())).cwiseSqrt();
    std::snprintf(line, sizeof line,
                  "  standard deviations of orientations (RMS): X %.3f, Y %.3f, Z %.3f m; omega "
                  "%.4f, phi %.4f, kappa %.4f degrees\n",
                  squares[0], squares[1], squares[2], squares[3] / kRadiansPerDegree,
                  squares[4] / kRadiansPerDegree, squares[5] / kRadiansPerDegree);
    text += line;
    std::snprintf(line, sizeof line, " (standard deviation %.3f m or more at its border)\n",
                  bundle.weakest_std);
    text += "  determined worst: " + bundle.weakest + line;
  }
  text += blundersText(bundle);
  for (const std::string& warning : bundle.warnings) text += "  warning: " + warning + "\n";
  if (!result.unknown_lines.empty())
    text += "  " + counted(result.unknown_lines.size(), "line") +
            " of the images without a line of the control\n";
  if (!result.missing_points.empty())
    text += "  " + counted(result.missing_points.size(), "check point") +
            " without a position from the images: " + namesText(result.missing_points) + "\n";
  // Without datum the differences say nothing.
  if (bundle.reliable() && !result.check_points.empty()) text += checkText(result);
  return text;
}

}  // namespace pcl_als
