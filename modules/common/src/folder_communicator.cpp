// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/folder_communicator.h>
#include <pcl_als/common/shared_work.h>

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kShortestPause = std::chrono::milliseconds(2);   // between looks for a message
constexpr auto kLongestPause = std::chrono::milliseconds(200);  // after a long wait
constexpr auto kLook = std::chrono::milliseconds(500);          // between looks for failures
constexpr auto kHeartbeat = std::chrono::seconds(2);            // between two heartbeats
constexpr auto kDeparture =
    std::chrono::seconds(10);  // of the other processes, for which the first one waits

/// Beginnings of the names of the files of a job.
constexpr std::array<const char*, 6> kKinds{"process-", "heartbeat-", "message",
                                            "failure",  "end-",       "left-"};

bool readWhole(const fs::path& path, std::string& bytes) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  std::ostringstream all;
  all << file.rdbuf();
  bytes = std::move(all).str();
  return true;
}

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

void removeFile(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

struct FolderCommunicator::State {
  /// What another process last told of itself.
  struct Heartbeat {
    std::string text;
    Clock::time_point since = Clock::now();  ///< that it has been this text
    bool begun = false;
    int size = 0;        ///< number of processes that it was started with
    double share = 0.0;  ///< of its part that is done
  };

  State(fs::path where, int number, int count, std::chrono::seconds wait)
      : folder(std::move(where)),
        rank(number),
        size(count),
        patience(wait),
        heartbeats(static_cast<std::size_t>(count)) {}

  fs::path file(const std::string& kind, int of) const {
    return folder / (kind + "-" + std::to_string(of + 1));
  }
  fs::path message(std::uint64_t number, int from) const {
    return file("message" + std::to_string(number), from);
  }
  std::string name(int of) const {
    return "process " + std::to_string(of + 1) + " of " + std::to_string(size);
  }

  void begin();
  void beat();
  /// Waits for a message of another process and reads it.
  std::string await(const fs::path& path, int from);
  /// Throws where a process failed, or where the one that is awaited has ended or lost its
  /// heartbeat.
  void checkOthers(int awaited, bool ended);
  void readHeartbeat(int other);
  /// Waits for what ended another process; not for one that has not begun or has been lost.
  void awaitEnd(int other, std::string& end);
  void stopHeartbeat();
  /// Removes all files of the job, once all other processes have left it.
  void removeFiles() const;
  /// All messages of one number have arrived: so have all of those before at all processes.
  void finishMessage(const fs::path& own);

  fs::path folder;
  int rank, size;
  std::chrono::seconds patience;
  std::uint64_t messages = 0, parts = 0;
  fs::path kept;  ///< message of this process that others may still read
  bool in_part = false, others_failed = false;
  double share = 0.0;
  std::vector<Heartbeat> heartbeats;
  Clock::time_point last_look;
  std::uint64_t beats = 0;
  mutable std::mutex mutex;
  std::condition_variable wake;
  bool ends = false;
  std::thread beating;
};

void FolderCommunicator::State::begin() {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string() + ": is no folder and cannot be made");
  const fs::path mark = file("process", rank);
  std::FILE* const made = std::fopen(mark.c_str(), "wx");
  if (made == nullptr && isThere(mark))
    throw InputError(folder.string() + ": holds files of " + name(rank) +
                     " of another run: give each job a new folder, or empty this one");
  if (made == nullptr) throw InputError(mark.string() + ": cannot be written");
  std::fclose(made);
  beat();
  beating = std::thread([this] {
    std::unique_lock<std::mutex> lock(mutex);
    while (!wake.wait_for(lock, kHeartbeat, [this] { return ends; })) {
      try {
        beat();
      } catch (const InputError&) {
        // The next message of this process meets the same error, and reports it.
        continue;
      }
    }
  });
}

