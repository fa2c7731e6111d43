// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/processing/image_orientation.h>

namespace pcl_als {

class FieldTable;

/// Result for the terminal: precision, blunders, and differences at check points.
std::string orientationText(const ImageOrientationResult& result);

/// The text of orientation.json.
std::string orientationJson(const ImageOrientationResult& result);
/// The description of orientation.json.
const FieldTable& orientationFields();

}  // namespace pcl_als
