// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/las/las_file.h>

#include "las_output.h"

namespace pcl_als::detail {

/** \brief Ends the points of an output that has the head of \a input, and copies everything that
 * lies behind the points of \a input: EVLRs, waveform packets, unknown bytes.
 *
 * The positions of EVLRs and waveform packets in the header are stored where they change. An
 * octree of chunks (COPC) of the input is left out.
 */
void copyLasTail(const LasFile& input, LasOutput& output);

}  // namespace pcl_als::detail
