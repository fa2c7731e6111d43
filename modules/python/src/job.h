// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>

#include <pcl_als/common/progress.h>

namespace pcl_als::python {

/// A callable that takes a Progress, or None.
using PythonProgress = std::optional<std::function<pybind11::object(const JobProgress&)>>;

/** \brief Runs \a job in a thread of its own, without the GIL, until it ends.
 *
 * The calling thread answers its progress: it calls \a callback, with the GIL, and handles signals
 * at least every 50 ms. Where the callback returns False, raises, or a signal handler raises (as
 * that of SIGINT does), the next report of progress ends the job with Cancelled, so that nothing
 * half written is left; the exception of the callback or handler is then raised in place of it.
 */
void runInThread(const PythonProgress& callback,
                 const std::function<void(const ProgressCallback& progress)>& job);

/// The same for a job with a result.
template <typename Job>
auto runJob(const PythonProgress& callback, Job&& job) {
  std::optional<decltype(job(std::declval<const ProgressCallback&>()))> result;
  runInThread(callback, [&](const ProgressCallback& progress) { result.emplace(job(progress)); });
  return std::move(*result);
}

}  // namespace pcl_als::python
