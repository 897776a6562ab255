// A step takes no memory from the system once the world is under way: neither the core nor ODE.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cstdlib>
#include <new>

#include "core/sim/bench/bench.h"
#include "core/sim/trot.h"
#include "core/sim/world.h"

namespace {

// The tests of this program run in one thread; other threads count for themselves.
thread_local long allocations = 0;

[[maybe_unused]] void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}

void* countedForOde(dsizeint size) {
  ++allocations;
  return std::malloc(size);
}

}  // namespace

// The address sanitizer has operators of its own, which it matches with each other.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED_ALLOCATIONS
#endif
#endif
#ifndef SANITIZED_ALLOCATIONS
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace btr::test {
namespace {

/// Restores ODE's own allocator.
struct CountOde {
  dAllocFunction* before = dGetAllocHandler();
  CountOde() { dSetAllocHandler(countedForOde); }
  ~CountOde() { dSetAllocHandler(before); }
};

TEST(Allocations, AWalkingDogsStepMakesNone) {
#ifdef SANITIZED_ALLOCATIONS
  GTEST_SKIP() << "the sanitizer counts them itself";
#endif
  const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  const BenchTask task = walkTask(spec, loadModels(spec));
  const CountOde ode;
  World world(task.scene, 1);
  const auto motion = task.controller->begin(task.scene, task.settings, task.parameters[0]);
  std::vector<std::vector<JointInput>> inputs(1);
  inputs[0].resize(task.scene.robots[0].model.joints.size());
  RobotReadings readings;
  const auto walk = [&](double until) {
    long made = 0;
    while (world.time() < until) {
      world.read(0, readings);
      motion->command(world.time(), readings, inputs[0]);
      const long before = allocations;
      world.advance(inputs, task.scene.controlPeriod_s);
      made += allocations - before;
    }
    return made;
  };
  // In its first paces memory grows to what the gait needs; it is kept from then on.
  EXPECT_GT(walk(5), 0);
  EXPECT_EQ(walk(9), 0);
}

}  // namespace
}  // namespace btr::test
