#include "core/gap/search/step_guard.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace btr {
namespace {

TEST(StepGuard, PutsBackWhatWasThereBefore) {
  double step_s = 0.001;
  {
    StepGuard guard(step_s, 0.0005);
    EXPECT_EQ(step_s, 0.0005);
    guard.set(0.00025);
    EXPECT_EQ(step_s, 0.00025);
    EXPECT_EQ(guard.before_s(), 0.001);
  }
  EXPECT_EQ(step_s, 0.001);
}

TEST(StepGuard, PutsItBackWhenAnExceptionLeaves) {
  double step_s = 0.001;
  const auto work = [&] {
    const StepGuard guard(step_s, 0.0005);
    throw std::runtime_error("a fit that the scene refuses");
  };
  EXPECT_THROW(work(), std::runtime_error);
  EXPECT_EQ(step_s, 0.001);
}

TEST(StepGuard, AStepThatIsKeptStays) {
  double step_s = 0.001;
  {
    StepGuard guard(step_s);
    guard.set(0.0005);
    guard.keep();
  }
  EXPECT_EQ(step_s, 0.0005);
}

// A part keeps the step that it needs; whoever called it may still take it back.
TEST(StepGuard, AnOuterGuardTakesBackWhatAnInnerOneKept) {
  double step_s = 0.001;
  {
    const StepGuard outer(step_s);
    StepGuard(step_s, 0.00025).keep();
    EXPECT_EQ(step_s, 0.00025);
  }
  EXPECT_EQ(step_s, 0.001);
}

}  // namespace
}  // namespace btr
