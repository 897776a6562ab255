// The reduced complementarity problem against ODE's own solver.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/sim/engine/lcp_box.h"
#include "core/sim/engine/lcp_hook.h"
#include "core/sim/engine/lcp_solver.h"
#include "core/sim/trial.h"
#include "core/sim/trot.h"
#include "core/spec/random.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

/// Restores the hook whatever a test did to it.
struct HookGuard {
  LcpHook& hook = LcpHook::ofThisThread();
  HookGuard() { hook = LcpHook{}; }
  ~HookGuard() { hook = LcpHook{}; }
};

// A random tree of links with all kinds of joints, drives and friction, dropped on the floor among balls.
Scene randomScene(std::uint64_t seed, int fewest = 3, int most = 14) {
  Random random(seed);
  RobotModel model;
  model.name = "tree";
  const auto small = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  const int count = fewest + static_cast<int>(random.below(static_cast<std::uint64_t>(most - fewest + 1)));
  std::vector<Drive> drives;
  for (int i = 0; i < count; ++i) {
    Shape shape = random.chance(0.5) ? sphere(0.03) : box({0.05, 0.04, 0.06});
    if (random.chance(0.2)) {
      shape.kind = Shape::Kind::cylinder;
      shape.size_m << 0.02, 0.08, 0;
    }
    model.links.push_back(
        link("link" + std::to_string(i), random.uniform(0.05, 0.5), small(0.01), {2e-4, 3e-4, 4e-4}, {shape}));
    if (i == 0) continue;
    const auto type = random.chance(0.15)  ? Joint::Type::slide
                      : random.chance(0.1) ? Joint::Type::fixed
                                           : Joint::Type::rotate;
    Joint made = joint("joint" + std::to_string(i), static_cast<int>(random.below(static_cast<std::uint64_t>(i))),
                       (small(1) + Eigen::Vector3d(0, 0, 1e-3)).normalized(), small(0.1), type);
    made.lower = -0.8;
    made.upper = 0.8;
    model.joints.push_back(made);
    Drive drive{.p = random.uniform(0, 10), .d = random.uniform(0.001, 0.1), .maxTorque = random.uniform(0.05, 2)};
    if (random.chance(0.2)) drive.kind = Drive::Kind::none;
    if (random.chance(0.3)) drive.coulombFriction = 0.05;
    if (random.chance(0.3)) drive.viscousFriction = 0.01;
    drives.push_back(drive);
  }
  Scene scene = sceneOf(robot(std::move(model), random.chance(0.8)), random.chance(0.5) ? 0.004 : 0.001);
  scene.robots[0].drives = drives;
  scene.robots[0].start.translation().z() = 0.25;
  scene.floor = FloorSpec{.friction = random.uniform(0.1, 1.5)};
  if (random.chance(0.3)) scene.floor->slip1_m_s_n = scene.floor->slip2_m_s_n = 0.01;
  for (int i = 0; i < 2; ++i) {
    BallSpec ball;
    ball.name = "ball" + std::to_string(i);
    ball.position_m = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.2};
    ball.rollingDeceleration_m_s2 = 0.4;
    scene.balls.push_back(ball);
  }
  return scene;
}

TEST(LcpReducer, AgreesWithOdeOnThousandsOfRandomProblems) {
  HookGuard guard;
  guard.hook.compare = true;
  long steps = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const Scene scene = randomScene(seed);
    World world(scene, seed);
    Random random(seed + 1000);
    for (int period = 0; period < 20 && world.fault().empty(); ++period, ++steps) {
      auto inputs = commands(scene, 0);
      for (auto& input : inputs[0]) input.command = random.uniform(-1, 1);
      world.advance(inputs, 0.008);
    }
  }
  EXPECT_GT(guard.hook.reduced, 5000) << steps;
  EXPECT_LT(guard.hook.worst, 1e-6);
  EXPECT_GT(guard.hook.small, 1000);
  EXPECT_EQ(0, guard.hook.whole);
}

