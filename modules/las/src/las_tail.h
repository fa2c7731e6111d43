// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/las/las_file.h>

#include "las_output.h"

namespace pcl_als::detail {

/** \brief Ends the points of an output that has the head of \a input, and copies everything that
 * lies behind the points of \a input: EVLRs, waveform packets, unknown bytes.
 *
 * The positions of EVLRs and waveform packets in the header are stored where they change. An
 * octree of chunks (COPC) of the input is omitted, and \a extended_records also omits EVLRs
 * that describe extra bytes, because the head of the output describes them.
 */
void copyLasTail(const LasFile& input, LasOutput& output, bool extended_records = false);

/// What a user is told of a copy of \a input: what of it was wrong, and what was copied besides.
std::vector<std::string> remarksOf(const LasFile& input, const std::string& wrong_box,
                                   const WaveformCopy& waveforms);

}  // namespace pcl_als::detail
