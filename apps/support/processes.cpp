// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "processes.h"

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

#if PCL_ALS_WITH_MPI
namespace {

MpiCommunicator* running = nullptr;

/// Takes text and drops it.
class NoText : public std::streambuf {
  int overflow(int character) override { return traits_type::not_eof(character); }
};

/// The body in one of several processes; what ends one ends all.
int runAmong(MpiCommunicator& all, const CommandLine& line, const std::function<int()>& body) {
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
      all.abort(reportFailure(line, failure));
    }
  } catch (...) {
    status = reportFailure(line, std::current_exception());
  }
  std::cout.flush();
  return all.isRoot() ? status : kDone;
}

int runJob(const CommandLine& line, const std::function<int()>& body) {
  if (!isStartedByMpi()) return run(line, body);
  NoText none;
  std::streambuf *const out = std::cout.rdbuf(), *const errors = std::cerr.rdbuf();
  const int status = run(line, [&] {
    MpiCommunicator all;
    running = &all;
    if (!all.isRoot()) std::cout.rdbuf(&none);
    if (!all.isRoot()) std::cerr.rdbuf(&none);
    return runAmong(all, line, body);
  });
  std::cout.rdbuf(out);
  std::cerr.rdbuf(errors);
  return status;
}

}  // namespace

Communicator* processes() {
  return running;
}
#else
namespace {

int runJob(const CommandLine& line, const std::function<int()>& body) {
  return run(line, [&body] {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (size != nullptr && std::string(size) != "1")
      throw UsageError("this build has no MPI (PCL_ALS_WITH_MPI): start it without mpirun");
    return body();
  });
}

}  // namespace

Communicator* processes() {
  return nullptr;
}
#endif

int runShared(int argc, const char* const* argv, CommandLine (*options)(),
              int (*job)(const CommandLine&)) {
  CommandLine line = options();
  return runJob(line, [&] { return line.parse(argc, argv) ? job(line) : kDone; });
}

void addResumeOption(CommandLine& line) {
  line.addFlag(
      "resume",
      "record complete outputs, and keep those that an interrupted run of the same command "
      "recorded");
}

BatchOptions batchOptions(const CommandLine& line) {
  BatchOptions batch;
  batch.resume = line.has("resume");
  batch.processes = processes();
  batch.settings = settingsText(line.toolAndVersion(), line.settings(),
                                {"threads", "quiet", "resume", "report", "json"});
  return batch;
}

}  // namespace pcl_als::app