// Humanoids with fingers have fifty joints and more.
TEST(LcpReducer, AgreesWithOdeOnRobotsOfFiftyJoints) {
  HookGuard guard;
  guard.hook.compare = true;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scene scene = randomScene(seed, 40, 55);
    World world(scene, seed);
    Random random(seed + 1000);
    for (int period = 0; period < 4 && world.fault().empty(); ++period) {
      auto inputs = commands(scene, 0);
      for (auto& input : inputs[0]) input.command = random.uniform(-1, 1);
      world.advance(inputs, 0.008);
    }
  }
  EXPECT_GT(guard.hook.reduced, 40);
  EXPECT_LT(guard.hook.worst, 1e-6);
}

Scene walkScene() {
  SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  spec.step_s = 0.004;
  Scene scene = makeScene(spec, loadModels(spec), {}, {});
  Trot{}.arrange(scene, {});
  return scene;
}

TEST(LcpReducer, TakesPartInEveryStepOfAWalkAndAgreesWithOde) {
  HookGuard guard;
  guard.hook.compare = true;
  runTrial(walkScene(), Trot{}, {{"duration_s", 2}}, {}, 1);
  EXPECT_GE(guard.hook.reduced, 500);
  EXPECT_LT(guard.hook.worst, 1e-9);
}

TEST(LcpReducer, ASmoothTrialEndsAtTheSamePlaceWithAndWithoutIt) {
  HookGuard guard;
  Eigen::Vector3d ends[2];
  for (const bool reduce : {false, true}) {
    guard.hook = LcpHook{};
    guard.hook.reduce = reduce;
    guard.hook.coulomb = false;
    ends[reduce] = runTrial(walkScene(), Trot{}, {{"duration_s", 1}}, {}, 1).baseEnd_m;
    EXPECT_EQ(reduce, guard.hook.reduced > 0);
  }
  EXPECT_LT((ends[0] - ends[1]).norm(), 1e-5);
}

// A problem in ODE's layout with every row unbounded.
struct Problem {
  unsigned n;
  std::vector<double> a, bx, loHi;
  std::vector<int> findex;
  explicit Problem(unsigned size) : n(size), a(size * size, 0), bx(2 * size, 1), loHi(2 * size), findex(size, -1) {
    for (unsigned i = 0; i < n; ++i) {
      a[i * n + i] = 2;
      loHi[2 * i] = -std::numeric_limits<double>::infinity();
      loHi[2 * i + 1] = std::numeric_limits<double>::infinity();
    }
  }
  LcpProblem view() { return {n, n, a.data(), bx.data(), loHi.data(), findex.data()}; }
};

void expectSolvedAlone(unsigned n) {
  Problem problem(n);
  Random random(3);
  // A = G·Gᵀ + 1, banded, known x.
  std::vector<double> wanted(n);
  for (unsigned i = 0; i < n; ++i) {
    wanted[i] = random.normal();
    for (unsigned j = i < 7 ? 0 : i - 7; j < i; ++j) problem.a[i * n + j] = 0.1 * random.normal();
  }
  for (unsigned i = 0; i < n; ++i) {
    double sum = 0;
    for (unsigned j = 0; j < n; ++j) sum += problem.a[std::max(i, j) * n + std::min(i, j)] * wanted[j];
    problem.bx[2 * i] = sum;
  }
  LcpReducer reducer;
  ASSERT_TRUE(reducer.reduce(problem.view()));
  EXPECT_EQ(0u, reducer.small().n);
  reducer.expand(problem.view());
  for (unsigned i = 0; i < n; ++i) EXPECT_NEAR(wanted[i], problem.bx[2 * i + 1], 1e-12);
}

TEST(LcpReducer, SolvesAProblemWithoutBoundsByItself) {
  for (const unsigned n : {24u, 6 * 32u, 6 * 33u, 6 * 64u}) {
    SCOPED_TRACE(n);
    expectSolvedAlone(n);
  }
}

