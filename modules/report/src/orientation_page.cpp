// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/number_text.h>
#include <pcl_als/report/html_report.h>
#include <pcl_als/report/orientation_page.h>

#include "orientation_pictures.h"
#include "report_parts.h"

namespace pcl_als {
namespace {

std::string metres(double value) {
  return numberText(value, 3);
}

Verdict verdictOf(const ImageOrientationResult& result) {
  Verdict verdict;
  const BundleResult& bundle = result.bundle;
  if (!bundle.reliable()) {
    verdict.grade = VerdictGrade::bad;
    verdict.headline = "The block is not determined: " + bundle.message + ".";
    return verdict;
  }
  verdict.grade =
      bundle.warnings.empty() && bundle.sigma0 < 1.5 ? VerdictGrade::good : VerdictGrade::attention;
  const auto used = std::count_if(bundle.lines.begin(), bundle.lines.end(),
                                  [](const AdjustedLine& line) { return line.used; });
  verdict.headline = std::to_string(bundle.images.size()) + " images are oriented with " +
                     std::to_string(used) + " lines as control.";
  verdict.sentences.push_back("Residuals are " + numberText(bundle.sigma0, 2) +
                              " times their stated standard deviations (sigma0).");
  verdict.sentences.push_back("Determined worst by the control: " + bundle.weakest +
                              ", standard deviation " + centimetres(bundle.weakest_std) +
                              " or more at its border.");
  if (!bundle.blunders.empty())
    verdict.sentences.push_back("Observations that contradict the others and were not used: " +
                                std::to_string(bundle.blunders.size()) + ".");
  if (!result.missing_points.empty())
    verdict.sentences.push_back("Check points without a position from the images: " +
                                std::to_string(result.missing_points.size()) + ".");
  if (!result.check_points.empty()) {
    const CheckSummary summary = summaryOf(result.check_points);
    verdict.sentences.push_back("RMSE at " + std::to_string(result.check_points.size()) +
                                " check points: X " + centimetres(summary.rmse.x()) + ", Y " +
                                centimetres(summary.rmse.y()) + ", Z " +
                                centimetres(summary.rmse.z()) + ".");
  }
  for (const std::string& warning : bundle.warnings) verdict.sentences.push_back(warning + ".");
  return verdict;
}

void addCheckPoints(const ImageOrientationResult& result, HtmlReport& report) {
  if (result.check_points.empty() || !result.bundle.reliable()) return;
  report.addSection("Check points");
  const CheckSummary summary = summaryOf(result.check_points);
  ReportTable table{"checkpoints",
                    "Image block minus survey, m; standard deviations of the image block",
                    {"point", "X", "Y", "Z", "std X", "std Y", "std Z", "rays"},
                    {}};
  const auto row = [&](const std::string& name, const Eigen::Vector3d& v) {
    table.rows.push_back({name, metres(v.x()), metres(v.y()), metres(v.z())});
  };
  for (const ImageCheckPoint& p : result.check_points) {
    row(p.id, p.difference);
    for (int i = 0; i < 3; ++i) table.rows.back().push_back(metres(p.std[i]));
    table.rows.back().push_back(std::to_string(p.rays));
  }
  row("mean", summary.mean);
  row("standard deviation", summary.std);
  row("RMSE", summary.rmse);
  report.addTable(table);
}

void addImages(const BundleResult& bundle, HtmlReport& report) {
  report.addSection("Images");
  ReportTable table{
      "images",
      "Measurements in use, RMS of their residuals (micrometres), standard deviations "
      "of position (m)",
      {"image", "points", "places on lines", "RMS", "std X", "std Y", "std Z"},
      {}};
  for (const OrientedImage& image : bundle.images) {
    const Eigen::VectorXd std = image.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    table.rows.push_back({image.orientation.id, std::to_string(image.points),
                          std::to_string(image.lines), numberText(1000.0 * image.rms, 2),
                          metres(std[0]), metres(std[1]), metres(std[2])});
  }
  report.addTable(table);
}

void addBlunders(const BundleResult& bundle, HtmlReport& report) {
  if (bundle.blunders.empty()) return;
  report.addSection("Blunders");
  ReportTable table{"blunders",
                    "Observations that contradict the others; standardised residual",
                    {"feature", "image", "standardised"},
                    {}};
  for (const Blunder& blunder : bundle.blunders) {
    const std::string where = blunder.image.empty() ? "control"
                              : blunder.localised   ? blunder.image
                                                    : "one of its images";
    table.rows.push_back({blunder.feature, where, numberText(blunder.standardised, 1)});
  }
  report.addTable(table);
}

void addLines(const BundleResult& bundle, HtmlReport& report) {
  report.addSection("Control lines");
  ReportTable table{
      "lines",
      "Adjusted minus given at both ends, to the left and upwards, m; their size over "
      "its standard deviation",
      {"line", "left 1", "up 1", "left 2", "up 2", "standardised", "places", "use"},
      {}};
  std::vector<AdjustedLine> lines = bundle.lines;  // the most contradictory first
  std::stable_sort(lines.begin(), lines.end(), [](const AdjustedLine& a, const AdjustedLine& b) {
    return a.misfit > b.misfit;
  });
  for (const AdjustedLine& line : lines) {
    table.rows.push_back({line.line.id, metres(line.shift[0]), metres(line.shift[1]),
                          metres(line.shift[2]), metres(line.shift[3]), numberText(line.misfit, 1),
                          std::to_string(line.places), line.used ? "used" : "rejected"});
  }
  report.addTable(table);
}

}  // namespace

void writeOrientationPage(const ReportOrigin& origin, const ImageOrientationResult& result) {
  HtmlReport report(
      origin.titleOr("Orientation of " + std::to_string(result.block.images.size()) + " images"),
      origin.program);
  addVerdict(verdictOf(result), report);
  report.addSection("Block");
  report.addPicture(blockPicture(result),
                    "Images, points, control lines, and differences at check points (arrows: in "
                    "plan; numbers: in height).");
  if (!result.bundle.residuals.empty()) {
    report.addPicture(residualPicture(result),
                      "Residuals over the format of the image, of places on lines across them: a "
                      "pattern shows a camera that does not fit.");
    report.addPicture(standardisedPicture(result),
                      "Residuals of points and of places on lines over their standard deviations.");
  }
  addCheckPoints(result, report);
  addBlunders(result.bundle, report);
  addImages(result.bundle, report);
  addLines(result.bundle, report);
  addOrigin(origin, {}, report);
  report.write(origin.folder);
}

}  // namespace pcl_als
