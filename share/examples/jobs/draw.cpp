// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// draw PICTURE.png FILE…: points from above, coloured by strip.
#include <exception>
#include <iostream>

#include <pcl_als/processing/picture/survey_picture.h>

int main(int argc, char** argv) try {
  pcl_als::SurveyPictureOptions options;
  options.attribute = "strip";
  options.shade = pcl_als::PointShade::eye_dome;
  options.title = "Strips";
  const pcl_als::SurveyPicture picture({argv + 2, argv + argc}, options);
  picture.draw().write(argv[1]);
  std::cout << picture.shownPoints() << " points shown\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
