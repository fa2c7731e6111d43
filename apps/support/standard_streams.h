// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::app {

/// Opens those of the three standard streams that are closed on /dev/null, so that no file that is
/// opened later takes their place and receives what is printed.
void openStandardStreams();

/// Ends the process with one line on stderr and status 2 where a library calls abort(), as VTK does
/// without memory for a window, or where an exception has nobody to catch it.
void reportAborts(const char* tool);

/// Whether all that was printed has reached stdout; sets \a reason where it has not.
bool flushStandardOutput(const char*& reason);

}  // namespace pcl_als::app
