// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als {

/// Limits the threads of the program: a request for all cores (0) then means so many.
/// \param most 0: the number of cores
void limitThreads(int most);

/** \brief Reserves threads that run beside the calling one.
 *
 * All reservations of the program count together, so that work that is divided within divided work
 * (the chunks of each of several files) does not run on the square of the number of threads.
 * \param most of all reservations together
 * \return the number granted, at most \a wanted; the calling thread does the rest of the work
 */
unsigned reserveThreads(unsigned wanted, unsigned most);
/// Returns reserved threads, each as soon as it has ended.
void releaseThreads(unsigned count);

}  // namespace pcl_als