void FolderCommunicator::State::beat() {
  std::ostringstream text;
  text << ++beats << ' ' << size << ' ' << parts << ' ' << share;
  writeFile(file("heartbeat", rank), text.str());
}

void FolderCommunicator::State::readHeartbeat(int other) {
  Heartbeat& heartbeat = heartbeats[static_cast<std::size_t>(other)];
  std::string text;
  if (!readWhole(file("heartbeat", other), text) || text == heartbeat.text) return;
  heartbeat.begun = true;
  heartbeat.text = text;
  heartbeat.since = Clock::now();
  std::istringstream values(text);
  std::uint64_t count = 0, part = 0;
  values >> count >> heartbeat.size >> part >> heartbeat.share;
  if (part != parts) heartbeat.share = part > parts ? 1.0 : 0.0;
}

void FolderCommunicator::State::checkOthers(int awaited, bool ended) {
  std::string failure;
  for (int other = 0; other < size; ++other)
    if (other != rank && readWhole(file("end", other), failure) && !failure.empty())
      throwFailure(failure);
  if (ended)
    throw InputError(folder.string() + ": " + name(awaited) +
                     " has ended, with another job than this process");
  const std::lock_guard<std::mutex> lock(mutex);
  readHeartbeat(awaited);
  const Heartbeat& heartbeat = heartbeats[static_cast<std::size_t>(awaited)];
  if (heartbeat.begun && heartbeat.size != size)
    throw UsageError(folder.string() + ": " + name(awaited) + " was started as one of " +
                     std::to_string(heartbeat.size));
  if (!heartbeat.begun || Clock::now() - heartbeat.since < patience) return;
  throw InputError(folder.string() + ": " + name(awaited) + " has not answered for " +
                   std::to_string(patience.count()) +
                   " s: start all processes again, with a new folder");
}

std::string FolderCommunicator::State::await(const fs::path& path, int from) {
  auto pause = std::chrono::duration_cast<std::chrono::milliseconds>(kShortestPause);
  Clock::time_point checked = Clock::now();
  for (std::string bytes;;) {
    if (readWhole(path, bytes)) return bytes;
    if (Clock::now() - checked > kLook) {
      checked = Clock::now();
      const bool ended = isThere(file("end", from));  // what it sent was there before
      if (readWhole(path, bytes)) return bytes;
      checkOthers(from, ended);
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLongestPause);
  }
}

void FolderCommunicator::State::finishMessage(const fs::path& own) {
  if (!kept.empty()) removeFile(kept);
  kept = own;
}

void FolderCommunicator::State::awaitEnd(int other, std::string& end) {
  while (!readWhole(file("end", other), end)) {
    readHeartbeat(other);
    const Heartbeat& heartbeat = heartbeats[static_cast<std::size_t>(other)];
    // One that begins later finds the failure.
    if (!heartbeat.begun || Clock::now() - heartbeat.since > patience) return;
    std::this_thread::sleep_for(kLongestPause);
  }
}

void FolderCommunicator::State::stopHeartbeat() {
  {
    const std::lock_guard<std::mutex> lock(mutex);
    ends = true;
  }
  wake.notify_all();
  if (beating.joinable()) beating.join();
}

void FolderCommunicator::State::removeFiles() const {
  const Clock::time_point start = Clock::now();
  for (int other = 0; other < size; ++other) {
    while (!isThere(file("left", other))) {
      if (Clock::now() - start > kDeparture) return;
      std::this_thread::sleep_for(kShortestPause);
    }
  }
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    for (const char* const kind : kKinds)
      if (name.compare(0, std::strlen(kind), kind) == 0) files.push_back(entry.path());
  }
  for (const fs::path& path : files) removeFile(path);
}

FolderCommunicator::FolderCommunicator(fs::path folder, int rank, int size,
                                       std::chrono::seconds patience) {
  if (size < 1 || rank < 0 || rank >= size)
    throw UsageError("processes: " + std::to_string(rank + 1) + " is not one of " +
                     std::to_string(size));
  state_ = std::make_unique<State>(std::move(folder), rank, size, patience);
  state_->begin();
}