// A normal force (row 0) and a friction (row 1) that are coupled.
Problem slidingFoot() {
  Problem problem(2);
  problem.a = {2, 1, 1, 2};
  problem.bx = {1, 0, 3, 0};
  problem.loHi = {0, std::numeric_limits<double>::infinity(), -0.5, 0.5};
  problem.findex = {-1, 0};
  return problem;
}

TEST(BoxSolver, FrictionFollowsTheNormalForceThatThereIs) {
  Problem foot = slidingFoot();
  BoxSolver solver;
  ASSERT_TRUE(solver.solve(foot.view(), true));
  // 2N + F = 1 and F = N/2.
  EXPECT_NEAR(0.4, foot.bx[1], 1e-4);
  EXPECT_NEAR(0.2, foot.bx[3], 1e-4);
}

TEST(BoxSolver, OdesBoundsComeFromTheNormalForceWithoutFriction) {
  Problem foot = slidingFoot();
  BoxSolver solver;
  ASSERT_TRUE(solver.solve(foot.view(), false));
  // 2N = 1 gives F = 1/4, and then 2N + 1/4 = 1.
  EXPECT_NEAR(0.375, foot.bx[1], 1e-12);
  EXPECT_NEAR(0.25, foot.bx[3], 1e-12);
}

TEST(BoxSolver, SatisfiesEveryConditionOfRandomBoxes) {
  Random random(11);
  BoxSolver solver;
  for (int trial = 0; trial < 2000; ++trial) {
    const unsigned n = 1 + static_cast<unsigned>(random.below(24));
    Problem problem(n);
    std::vector<double> g(n * n);
    for (double& value : g) value = random.normal();
    for (unsigned i = 0; i < n; ++i) {
      problem.bx[2 * i] = 3 * random.normal();
      problem.loHi[2 * i] = random.chance(0.2) ? -std::numeric_limits<double>::infinity() : -random.uniform();
      problem.loHi[2 * i + 1] = random.chance(0.2) ? std::numeric_limits<double>::infinity() : random.uniform();
      for (unsigned j = 0; j < n; ++j) {
        double sum = i == j ? 0.01 : 0;
        for (unsigned k = 0; k < n; ++k) sum += g[i * n + k] * g[j * n + k];
        problem.a[i * n + j] = sum;
      }
    }
    ASSERT_TRUE(solver.solve(problem.view(), true));
    for (unsigned i = 0; i < n; ++i) {
      double w = -problem.bx[2 * i];
      for (unsigned j = 0; j < n; ++j) w += problem.a[i * n + j] * problem.bx[2 * j + 1];
      const double x = problem.bx[2 * i + 1], low = problem.loHi[2 * i], high = problem.loHi[2 * i + 1];
      EXPECT_GE(x, low - 1e-9);
      EXPECT_LE(x, high + 1e-9);
      EXPECT_TRUE(x <= low + 1e-9 || w <= 1e-6) << w;
      EXPECT_TRUE(x >= high - 1e-9 || w >= -1e-6) << w;
    }
  }
}

TEST(LcpReducer, LeavesUnusualProblemsAlone) {
  LcpReducer reducer;
  Problem few(12);
  EXPECT_FALSE(reducer.reduce(few.view())) << "too small to be worth it";
  Problem indefinite(24);
  indefinite.a[5 * 24 + 5] = -1;
  EXPECT_FALSE(reducer.reduce(indefinite.view()));
  Problem notANumber(24);
  notANumber.a[5 * 24 + 5] = NAN;
  EXPECT_FALSE(reducer.reduce(notANumber.view()));
  Problem hanging(24);
  hanging.findex[20] = 3;
  EXPECT_FALSE(reducer.reduce(hanging.view())) << "a bound that hangs on an unbounded row";
  Problem huge(6 * 65);
  EXPECT_FALSE(reducer.reduce(huge.view()));
}

}  // namespace
}  // namespace btr::test
