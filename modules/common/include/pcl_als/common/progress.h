// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <pcl_als/common/errors.h>

namespace pcl_als {

/// A job was ended by its progress callback. Nothing half written is left.
class Cancelled : public Error {
 public:
  using Error::Error;
};

/// Where a job stands: its phase ("reading strip1.las"), the share of the phase that is done, and
/// remarks for a user that arise on the way (then fraction repeats).
struct JobProgress {
  std::string phase;
  double fraction = 0.0;  ///< 0 … 1
  std::string remark;     ///< usually empty
};

/// Called by one thread at a time, now and then; false ends the job with Cancelled.
using ProgressCallback = std::function<bool(const JobProgress&)>;

/// A job's side of the callback.
class ProgressReport {
 public:
  explicit ProgressReport(ProgressCallback callback) : callback_(std::move(callback)) {}

  void begin(const std::string& phase) { tell({phase, 0.0, {}}); }
  void advance(double fraction) { tell({now_.phase, fraction, {}}); }
  void remark(const std::string& text) { tell({now_.phase, now_.fraction, text}); }

 private:
  void tell(JobProgress progress) {
    now_ = std::move(progress);
    if (callback_ && !callback_(now_)) throw Cancelled("cancelled while " + now_.phase);
  }

  ProgressCallback callback_;
  JobProgress now_;
};

}  // namespace pcl_als
