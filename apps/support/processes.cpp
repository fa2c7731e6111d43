// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "processes.h"

#include <charconv>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <streambuf>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/folder_communicator.h>

#if PCL_ALS_WITH_MPI
#include <pcl_als/mpi/mpi_communicator.h>
#endif

namespace pcl_als::app {
namespace {

Communicator* running = nullptr;

/// Lets a stream drop its text as long as it exists.
class Silence : std::streambuf {
 public:
  explicit Silence(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(this)) {}
  ~Silence() override { stream_.rdbuf(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int overflow(int character) override { return traits_type::not_eof(character); }

  std::ostream& stream_;
  std::streambuf* before_;
};

/// Processes with different options would wait for messages that the others do not send.
void requireSameCommand(const CommandLine& line) {
  std::string command = settingsText(line.toolAndVersion(), line.settings(), {"threads", "quiet"});
  for (const std::string& input : line.inputs()) command += '\n' + input;
  const std::vector<std::string> commands = running->gatherAll(command);
  for (std::size_t other = 1; other < commands.size(); ++other)
    if (commands[other] != commands.front())
      throw UsageError("process " + std::to_string(other + 1) +
                       " has other options or files than the first one: start all processes of a "
                       "job with the same command");
}

/// The body in one of several processes; what ends one ends all. \a abort: called where this
/// process failed and the others cannot be told.
int runAmong(Communicator& all, const std::function<int()>& body,
             const std::function<void(const std::exception_ptr& failure)>& abort) {
  std::exception_ptr failure;
  int status = kDone;
  running = &all;
  try {
    status = body();
  } catch (...) {
    failure = std::current_exception();
  }
  running = nullptr;
  if (!all.conclude(failure)) abort(failure);
  return status;
}

/// The number of a process and of all, from "2/4".
std::pair<int, int> placeOf(const std::string& text) {
  int number = 0, count = 0;
  const char* const end = text.data() + text.size();
  const char* const slash = std::from_chars(text.data(), end, number).ptr;
  const bool divided =
      slash != end && *slash == '/' && std::from_chars(slash + 1, end, count).ptr == end;
  if (!divided || number < 1 || number > count)
    throw UsageError("'" + text + "' is not the number of a process and of all, such as 2/4");
  return {number, count};
}

/// A job of which this is one of several processes that were started one by one.
int runByFolder(const CommandLine& line, int (*job)(const CommandLine&)) {
  const auto [number, count] = line.parsed("process", placeOf);
  FolderCommunicator all(line.text("exchange"), number - 1, count);
  std::optional<Silence> quiet;
  if (!all.isRoot()) quiet.emplace(std::cout);
  return runAmong(all,
                  [&] {
                    requireSameCommand(line);
                    return job(line);
                  },
                  {});
}

#if PCL_ALS_WITH_MPI
/// A job of which this is one of the processes that mpirun started: the first one prints.
int runByMpi(CommandLine& line, const std::function<bool()>& parse,
             int (*job)(const CommandLine&)) {
  return run(line, [&] {
    MpiCommunicator all;
    std::optional<Silence> quiet, no_errors;
    if (!all.isRoot()) quiet.emplace(std::cout), no_errors.emplace(std::cerr);
    int status = kDone;
    try {
      status = runAmong(
          all,
          [&] {
            if (!parse()) return int{kDone};
            if (line.given("process"))
              throw UsageError("option -process: these processes were started by mpirun");
            requireSameCommand(line);
            return job(line);
          },
          [&](const std::exception_ptr& failure) {
            no_errors.reset();
            all.abort(reportFailure(line, failure));
          });
    } catch (...) {
      status = reportFailure(line, std::current_exception());
    }
    std::cout.flush();
    return all.isRoot() ? status : int{kDone};
  });
}
#endif

/// Without MPI each process of mpirun would do the whole job.
void refuseMpi() {
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::string(size) != "1")
    throw UsageError(
        "this build has no MPI (PCL_ALS_WITH_MPI): start the processes one by one, with -process");
}

}  // namespace

Communicator* processes() {
  return running;
}

int runShared(int argc, const char* const* argv, CommandLine (*options)(),
              int (*job)(const CommandLine&)) {
  CommandLine line = options();
  line.addText("process",
               "K/N: this is process K of N that share the job, all started with the same command "
               "(Slurm array, GNU parallel, shell); needs -exchange")
      .noSetting();
  line.addText("exchange",
               "folder, of this job alone, for the messages of the processes; all see it under "
               "this name")
      .noSetting();
  line.makeDependent("process", "exchange");
  line.makeDependent("exchange", "process");
  const auto parse = [&] { return line.parse(argc, argv); };
#if PCL_ALS_WITH_MPI
  if (isStartedByMpi()) return runByMpi(line, parse, job);
#endif
  return run(line, [&] {
    refuseMpi();
    if (!parse()) return int{kDone};
    return line.given("process") ? runByFolder(line, job) : job(line);
  });
}

void addResumeOption(CommandLine& line) {
  line.addFlag(
          "resume",
          "record complete outputs, and keep those that an interrupted run of the same command "
          "recorded")
      .in(Group::output);
}

BatchOptions batchOptions(const CommandLine& line) {
  BatchOptions batch;
  batch.resume = line.has("resume");
  batch.processes = processes();
  batch.settings = settingsText(line.toolAndVersion(), line.settings(),
                                {"threads", "quiet", "resume", "report", "output"});
  return batch;
}

}  // namespace pcl_als::app
