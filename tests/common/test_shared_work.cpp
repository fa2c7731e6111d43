// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <condition_variable>
#include <thread>

#include <gtest/gtest.h>

#include <pcl_als/common/shared_work.h>

namespace pcl_als {
namespace {

/// Processes that are threads of this program.
class Ranks {
 public:
  explicit Ranks(int size) : size_(size), slots_(static_cast<std::size_t>(size)) {}

  /// Runs a job in each process; the messages of its exceptions by rank.
  std::vector<std::string> run(const std::function<void(Communicator&)>& job);

 private:
  friend class Rank;
  std::vector<std::string> gather(int rank, const std::string& bytes) {
    std::unique_lock<std::mutex> lock(mutex_);
    slots_[static_cast<std::size_t>(rank)] = bytes;
    wait(lock);
    std::vector<std::string> all = slots_;
    wait(lock);
    return all;
  }
  void wait(std::unique_lock<std::mutex>& lock) {
    const int round = round_;
    if (++waiting_ == size_) {
      waiting_ = 0;
      ++round_;
      all_here_.notify_all();
    }
    all_here_.wait(lock, [&] { return round_ != round; });
  }

  int size_, waiting_ = 0, round_ = 0;
  std::vector<std::string> slots_;
  std::atomic<int> failures_{0};
  std::mutex mutex_;
  std::condition_variable all_here_;
};

class Rank : public Communicator {
 public:
  Rank(Ranks& all, int rank) : all_(all), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return all_.size_; }
  std::vector<std::string> gatherAll(const std::string& bytes) override {
    return all_.gather(rank_, bytes);
  }
  std::vector<std::string> exchange(const std::vector<std::string>& bytes) override {
    const std::vector<std::string> all = gatherAll(ByteWriter().put(bytes).take());
    std::vector<std::string> received;
    for (const std::string& one : all)
      received.push_back(
          ByteReader(one).take<std::vector<std::string>>()[static_cast<std::size_t>(rank_)]);
    return received;
  }
  void beginPart() override {}
  void endPart() override { gatherAll({}); }
  bool advance(double) override { return failed_ || all_.failures_ == 0; }
  double progress() const override { return 0.5; }
  void announceFailure() override {
    failed_ = true;
    ++all_.failures_;
  }

 private:
  Ranks& all_;
  int rank_;
  bool failed_ = false;
};

std::vector<std::string> Ranks::run(const std::function<void(Communicator&)>& job) {
  std::vector<std::string> messages(static_cast<std::size_t>(size_));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size_; ++rank) {
    threads.emplace_back([&, rank] {
      Rank process(*this, rank);
      try {
        job(process);
      } catch (const std::exception& error) {
        messages[static_cast<std::size_t>(rank)] = error.what();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return messages;
}

TEST(ByteStream, GivesBackWhatWasWritten) {
  const std::vector<std::string> words{"", "abc"};
  const Eigen::Vector3d place(1.0, -2.0, 3.5);
  const std::string bytes =
      ByteWriter().put(7).put(words).put(place).put(std::vector<double>{0.25}).take();
  ByteReader in(bytes);
  EXPECT_EQ(in.take<int>(), 7);
  EXPECT_EQ(in.take<std::vector<std::string>>(), words);
  EXPECT_EQ(in.take<Eigen::Vector3d>(), place);
  EXPECT_EQ(in.take<std::vector<double>>(), std::vector<double>{0.25});
  EXPECT_TRUE(in.done());
  EXPECT_THROW(in.take<int>(), InputError);
}

TEST(SharedItems, GiveTheMostExpensiveItemsFirst) {
  Ranks(2).run([](Communicator& process) {
    const SharedItems items(&process, std::vector<double>{1.0, 5.0, 2.0, 2.0});
    EXPECT_EQ(items.owner(1), 0);  // 5 against 2 + 2 + 1
    for (const std::size_t item : {0, 2, 3}) EXPECT_EQ(items.owner(item), 1);
  });
  EXPECT_EQ(SharedItems(nullptr, std::vector<double>{1.0, 2.0}).ownItems().size(), 2U);
}

TEST(SharedWork, GivesAllResultsToAllProcesses) {
  const auto messages = Ranks(3).run([](Communicator& process) {
    const SharedItems items(&process, std::vector<double>(10, 1.0));
    std::vector<int> squares(10, -1);
    for (const std::size_t item : items.ownItems()) squares[item] = static_cast<int>(item * item);
    shareValues(
        &process, items, squares, [](ByteWriter& out, int value) { out.put(value); },
        [](ByteReader& in, int& value) { in.get(value); });
    for (int i = 0; i < 10; ++i) EXPECT_EQ(squares[static_cast<std::size_t>(i)], i * i);
  });
  EXPECT_EQ(messages, std::vector<std::string>(3));
}

TEST(SharedWork, FailureOfOneIsThatOfAll) {
  const auto messages = Ranks(3).run([](Communicator& process) {
    const ProgressCallback callback = sharedProgress(&process, {});
    try {
      doTogether(&process, [&] {
        if (process.rank() == 1) throw InputError("file 7 is damaged", Remedy::strips);
        ProgressReport progress(callback);  // the others work until they are told
        for (;;) progress.advance(0.1);
      });
    } catch (const InputError& error) {
      EXPECT_EQ(error.remedy(), Remedy::strips);
      throw;
    }
  });
  EXPECT_EQ(messages, std::vector<std::string>(3, "file 7 is damaged"));
}

TEST(SharedWork, OnlyTheRootReportsProgress) {
  std::atomic<int> calls{0};
  Ranks(4).run([&calls](Communicator& process) {
    ProgressReport progress(sharedProgress(&process, [&calls](const JobProgress& now) {
      ++calls;
      return now.event != JobProgress::Event::advance || now.fraction == 0.5;
    }));
    progress.begin("Writing");
    progress.advance(0.25);  // the root reports the mean of all
  });
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace pcl_als
