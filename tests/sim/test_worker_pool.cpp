#include "core/sim/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace {

using btr::WorkerPool;

const std::atomic<bool> goOn{false};

std::vector<std::string> numbers(int count) {
  std::vector<std::string> jobs;
  for (int i = 0; i < count; ++i) jobs.push_back(std::to_string(i));
  return jobs;
}

std::string square(const std::string& job) { return std::to_string(std::stoi(job) * std::stoi(job)); }

// Memory that parent and workers see.
struct Shared {
  std::atomic<int>* counter = static_cast<std::atomic<int>*>(
      mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  Shared() { new (counter) std::atomic<int>(0); }
  ~Shared() { munmap(counter, sizeof *counter); }
};

TEST(WorkerPool, RepliesInTheOrderOfTheJobsForAnyNumberOfWorkers) {
  for (int workers : {1, 2, 4, 7}) {
    WorkerPool pool(workers, square);
    const auto replies = pool.run(numbers(100), goOn);
    ASSERT_EQ(100u, replies.size());
    for (int i = 0; i < 100; ++i) EXPECT_EQ(std::to_string(i * i), replies[static_cast<std::size_t>(i)].bytes);
  }
}

TEST(WorkerPool, CarriesLargeMessagesUnchanged) {
  WorkerPool pool(2, [](const std::string& job) { return job + job; });
  const std::string large(3'000'000, '\0');
  const auto replies = pool.run({large, "x"}, goOn);
  EXPECT_EQ(large + large, replies[0].bytes);
  EXPECT_EQ("xx", replies[1].bytes);
}

TEST(WorkerPool, SaysHowAWorkerDiedAndGoesOnWithTheOthers) {
  WorkerPool pool(2, [](const std::string& job) {
    if (job == "3") kill(getpid(), SIGKILL);
    if (job == "5") _exit(7);
    return square(job);
  });
  const auto replies = pool.run(numbers(10), goOn);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(i != 3 && i != 5, replies[i].ok) << i;
  EXPECT_EQ("the worker died (signal 9)", replies[3].failure);
  EXPECT_EQ("the worker ended (exit code 7)", replies[5].failure);
  EXPECT_EQ("81", pool.run({"9"}, goOn)[0].bytes);
}

TEST(WorkerPool, TriesAJobOnceMoreWhenItsWorkerWasKilled) {
  Shared shared;
  WorkerPool pool(1, [&shared](const std::string& job) {
    if (shared.counter->fetch_add(1) == 0) kill(getpid(), SIGKILL);
    return job;
  });
  const auto replies = pool.run({"only"}, goOn);
  EXPECT_TRUE(replies[0].ok);
  EXPECT_EQ("only", replies[0].bytes);
  EXPECT_EQ(2, shared.counter->load());
}

TEST(WorkerPool, AnExceptionIsAFailureOfItsJobAlone) {
  WorkerPool pool(2, [](const std::string& job) -> std::string {
    if (job == "1") throw std::runtime_error("no such leg");
    return job;
  });
  const auto replies = pool.run(numbers(3), goOn);
  EXPECT_EQ("no such leg", replies[1].failure);
  EXPECT_EQ("2", replies[2].bytes);
}

TEST(WorkerPool, EndsAWorkerThatNeverAnswers) {
  WorkerPool pool(
      2,
      [](const std::string& job) {
        while (job == "0") pause();
        return job;
      },
      0.2);
  const auto replies = pool.run(numbers(3), goOn);
  EXPECT_FALSE(replies[0].ok);
  EXPECT_NE(std::string::npos, replies[0].failure.find("no answer")) << replies[0].failure;
  EXPECT_EQ("1", replies[1].bytes);
}

TEST(WorkerPool, EndsAWorkerThatStopsInTheMiddleOfAnAnswerOrHangsUpAndLivesOn) {
  constexpr int link = 3;  // a worker's end
  WorkerPool pool(
      1,
      [](const std::string& job) -> std::string {
        if (job == "hang up") {
          close(link);
        } else {
          const std::uint64_t size = 100;
          [[maybe_unused]] const ssize_t n = write(link, &size, sizeof size);
        }
        while (true) pause();
      },
      0.2);
  EXPECT_EQ("no answer within 0 s", pool.run({"stop"}, goOn)[0].failure);
  EXPECT_EQ("the worker hung up and did not end", pool.run({"hang up"}, goOn)[0].failure);
}

TEST(WorkerPool, GivesNothingWhenItIsStoppedAndCanBeUsedAgain) {
  WorkerPool pool(2, square);
  std::atomic<bool> stop{false};
  const auto replies = pool.run(numbers(1000), stop, [&](std::size_t done) { stop = done >= 10; });
  EXPECT_TRUE(replies.empty());
  EXPECT_EQ("16", pool.run({"4"}, goOn)[0].bytes);
}

TEST(WorkerPool, CountsFinishedJobsUpToTheirNumber) {
  WorkerPool pool(3, square);
  std::size_t last = 0;
  pool.run(numbers(20), goOn, [&](std::size_t done) { EXPECT_EQ(++last, done); });
  EXPECT_EQ(20u, last);
}

TEST(WorkerPool, TakesJobsWhileOthersAreWorkedOnAndTellsThemByTheirNumbers) {
  WorkerPool pool(2, square);
  for (std::size_t i = 0; i < 5; ++i) pool.add(100 + i, std::to_string(i));
  std::map<std::size_t, std::string> got;
  while (got.size() < 10)
    for (const WorkerPool::Ended& ended : pool.wait(1000)) {
      EXPECT_GE(ended.seconds, 0);
      got[ended.number] = ended.reply.bytes;
      if (ended.number < 105) pool.add(ended.number + 100, std::to_string(ended.number));
    }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(std::to_string(i * i), got[100 + i]);
    EXPECT_EQ(std::to_string((100 + i) * (100 + i)), got[200 + i]);
  }
  EXPECT_TRUE(pool.wait(0).empty());
}

TEST(WorkerPool, WaitsNoLongerThanUntilAFileCanBeRead) {
  int ends[2];
  ASSERT_EQ(0, pipe(ends));
  WorkerPool pool(1, [](const std::string&) -> std::string {
    while (true) pause();
  });
  pool.add(0, "never");
  ASSERT_EQ(1, write(ends[1], "x", 1));
  EXPECT_TRUE(pool.wait(1000000, ends[0]).empty());
  close(ends[0]);
  close(ends[1]);
}

TEST(WorkerPool, TriesAnAddedJobTwiceAndThenSaysHowItsWorkerDied) {
  WorkerPool pool(1, [](const std::string& job) {
    if (job == "die") _exit(7);
    return square(job);
  });
  pool.add(7, "die");
  pool.add(8, "3");
  std::map<std::size_t, WorkerPool::Reply> got;
  while (got.size() < 2)
    for (const WorkerPool::Ended& ended : pool.wait(1000)) got[ended.number] = ended.reply;
  EXPECT_FALSE(got[7].ok);
  EXPECT_EQ("the worker ended (exit code 7)", got[7].failure);
  EXPECT_EQ("9", got[8].bytes);
}

}  // namespace
