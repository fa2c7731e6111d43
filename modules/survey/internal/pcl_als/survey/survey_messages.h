// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/survey/surveyed_file.h>

namespace pcl_als::detail {

/// What is known of a point file, as bytes for another process.
void put(ByteWriter& out, const PointFileInfo& info);
void get(ByteReader& in, PointFileInfo& info);
void put(ByteWriter& out, const PointFileSources& sources);
void get(ByteReader& in, PointFileSources& sources);
void put(ByteWriter& out, const SurveyedFile& file);
void get(ByteReader& in, SurveyedFile& file);

/// Size of a file as the cost of reading it, bytes; 1 where it is not known.
double readingCost(const std::filesystem::path& path);

}  // namespace pcl_als::detail
