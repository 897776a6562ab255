#include "core/gap/fit/interruptible.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "core/gap/fit/parallel.h"
#include "core/sim/worker_pool.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

/// Longer than between two questions.
void work() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(150);
  while (std::chrono::steady_clock::now() < end) {
  }
}

TEST(Interruptible, EndsAWaitForWorkersThatNeverAnswer) {
  int asked = 0;
  const Interruptible interruptible([&] { return ++asked < 2; });
  const auto never = [](std::size_t) -> std::vector<double> {
    for (;;) pause();
  };
  EXPECT_THROW(parallel(2, 2, never), Cancelled);
  EXPECT_EQ(asked, 2);
}

TEST(Interruptible, EndsWorkInTheMidstOfAJob) {
  int asked = 0;
  const Interruptible interruptible([&] { return ++asked < 2; });
  const auto endless = [](std::size_t) -> std::vector<double> {
    for (;;) Interruptible::ask();
  };
  EXPECT_THROW(parallel(1, 1, endless), Cancelled);
  EXPECT_EQ(asked, 2);
}

TEST(Interruptible, LeavesWorkersAlone) {
  const Interruptible interruptible([] { return !WorkerPool::inWorker(); });
  const auto numbers = parallel(2, 2, [](std::size_t i) -> std::vector<double> {
    work();
    Interruptible::ask();
    return {static_cast<double>(i)};
  });
  ASSERT_TRUE(numbers[0].ok() && numbers[1].ok());
  EXPECT_EQ(numbers[1].numbers[0], 1);
}

TEST(Interruptible, AsksTheInnermostThatLives) {
  const Interruptible outer([] { return false; });
  {
    int asked = 0;
    const Interruptible inner([&] { return ++asked > 0; });
    work();
    Interruptible::ask();
    EXPECT_EQ(asked, 1);
  }
  work();
  EXPECT_THROW(Interruptible::ask(), Cancelled);
}

TEST(Interruptible, IsNotAskedByWhatNobodyWaitsFor) { EXPECT_NO_THROW(Interruptible::ask()); }

}  // namespace
}  // namespace btr
