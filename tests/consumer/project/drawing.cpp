// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// drawing FOLDER: a plot as PNG and in a report, without VTK's headers and without a display.
#include <pcl_als/visualization/html_report.h>
#include <pcl_als/visualization/result_plots.h>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const auto plot =
      pcl_als::drawCurves({"Squares", "x, m", "y, m²", {{"squares", {1, 2, 3}, {1, 4, 9}, {}}}});
  pcl_als::writePng(std::string(argv[1]) + "/squares.png", plot.image());
  pcl_als::HtmlReport report("Squares", "drawing 1.0");
  report.setVerdict(pcl_als::VerdictGrade::good, "They grow.");
  report.addPicture(plot.image(), "Squares");
  report.write(argv[1]);
  return 0;
}
