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

/// Where a job stands.
struct JobProgress {
  enum class Event { begin, advance, remark, end };
  Event event = Event::begin;
  std::string phase;      ///< "Reading the areas"
  double fraction = 0.0;  ///< of the phase, 0 … 1
  std::string text;       ///< of a remark; what the phase found at its end ("12 areas")
};

/// Called by one thread at a time, now and then; false ends the job with Cancelled.
using ProgressCallback = std::function<bool(const JobProgress&)>;

/// A job's side of the callback.
class ProgressReport {
 public:
  explicit ProgressReport(ProgressCallback callback) : callback_(std::move(callback)) {}

  void begin(const std::string& phase) { tell({JobProgress::Event::begin, phase, 0.0, {}}); }
  void advance(double fraction) { tell({JobProgress::Event::advance, now_.phase, fraction, {}}); }
  /// What a user should know, between or during phases; nothing where the text is empty.
  void remark(const std::string& text) {
    if (!text.empty()) tell({JobProgress::Event::remark, now_.phase, now_.fraction, text});
  }
  void end(const std::string& found) { tell({JobProgress::Event::end, now_.phase, 1.0, found}); }

 private:
  void tell(JobProgress progress) {
    now_ = std::move(progress);
    if (callback_ && !callback_(now_)) throw Cancelled("cancelled: " + now_.phase);
  }

  ProgressCallback callback_;
  JobProgress now_;
};

}  // namespace pcl_als
