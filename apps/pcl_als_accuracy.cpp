// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/report/accuracy_report.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

CommandLine commandLine() {
  CommandLine line("pcl_als_accuracy",
                   "computes the accuracy of a classification: overall, kappa, and by class",
                   "MATRIX.csv -output accuracy.json [-compare OTHER.csv]",
                   "pcl_als_accuracy corrected_checked.csv -compare raw_checked.csv -output "
                   "accuracy.json");
  line.setArguments({{"", 1, 1}});
  line.addOutputFile("output", "accuracy figures", {".json"}).needed();
  line.addInputFile(
      "compare",
      "the other classification, of the same kind as the input: McNemar's test and the "
      "difference of the kappas");
  return line;
}

int accuracy(const CommandLine& line) {
  const std::string input = line.inputs().front();
  const std::string other = line.has("compare") ? line.text("compare") : "";
  const AccuracyReport report = accuracyOfFiles(input, other);
  if (!line.quiet()) std::cout << accuracyText(report);
  writeFile(line.text("output"), accuracyJson(report));
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, pcl_als::app::commandLine, pcl_als::app::accuracy);
}
