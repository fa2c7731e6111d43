// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// drawing FOLDER: a plot as PNG and in a report.
#include <pcl_als/drawing/result_plots.h>
#include <pcl_als/report/html_report.h>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const auto plot =
      pcl_als::drawCurves({"Squares", "x, m", "y, m²", {{"squares", {1, 2, 3}, {1, 4, 9}, {}}}});
  plot.write(std::string(argv[1]) + "/squares.png");
  pcl_als::HtmlReport report("Squares", "drawing 1.0");
  report.setVerdict(pcl_als::VerdictGrade::good, "They grow.");
  report.addPicture(plot, "Squares");
  report.write(argv[1]);
  return 0;
}