FolderCommunicator::~FolderCommunicator() {
  state_->stopHeartbeat();
}

int FolderCommunicator::rank() const {
  return state_->rank;
}

int FolderCommunicator::size() const {
  return state_->size;
}

std::vector<std::string> FolderCommunicator::gatherAll(const std::string& bytes) {
  State& s = *state_;
  const std::uint64_t number = ++s.messages;
  const fs::path own = s.message(number, s.rank);
  writeFile(own, bytes);
  std::vector<std::string> all(static_cast<std::size_t>(s.size));
  for (int from = 0; from < s.size; ++from)
    all[static_cast<std::size_t>(from)] =
        from == s.rank ? bytes : s.await(s.message(number, from), from);
  s.finishMessage(own);
  return all;
}

std::vector<std::string> FolderCommunicator::exchange(const std::vector<std::string>& bytes) {
  State& s = *state_;
  const std::uint64_t number = ++s.messages;
  const auto between = [&](int from, int to) {
    return fs::path(s.message(number, from).string() + ".to." + std::to_string(to + 1));
  };
  for (int to = 0; to < s.size; ++to)
    if (to != s.rank) writeFile(between(s.rank, to), bytes[static_cast<std::size_t>(to)]);
  std::vector<std::string> received(static_cast<std::size_t>(s.size));
  for (int from = 0; from < s.size; ++from) {
    if (from == s.rank) {
      received[static_cast<std::size_t>(from)] = bytes[static_cast<std::size_t>(from)];
      continue;
    }
    received[static_cast<std::size_t>(from)] = s.await(between(from, s.rank), from);
    removeFile(between(from, s.rank));
  }
  s.finishMessage({});
  return received;
}

void FolderCommunicator::beginPart() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  ++state_->parts;
  state_->in_part = true;
  state_->others_failed = false;
  state_->share = 0.0;
}

void FolderCommunicator::endPart() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->in_part = false;
  state_->share = 1.0;
}

bool FolderCommunicator::advance(double fraction) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  State& s = *state_;
  s.share = fraction;
  const Clock::time_point now = Clock::now();
  if (!s.in_part || s.others_failed || now - s.last_look < kLook) return !s.others_failed;
  s.last_look = now;
  for (int other = 0; other < s.size; ++other) {
    if (other == s.rank) continue;
    if (s.rank == 0) s.readHeartbeat(other);
    s.others_failed = s.others_failed ||
                      isThere(s.file("failure" + std::to_string(s.parts), other)) ||
                      isThere(s.file("end", other));
  }
  return !s.others_failed;
}

double FolderCommunicator::progress() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  double sum = state_->share;
  for (int other = 0; other < state_->size; ++other)
    if (other != state_->rank) sum += state_->heartbeats[static_cast<std::size_t>(other)].share;
  return sum / state_->size;
}

void FolderCommunicator::announceFailure() {
  writeFile(state_->file("failure" + std::to_string(state_->parts), state_->rank), {});
}

bool FolderCommunicator::conclude(const std::exception_ptr& failure) {
  State& s = *state_;
  std::vector<std::string> ends(static_cast<std::size_t>(s.size));
  ends[static_cast<std::size_t>(s.rank)] = failure ? encodeFailure(failure) : std::string();
  writeFile(s.file("end", s.rank), ends[static_cast<std::size_t>(s.rank)]);
  for (int other = 0; other < s.size; ++other)
    if (other != s.rank) s.awaitEnd(other, ends[static_cast<std::size_t>(other)]);
  s.stopHeartbeat();
  writeFile(s.file("left", s.rank), {});
  if (s.rank == 0) s.removeFiles();
  for (const std::string& end : ends)
    if (!end.empty()) throwFailure(end);
  return true;
}

}  // namespace pcl_als
