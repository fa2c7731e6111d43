// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

namespace pcl_als {

class Communicator;

/// How a job that makes an output of every input runs.
struct BatchOptions {
  /** \brief Records every complete output, and keeps outputs that an earlier run recorded.
   *
   * The records are in the folder kRecords beside the outputs. An output is kept where its input
   * (path, size, time of modification), itself (size, time of modification) and \a settings are
   * those of the record. Temporary files that a killed run left for these outputs are removed; no
   * other job may write the same outputs at the time.
   */
  bool resume = false;
  /// Everything else that the outputs depend on, as text: options, version, files such as the
  /// trajectory with size and time.
  std::string settings;
  bool joint = false;                 ///< whether each output depends on all inputs
  Communicator* processes = nullptr;  ///< that share the files; null: one process

  static constexpr const char* kRecords = ".pcl_als_resume";
};

}  // namespace pcl_als
