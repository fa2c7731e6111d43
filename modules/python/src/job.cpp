// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "bindings.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kSignalInterval{50};

/// Passes reports of progress from the thread of a job to the one that waits for it.
class Exchange {
 public:
  /// In the thread of the job: waits for the answer; false ends the job.
  bool report(const JobProgress& progress, bool wanted) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (wanted && !cancelled_) {
      pending_ = &progress;
      changed_.notify_all();
      changed_.wait(lock, [this] { return pending_ == nullptr; });
    }
    return !cancelled_;
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  struct State {
    std::optional<JobProgress> pending;
    bool ended = false;
  };
  /// In the waiting thread: what has happened, after at most kSignalInterval.
  State wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, kSignalInterval, [this] { return pending_ != nullptr || ended_; });
    return {pending_ == nullptr ? std::nullopt : std::optional<JobProgress>(*pending_), ended_};
  }
  /// Lets a job that waits for an answer continue; with \a cancel it ends at its next report.
  void answer(bool cancel) {
    const std::lock_guard<std::mutex> lock(mutex_);
    cancelled_ = cancelled_ || cancel;
    pending_ = nullptr;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  const JobProgress* pending_ = nullptr;
  bool cancelled_ = false, ended_ = false;
};

/// Answers until the job has ended; the exception of the callback or of a signal handler, if any.
std::exception_ptr answerUntilEnd(const PythonProgress& callback, Exchange& exchange) {
  std::exception_ptr raised;
  for (;;) {
    Exchange::State state;
    {
      const py::gil_scoped_release released;
      state = exchange.wait();
    }
    if (state.ended) return raised;
    bool cancel = false;
    try {
      if (!raised && PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!raised && state.pending && callback)
        cancel = (*callback)(*state.pending).is(py::bool_(false));
    } catch (...) {
      raised = std::current_exception();
    }
    if (state.pending || raised) exchange.answer(cancel || raised != nullptr);
  }
}

const char* nameOf(JobProgress::Event event) {
  switch (event) {
    case JobProgress::Event::begin:
      return "begin";
    case JobProgress::Event::advance:
      return "advance";
    case JobProgress::Event::remark:
      return "remark";
    case JobProgress::Event::end:
      return "end";
  }
  return "";
}

}  // namespace

void runInThread(const PythonProgress& callback,
                 const std::function<void(const ProgressCallback& progress)>& job) {
  Exchange exchange;
  std::exception_ptr failure;
  const bool wanted = callback.has_value();
  std::thread worker([&] {
    try {
      job([&](const JobProgress& progress) { return exchange.report(progress, wanted); });
    } catch (...) {
      failure = std::current_exception();
    }
    exchange.end();
  });
  const std::exception_ptr raised = answerUntilEnd(callback, exchange);
  {
    const py::gil_scoped_release released;
    worker.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

void bindProgress(py::module_& m) {
  py::class_<JobProgress>(m, "Progress",
                          "Where a job stands; what progress callbacks are called with, in the "
                          "thread that called the job. A callback that returns False ends the job "
                          "with Cancelled, one that raises ends it with its exception.")
      .def_property_readonly(
          "event", [](const JobProgress& p) { return nameOf(p.event); },
          "'begin', 'advance' or 'end' of a phase, or 'remark'")
      .def_readonly("phase", &JobProgress::phase, "what is done, such as 'Reading the areas'")
      .def_readonly("fraction", &JobProgress::fraction, "of the phase, 0 to 1")
      .def_readonly("text", &JobProgress::text,
                    "of a remark; at the end of a phase what it found ('12 areas')")
      .def("__repr__", [](const JobProgress& p) {
        return "<pcl_als.Progress " + std::string(nameOf(p.event)) + " '" + p.phase + "' " +
               std::to_string(p.fraction) + ">";
      });
}

}  // namespace pcl_als::python
