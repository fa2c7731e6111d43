// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als::fuzz {

// Small valid files of every kind, to begin from.
std::vector<std::string> lasSeeds();
std::vector<std::string> lazSeeds();
/// The same, and with chunk sizes that ask for more than there is.
std::vector<std::string> lazChunkSeeds();
std::vector<std::string> copcSeeds();
std::vector<std::string> pcdSeeds();
std::vector<std::string> plySeeds();
std::vector<std::string> xyzSeeds();
/// A Pulse file and its Waves file, behind the number of bytes of the former.
std::vector<std::string> pulseWavesSeeds();
std::vector<std::string> trajectorySeeds();
std::vector<std::string> sbetSeeds();
std::vector<std::string> exportSeeds();
std::vector<std::string> smrmsgSeeds();
std::vector<std::string> terrascanSeeds();
std::vector<std::string> pofSeeds();
std::vector<std::string> poqSeeds();
std::vector<std::string> solSeeds();
std::vector<std::string> controlSeeds();
std::vector<std::string> calibrationSeeds();
std::vector<std::string> cameraSeeds();
std::vector<std::string> imageSeeds();
std::vector<std::string> imageCoordinateSeeds();
std::vector<std::string> objectLineSeeds();
std::vector<std::string> geoJsonSeeds();
std::vector<std::string> classSiteSeeds();
std::vector<std::string> countTableSeeds();
std::vector<std::string> checkedSiteSeeds();
std::vector<std::string> classModelSeeds();
std::vector<std::string> geoTiffSeeds();

}  // namespace pcl_als::fuzz
