// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <exception>
#include <string>
#include <vector>

namespace pcl_als {

/** \brief The processes that share a job, and the messages between them.
 *
 * A distributed job runs the same program in every process (rank). Each process does a part of the
 * items of a loop (files, areas, tiles), the results of all items are gathered at every process,
 * and what follows is computed by all of them alike. Jobs take a pointer; null stands for a single
 * process. FolderCommunicator exchanges messages as files; the implementation by MPI is
 * MpiCommunicator in module mpi.
 *
 * The functions that are marked collective are called by all processes in the same order.
 */
class Communicator {
 public:
  virtual ~Communicator() = default;

  virtual int rank() const = 0;  ///< of this process, 0 … size() - 1
  virtual int size() const = 0;  ///< number of processes
  /// Whether this is the process that prints and writes the results of the whole job.
  bool isRoot() const { return rank() == 0; }

  /// Collective: the bytes of all processes, by rank.
  virtual std::vector<std::string> gatherAll(const std::string& bytes) = 0;
  /// Collective: sends bytes[i] to process i; the bytes received from all processes, by rank.
  virtual std::vector<std::string> exchange(const std::vector<std::string>& bytes) = 0;

  /// Collective: begin and end of a part that processes do without each other (doTogether()).
  virtual void beginPart() = 0;
  virtual void endPart() = 0;
  /// During a part, now and then, by one thread at a time: tells how much of its own share this
  /// process has done, 0 … 1. Returns false where another process announced a failure.
  virtual bool advance(double fraction) = 0;
  /// Mean of what the processes told last; known to the root only.
  virtual double progress() const = 0;
  /// During a part: makes advance() return false in the other processes.
  virtual void announceFailure() = 0;

  /** \brief Collective: the end of the job, with the exception that ended it in this process, or
   * null. Throws the exception of the first process by rank that has one. Returns false where this
   * process failed and the others cannot be told.
   */
  virtual bool conclude(const std::exception_ptr& failure) = 0;

 protected:
  Communicator() = default;
  Communicator(const Communicator&) = default;
  Communicator& operator=(const Communicator&) = default;
};

}  // namespace pcl_als
