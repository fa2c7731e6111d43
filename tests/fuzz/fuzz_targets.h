// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pcl_als::fuzz {

/** \brief A reader that is given arbitrary bytes, with inputs to begin from.
 *
 * run() reads the bytes as a file of that kind; a pcl_als::Error is a right answer, anything else
 * (another exception, a crash, a sanitizer's report) is a bug.
 */
struct Target {
  const char* name;
  bool (*run)(const std::uint8_t* data, std::size_t size);  ///< false: refused by an Error
  std::vector<std::string> (*seeds)();
};

/// Files of points and trajectories, control, calibrations: las, laz, damaged_laz, copc, pcd,
/// pulse_waves; trajectory_csv, trajectory_export, sbet, smrmsg, terrascan, riegl_pof, riegl_poq,
/// leica_sol; control, calibration; camera, images, image_coordinates, object_lines
const std::vector<Target>& readerTargets();
/// geojson, class_sites, confusion_matrix, checked_sites, class_model, geotiff. A library of its
/// own: these need most modules, which take long to build with sanitizers.
const std::vector<Target>& landCoverTargets();

/// The bytes as a file that \a reader is called with; only the library's own errors are swallowed.
/// \return whether it was accepted
bool readAs(const char* extension, const std::uint8_t* data, std::size_t size,
            const std::function<void(const std::filesystem::path&)>& reader);

}  // namespace pcl_als::fuzz
