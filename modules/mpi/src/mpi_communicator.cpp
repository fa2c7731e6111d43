// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <thread>

#include <boost/mpi/collectives.hpp>
#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/mpi/mpi_communicator.h>

namespace pcl_als {
namespace {

namespace mpi = boost::mpi;
using Clock = std::chrono::steady_clock;

constexpr int kData = 1, kProgress = 2, kFailure = 3;     // tags
constexpr std::size_t kPiece = std::size_t{1} << 28;      // bytes in one message; MPI counts in int
constexpr auto kPause = std::chrono::milliseconds(1);     // between looks at what is awaited
constexpr auto kLook = std::chrono::milliseconds(100);    // between looks for failures
constexpr double kPatience = 10.0;                        // seconds, of a process that failed
constexpr auto kReport = std::chrono::milliseconds(500);  // between reports of progress

/// Calls \a use(offset, size) for the pieces of a message.
template <typename Use>
void forPieces(std::uint64_t bytes, const Use& use) {
  for (std::uint64_t at = 0; at < bytes; at += kPiece)
    use(at, static_cast<int>(std::min<std::uint64_t>(kPiece, bytes - at)));
}

/// What a process tells at the end of a part.
struct PartEnd {
  int reports = 0;  ///< of progress, sent to the root
  int failed = 0;   ///< whether it sent a failure to every other process
};

}  // namespace

struct MpiCommunicator::State {
  State()
      : environment(mpi::threading::serialized),
        control(world, mpi::comm_duplicate),
        ending(world, mpi::comm_duplicate) {
    if (mpi::environment::thread_level() < mpi::threading::serialized)
      throw InputError("this MPI does not support calls from several threads");
    shares.assign(static_cast<std::size_t>(world.size()), 0.0);
  }

  /// Waits, without using the processor, until all processes are here; false after \a patience
  /// seconds (negative: no limit).
  static bool waitForAll(const mpi::communicator& processes, double patience = -1.0) {
    const Clock::time_point start = Clock::now();
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(processes, &request);
    for (int here = 0;;) {
      MPI_Test(&request, &here, MPI_STATUS_IGNORE);
      if (here != 0) return true;
      if (patience >= 0.0 && Clock::now() - start > std::chrono::duration<double>(patience))
        return false;
      std::this_thread::sleep_for(kPause);
    }
  }
  void takeReport(int source) {
    control.recv(source, kProgress, shares[static_cast<std::size_t>(source)]);
    ++received[static_cast<std::size_t>(source)].reports;
  }
  void takeFailure(int source) {
    int nothing = 0;
    control.recv(source, kFailure, nothing);
    received[static_cast<std::size_t>(source)].failed = 1;
    others_failed = true;
  }
  void look() {
    while (const auto waiting = control.iprobe(mpi::any_source, kFailure))
      takeFailure(waiting->source());
    while (const auto waiting = control.iprobe(mpi::any_source, kProgress))
      takeReport(waiting->source());
  }

