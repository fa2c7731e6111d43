// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <exception>
#include <memory>
#include <string>

#include <pcl_als/common/communicator.h>

namespace pcl_als {

/// Whether the process was started by mpirun, mpiexec or srun as one of several processes.
bool isStartedByMpi();

/** \brief Communicator over MPI (Boost.MPI): one object for the time in which a program uses MPI.
 *
 * Processes that wait for others sleep. Messages may have any size. Where a process ends without
 * conclude(), the MPI runtime ends the others.
 *
 * \code
 * MpiCommunicator processes;
 * options.processes = &processes;
 * calibrateSurvey(survey, flight, options);
 * \endcode
 */
class MpiCommunicator : public Communicator {
 public:
  MpiCommunicator();  ///< InputError where MPI does not allow several threads
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override;
  int size() const override;
  std::vector<std::string> gatherAll(const std::string& bytes) override;
  std::vector<std::string> exchange(const std::vector<std::string>& bytes) override;
  void beginPart() override;
  void endPart() override;
  bool advance(double fraction) override;
  double progress() const override;
  void announceFailure() override;

  /// A process that failed waits ten seconds for the others. Where they do not arrive, they expect
  /// its results: returns false, and the process reports its exception and calls abort().
  bool conclude(const std::exception_ptr& failure) override;
  /// Ends all processes; their unfinished files are removed by their signal handlers.
  [[noreturn]] void abort(int status);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
