// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/communicator.h>

namespace pcl_als {

/** \brief Communicator over files in a folder that all processes see: for processes that are
 * started one by one, as by a Slurm array, Dask, GNU parallel or a shell, without MPI.
 *
 * All processes of a job have to run at the same time. A message is written under another name and
 * renamed, so that no process reads a part of it; a message that all have read is removed. Each
 * process writes a heartbeat to a file of its own every two seconds: one that has begun and does
 * not do so for \a patience counts as ended. Messages have the size of the partial results, such as
 * the points of the areas of a calibration.
 *
 * \code
 * FolderCommunicator processes("/scratch/job17", 0, 4);  // the other three: 1, 2, 3
 * options.processes = &processes;
 * calibrateSurvey(survey, flight, options);
 * processes.conclude(nullptr);
 * \endcode
 */
class FolderCommunicator : public Communicator {
 public:
  /// \param folder of this job alone; made where it is missing. InputError where it cannot be
  /// written or holds files of another run; UsageError for an impossible rank.
  FolderCommunicator(std::filesystem::path folder, int rank, int size,
                     std::chrono::seconds patience = std::chrono::seconds(120));
  ~FolderCommunicator() override;
  FolderCommunicator(const FolderCommunicator&) = delete;
  FolderCommunicator& operator=(const FolderCommunicator&) = delete;

  int rank() const override;
  int size() const override;
  /// Both: InputError where a process has ended, failed or does another job.
  std::vector<std::string> gatherAll(const std::string& bytes) override;
  std::vector<std::string> exchange(const std::vector<std::string>& bytes) override;
  void beginPart() override;
  void endPart() override;
  bool advance(double fraction) override;
  double progress() const override;
  void announceFailure() override;
  /// The others learn of a failure wherever they are: returns true. The first process removes the
  /// files of the job from the folder.
  bool conclude(const std::exception_ptr& failure) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
