// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "processes.h"

#include <filesystem>
#include <set>
#include <sstream>

#if PCL_ALS_WITH_MPI
#include <iostream>
#include <streambuf>

#include <pcl_als/mpi/mpi_communicator.h>
#else
#include <cstdlib>
#include <string>

#include <pcl_als/common/errors.h>
#endif

namespace pcl_als::app {

namespace fs = std::filesystem;

#if PCL_ALS_WITH_MPI
namespace {

MpiCommunicator* running = nullptr;

/// Takes text and drops it.
class NoText : public std::streambuf {
  int overflow(int character) override { return traits_type::not_eof(character); }
};

/// The body in one of several processes; what ends one ends all.
int runAmong(MpiCommunicator& all, const char* tool, const std::function<int()>& body) {
  std::exception_ptr failure;
  int status = kDone;
  try {
    status = body();
  } catch (...) {
    failure = std::current_exception();
  }
  try {
    if (!all.conclude(failure)) {
      std::cerr.rdbuf(std::clog.rdbuf());  // this process failed alone
      all.abort(reportFailure(tool, failure));
    }
  } catch (...) {
    status = reportFailure(tool, std::current_exception());
  }
  std::cout.flush();
  return all.isRoot() ? status : kDone;
}

}  // namespace

int runShared(const char* tool, const std::function<int()>& body) {
  if (!isStartedByMpi()) return run(tool, body);
  NoText none;
  std::streambuf *const out = std::cout.rdbuf(), *const errors = std::cerr.rdbuf();
  const int status = run(tool, [&] {
    MpiCommunicator all;
    running = &all;
    if (!all.isRoot()) std::cout.rdbuf(&none);
    if (!all.isRoot()) std::cerr.rdbuf(&none);
    return runAmong(all, tool, body);
  });
  std::cout.rdbuf(out);
  std::cerr.rdbuf(errors);
  return status;
}

Communicator* processes() {
  return running;
}
#else
int runShared(const char* tool, const std::function<int()>& body) {
  return run(tool, [&body] {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (size != nullptr && std::string(size) != "1")
      throw UsageError("this build has no MPI (PCL_ALS_WITH_MPI): start it without mpirun");
    return body();
  });
}

Communicator* processes() {
  return nullptr;
}
#endif

void addResumeOption(CommandLine& line) {
  line.addFlag(
      "resume",
      "record complete outputs, and keep those that an interrupted run of the same command "
      "recorded");
}

BatchOptions batchOptions(const CommandLine& line) {
  static const std::set<std::string> without_effect{"threads", "quiet", "resume", "report", "json"};
  BatchOptions batch;
  batch.resume = line.has("resume");
  batch.processes = processes();
  std::ostringstream settings;
  settings << line.toolAndVersion();
  for (const auto& [name, value] : line.settings()) {
    if (without_effect.count(name) != 0) continue;
    settings << '\n' << name << '=' << value;
    for (const std::string& part : splitList(value)) {
      std::error_code none;
      if (!fs::is_regular_file(part, none)) continue;
      settings << ' ' << fs::file_size(part, none) << ' '
               << fs::last_write_time(part, none).time_since_epoch().count();
    }
  }
  batch.settings = settings.str();
  return batch;
}

}  // namespace pcl_als::app