  mpi::environment environment;
  /// For data; for progress and failures; for the end of the job, which no other call may match.
  mpi::communicator world, control, ending;
  std::mutex mutex;
  bool in_part = false, others_failed = false;
  PartEnd sent;
  std::vector<PartEnd> received;  ///< in this part, by rank
  std::vector<double> shares;     ///< done, by rank
  Clock::time_point last_look, last_report;
};

bool isStartedByMpi() {
  const char* const variables[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::any_of(std::begin(variables), std::end(variables),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

MpiCommunicator::MpiCommunicator() : state_(std::make_unique<State>()) {}

MpiCommunicator::~MpiCommunicator() = default;

int MpiCommunicator::rank() const {
  return state_->world.rank();
}

int MpiCommunicator::size() const {
  return state_->world.size();
}

std::vector<std::string> MpiCommunicator::gatherAll(const std::string& bytes) {
  State::waitForAll(state_->control);
  std::vector<std::uint64_t> sizes;
  mpi::all_gather(state_->world, static_cast<std::uint64_t>(bytes.size()), sizes);
  std::vector<std::string> all(sizes.size());
  for (int source = 0; source < size(); ++source) {
    std::string& part = all[static_cast<std::size_t>(source)];
    if (source == rank()) part = bytes;
    part.resize(sizes[static_cast<std::size_t>(source)]);
    forPieces(part.size(), [&](std::uint64_t at, int count) {
      mpi::broadcast(state_->world, &part[at], count, source);
    });
  }
  return all;
}

std::vector<std::string> MpiCommunicator::exchange(const std::vector<std::string>& bytes) {
  State::waitForAll(state_->control);
  std::vector<std::uint64_t> sent, sizes;
  for (const std::string& part : bytes) sent.push_back(part.size());
  mpi::all_to_all(state_->world, sent, sizes);
  std::vector<std::string> received(sizes.size());
  // In each round a process sends to one and receives of another: no process holds more than that.
  for (int round = 0; round < size(); ++round) {
    const int to = (rank() + round) % size(), from = (rank() + size() - round) % size();
    const std::string& out = bytes[static_cast<std::size_t>(to)];
    std::string& in = received[static_cast<std::size_t>(from)];
    if (round == 0) {
      in = out;
      continue;
    }
    in.resize(sizes[static_cast<std::size_t>(from)]);
    std::vector<MPI_Request> requests;
    forPieces(in.size(), [&](std::uint64_t at, int count) {
      MPI_Irecv(&in[at], count, MPI_CHAR, from, kData, state_->world, &requests.emplace_back());
    });
    forPieces(out.size(), [&](std::uint64_t at, int count) {
      MPI_Isend(&out[at], count, MPI_CHAR, to, kData, state_->world, &requests.emplace_back());
    });
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }
  return received;
}

void MpiCommunicator::beginPart() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->in_part = true;
  state_->others_failed = false;
  state_->sent = {};
  state_->received.assign(static_cast<std::size_t>(size()), {});
  std::fill(state_->shares.begin(), state_->shares.end(), 0.0);
}

void MpiCommunicator::endPart() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->in_part = false;
  State::waitForAll(state_->control);
  std::vector<int> reports, failed;
  mpi::all_gather(state_->world, state_->sent.reports, reports);
  mpi::all_gather(state_->world, state_->sent.failed, failed);
  for (int other = 0; other < size(); ++other) {
    const auto at = static_cast<std::size_t>(other);
    while (isRoot() && state_->received[at].reports < reports[at]) state_->takeReport(other);
    if (other != rank() && state_->received[at].failed < failed[at]) state_->takeFailure(other);
  }
}

bool MpiCommunicator::advance(double fraction) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (!state_->in_part || state_->others_failed) return !state_->others_failed;
  state_->shares[static_cast<std::size_t>(rank())] = fraction;
  const Clock::time_point now = Clock::now();
  if (now - state_->last_look > kLook) {
    state_->last_look = now;
    state_->look();
  }
  if (!isRoot() && now - state_->last_report > kReport) {
    state_->last_report = now;
    state_->control.send(0, kProgress, fraction);
    ++state_->sent.reports;
  }
  return !state_->others_failed;
}

double MpiCommunicator::progress() const {
  return std::accumulate(state_->shares.begin(), state_->shares.end(), 0.0) /
         static_cast<double>(state_->shares.size());
}

void MpiCommunicator::announceFailure() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->sent.failed = 1;
  for (int other = 0; other < size(); ++other)
    if (other != rank()) state_->control.send(other, kFailure, 1);
}

bool MpiCommunicator::conclude(const std::exception_ptr& failure) {
  if (!State::waitForAll(state_->ending, failure ? kPatience : -1.0)) return false;
  for (const std::string& one : gatherAll(failure ? encodeFailure(failure) : std::string()))
    if (!one.empty()) throwFailure(one);
  return true;
}

void MpiCommunicator::abort(int status) {
  MPI_Abort(state_->world, status);
  std::abort();
}

}  // namespace pcl_als
