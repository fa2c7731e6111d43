// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// The program on the page share/doc/programs.md; ../run.sh compares them.
#include <exception>
#include <iostream>

#include <pcl_als/processing/check_delivery.h>

int main(int argc, char** argv) try {
  pcl_als::SurveyReader survey({argv + 1, argv + argc});
  const auto progress = [](const pcl_als::JobProgress& now) {
    if (now.event == pcl_als::JobProgress::Event::end)
      std::cerr << now.phase << ": " << now.text << '\n';
    return true;  // false cancels the job
  };
  const auto check = pcl_als::checkDelivery(survey, nullptr, {}, progress);
  for (const pcl_als::CheckedPair& pair : check.block.pairs)
    std::cout << pair.a << " & " << pair.b << ": RMSDz " << pair.assessment.vertical.rms << " m\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';  // one line: file, fault, hint
  return 2;
}
