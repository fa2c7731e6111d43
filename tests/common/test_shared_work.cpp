// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include <pcl_als/common/folder_communicator.h>
#include <pcl_als/common/shared_work.h>

#include "test_files.h"

namespace pcl_als {
namespace {

/// Runs a job in processes that are threads of this program; the messages of its exceptions by
/// rank.
std::vector<std::string> runAmong(int size, const std::function<void(Communicator&)>& job) {
  const std::filesystem::path folder = test::scratch("processes");
  std::vector<std::string> messages(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank) {
    threads.emplace_back([&, rank] {
      FolderCommunicator process(folder, rank, size);
      std::exception_ptr failure;
      try {
        job(process);
      } catch (...) {
        failure = std::current_exception();
      }
      try {
        process.conclude(failure);
      } catch (const std::exception& error) {
        messages[static_cast<std::size_t>(rank)] = error.what();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(std::filesystem::is_empty(folder));
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
  runAmong(2, [](Communicator& process) {
    const SharedItems items(&process, std::vector<double>{1.0, 5.0, 2.0, 2.0});
    EXPECT_EQ(items.owner(1), 0);  // 5 against 2 + 2 + 1
    for (const std::size_t item : {0, 2, 3}) EXPECT_EQ(items.owner(item), 1);
  });
  EXPECT_EQ(SharedItems(nullptr, std::vector<double>{1.0, 2.0}).ownItems().size(), 2U);
}

TEST(SharedWork, GivesAllResultsToAllProcesses) {
  const auto messages = runAmong(3, [](Communicator& process) {
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
  const auto messages = runAmong(3, [](Communicator& process) {
    const ProgressCallback callback = sharedProgress(&process, {});
    try {
      doTogether(&process, [&] {
        if (process.rank() == 1) throw InputError("file 7 is damaged", Hint::strips);
        ProgressReport progress(callback);  // the others work until they are told
        for (;;) progress.advance(0.1);
      });
    } catch (const InputError& error) {
      EXPECT_EQ(error.hint(), Hint::strips);
      throw;
    }
  });
  EXPECT_EQ(messages, std::vector<std::string>(3, "file 7 is damaged"));
}

/// Four shares of different size: the root reports their mean, 0.5.
TEST(SharedWork, OnlyTheRootReportsProgress) {
  std::atomic<bool> seen{false};
  std::atomic<int> calls_of_others{0};
  const auto messages = runAmong(4, [&](Communicator& process) {
    ProgressReport progress(sharedProgress(&process, [&](const JobProgress& now) {
      if (!process.isRoot()) ++calls_of_others;
      if (now.event == JobProgress::Event::advance && now.fraction == 0.5) seen = true;
      return true;
    }));
    progress.begin("Writing");
    doTogether(&process, [&] {
      const auto start = std::chrono::steady_clock::now();
      while (!seen && std::chrono::steady_clock::now() - start < std::chrono::seconds(30)) {
        progress.advance(0.125 + 0.25 * process.rank());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  });
  EXPECT_EQ(messages, std::vector<std::string>(4));
  EXPECT_TRUE(seen);
  EXPECT_EQ(calls_of_others, 0);
}

TEST(FolderCommunicator, GivesEachProcessTheBytesForIt) {
  const auto messages = runAmong(3, [](Communicator& process) {
    for (int round = 0; round < 4; ++round) {
      std::vector<std::string> sent;
      for (int to = 0; to < 3; ++to)
        sent.push_back(
            std::string(1 << (4 * round), static_cast<char>('a' + 3 * process.rank() + to)));
      const std::vector<std::string> received = process.exchange(sent);
      for (int from = 0; from < 3; ++from)
        EXPECT_EQ(
            received[static_cast<std::size_t>(from)],
            std::string(1 << (4 * round), static_cast<char>('a' + 3 * from + process.rank())));
    }
  });
  EXPECT_EQ(messages, std::vector<std::string>(3));
}

/// One that fails between two messages, of which the others wait for the second.
TEST(FolderCommunicator, TellsOthersOfAFailureWhereverTheyWait) {
  const auto messages = runAmong(3, [](Communicator& process) {
    process.gatherAll("first");
    if (process.rank() == 2) throw UsageError("no pair is left");
    process.gatherAll("second");
  });
  EXPECT_EQ(messages, std::vector<std::string>(3, "no pair is left"));
}

/// A process that ends without conclude(), as one that is killed.
TEST(FolderCommunicator, DoesNotWaitForALostProcess) {
  const std::filesystem::path folder = test::scratch("processes");
  constexpr std::chrono::seconds kPatience(4);
  FolderCommunicator first(folder, 0, 2, kPatience);
  { const FolderCommunicator second(folder, 1, 2, kPatience); }
  try {
    first.gatherAll("anything");
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("process 2 of 2 has not answered for 4 s"),
              std::string::npos);
  }
}

TEST(FolderCommunicator, RefusesAnotherNumberOfProcesses) {
  const std::filesystem::path folder = test::scratch("number_of_processes");
  FolderCommunicator first(folder, 0, 3), second(folder, 1, 2);
  EXPECT_NE(test::messageOf<UsageError>([&] {
              first.gatherAll("anything");
            }).find("process 2 of 3 was started as one of 2"),
            std::string::npos);
}

TEST(FolderCommunicator, RefusesTheFolderOfAnotherRun) {
  const std::filesystem::path folder = test::scratch("processes");
  { const FolderCommunicator process(folder, 0, 2); }
  EXPECT_THROW(FolderCommunicator(folder, 0, 2), InputError);
  const std::filesystem::path file = folder / "file";
  std::ofstream(file) << "no folder";
  EXPECT_THROW(FolderCommunicator(file, 0, 2), InputError);
  EXPECT_THROW(FolderCommunicator(folder, 2, 2), UsageError);
}

}  // namespace
}  // namespace pcl_als
