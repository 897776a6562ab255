// Hands at either end of a recording: what they did is left out, and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/hands.h"
#include "core/gap/recordings/mapping.h"
#include "core/sim/scene.h"
#include "core/spec/random.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double end_s = 6;

Scene sceneOfJson(const std::string& json) {
  const TemporaryFolder folder;
  folder.write("rod.urdf", R"(<robot name="rod">
    <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="hinge" type="continuous"><parent link="wall"/><child link="bob"/><axis xyz="0 1 0"/></joint>
    <link name="bob"><inertial><origin xyz="0 0 -0.2"/><mass value="0.5"/>
      <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)");
  const SceneSpec spec =
      sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01, )" + json + "}",
                    "scene", folder.file("."));
  return makeScene(spec, loadModels(spec), {}, {});
}

Scene swinger(const std::string& drive = "none") {
  return sceneOfJson(R"("robots": [{"name": "rod", "model": "rod.urdf", "base": "fixed", "position_m": [0, 0, 1],
    "collision": "none", "servos": {"hinge": {"drive": ")" +
                     drive + R"("}}}])");
}

/// Two joints one after the other, without drives.
Scene chain() {
  const TemporaryFolder folder;
  folder.write("chain.urdf", R"(<robot name="chain">
    <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="top" type="continuous"><parent link="wall"/><child link="upper"/><axis xyz="0 1 0"/></joint>
    <link name="upper"><inertial><origin xyz="0 0 -0.1"/><mass value="0.1"/>
      <inertia ixx="3e-4" iyy="3e-4" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="mid" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 -0.2"/><axis xyz="0 1 0"/></joint>
    <link name="lower"><inertial><origin xyz="0 0 -0.08"/><mass value="0.1"/>
      <inertia ixx="2e-4" iyy="2e-4" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)");
  const SceneSpec spec = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01,
    "robots": [{"name": "dp", "model": "chain.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none",
                "servos": {"top": {"drive": "none"}, "mid": {"drive": "none"}}}]})",
                                       "scene", folder.file("."));
  return makeScene(spec, loadModels(spec), {}, {});
}

/// Its joints by time, every 10 ms with noise of 1 mrad.
Recording chainThat(const std::function<double(double)>& top, const std::function<double(double)>& mid,
                    double length_s) {
  Random random(5);
  Recording trial;
  trial.source = "chain.csv";
  trial.channels = {"time_s", "dp.top.position_rad", "dp.mid.position_rad"};
  trial.columns.resize(3);
  for (int i = 0; i < std::lround(length_s / 0.01); ++i) {
    const double t = 0.01 * i;
    trial.columns[0].push_back(t);
    trial.columns[1].push_back(top(t) + 0.001 * random.normal());
    trial.columns[2].push_back(mid(t) + 0.001 * random.normal());
  }
  return trial;
}

/// Acceleration of a joint at angle [rad] and rate [rad/s].
using Law = std::function<double(double, double)>;
/// Where a hand has it at a time, NaN: nowhere.
using Hand = std::function<double(double)>;

double gravityAlone(double q, double rate) { return -40 * std::sin(q) - 0.2 * rate; }

/// Every 10 ms, in counts of 1.5 mrad with noise of 1 mrad; integrated in steps of 0.1 ms.
Recording swung(const Law& law, const Hand& hand) {
  constexpr double step_s = 1e-4, count = 0.0015;
  Random random(11);
  Recording trial;
  trial.source = "swing.csv";
  trial.channels = {"time_s", "rod.hinge.position_rad"};
  trial.columns.resize(2);
  double q = 1.2, rate = 0;
  for (int i = 0; i < std::lround(end_s / step_s); ++i) {
    const double t = i * step_s;
    if (i % 100 == 0) {
      trial.columns[0].push_back(t);
      trial.columns[1].push_back(std::round((q + 0.001 * random.normal()) / count) * count);
    }
    if (const double held = hand(t); std::isfinite(held)) {
      rate = (hand(t + step_s) - held) / step_s;
      if (!std::isfinite(rate)) rate = 0;
      q = held;
      continue;
    }
    rate += step_s * law(q, rate);
    q += step_s * rate;
  }
  return trial;
}

Recording withoutHands(Recording trial, const Scene& scene = swinger()) {
  leaveOutHands(trial, scene, bind(scene, trial));
  return trial;
}

const Hand none = [](double) { return std::nan(""); };

TEST(Hands, ThatHoldOrLiftBeforeTheyLetGoAreLeftOut) {
  constexpr double release_s = 0.37, tenth_s = 0.1;  // of a swing
  const auto until = [](const Hand& hand) {
    return [hand](double t) { return t < release_s ? hand(t) : std::nan(""); };
  };
  for (const Hand& hand : {Hand([](double) { return 1.2; }), Hand([](double t) { return 1.2 + 0.8 * t; }),
                           Hand([](double t) { return 1.2 - 0.5 * std::sin(3 * t); })}) {
    const Recording trial = withoutHands(swung(gravityAlone, until(hand)));
    EXPECT_NEAR(trial.columns[0].front(), release_s, tenth_s);
    EXPECT_GE(trial.columns[0].front(), release_s - 0.02);
    EXPECT_EQ(trial.columns[0].back(), end_s - 0.01);
    EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("s are left out: until then rod.hinge.position_rad does not move")));
  }
}

TEST(Hands, ThatHoldAChainAreLeftOut) {
  constexpr double release_s = 0.31;
  const auto top = [](double t) { return 1.4 * std::cos(6 * std::max(0.0, t - release_s)); };
  const auto mid = [](double t) { return 0.3 + 0.5 * (1 - std::cos(9 * std::max(0.0, t - release_s))); };
  const Recording trial = withoutHands(chainThat(top, mid, 3), chain());
  EXPECT_GE(trial.columns[0].front(), release_s);
  EXPECT_LE(trial.columns[0].front(), release_s + 0.1);
  EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("until then all joints rest, then they move though nothing drives")));
  // One that is let go before the recorder begins, one that moves from the first sample on, and one that leaves an
  // unstable equilibrium by itself.
  const auto later = [&](double t) { return top(t + release_s); };
  EXPECT_EQ(withoutHands(chainThat(later, mid, 3), chain()).rows(), 300u);
  EXPECT_EQ(withoutHands(chainThat([](double t) { return 0.5 * t; }, mid, 3), chain()).rows(), 300u);
  const auto upright = [](double t) { return 3.1416 - 0.002 * std::cosh(6 * std::min(t, 1.2)); };
  EXPECT_EQ(withoutHands(chainThat(
                             upright, [](double) { return 0.0; }, 1.2),
                         chain())
                .rows(),
            120u);
}

TEST(Hands, ThatHoldWhatSwingsOnlyOnceAreLeftOut) {
  Recording trial = swung(gravityAlone, [](double t) { return t < 0.37 ? 1.2 : std::nan(""); });
  for (auto& column : trial.columns) column.resize(90);  // less than three passes
  const Recording left = withoutHands(trial);
  EXPECT_NEAR(left.columns[0].front(), 0.37, 0.1);
  EXPECT_GE(left.columns[0].front(), 0.37);
}

TEST(Hands, ThatCatchAreLeftOut) {
  const Recording whole = swung(gravityAlone, none);
  const Recording trial =
      withoutHands(swung(gravityAlone, [&](double t) { return t > 5.3 ? whole.columns[1][530] : std::nan(""); }));
  EXPECT_EQ(trial.columns[0].front(), 0);
  EXPECT_NEAR(trial.columns[0].back(), 5.3, 0.1);
  EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("the last ")));
}

TEST(Hands, AreNotSeenInFreePhysics) {
  const auto beside = [](const Law& more) {
    return [more](double q, double rate) { return gravityAlone(q, rate) + more(q, rate); };
  };
  for (const Law& more :
       {Law([](double, double) { return 0.0; }), Law([](double, double w) { return -3 * std::copysign(1, w); }),
        Law([](double, double w) { return -0.5 * w * std::abs(w); }),
        Law([](double q, double) { return -20 * q * q * q; }),
        Law([](double q, double) { return -6 * std::exp(-std::pow((q - 1) / 0.1, 2)); }),
        Law([](double q, double) { return std::abs(q) > 1 ? -300 * (q - std::copysign(1, q)) : 0; })}) {
    const Recording trial = withoutHands(swung(beside(more), none));
    EXPECT_EQ(trial.rows(), 600u);
    EXPECT_THAT(trial.notes, IsEmpty());
  }
}

TEST(Hands, AreNoMatterOfDrivenJointsNorOfTrialsWithASpan) {
  const Hand holds = [](double t) { return t < 0.37 ? 1.2 : std::nan(""); };
  EXPECT_EQ(withoutHands(swung(gravityAlone, holds), swinger("servo")).rows(), 600u);
  Recording bounded = swung(gravityAlone, holds);
  bounded.bounded = true;
  EXPECT_EQ(withoutHands(bounded).rows(), 600u);
}

/// A ball that is dropped at 0.2 s from `height_m`, or thrown.
Recording dropped(double height_m, double up_m_s, double release_s) {
  Random random(3);
  Recording trial;
  trial.source = "drop.csv";
  trial.channels = {"time_s", "ball.x_m", "ball.y_m", "ball.z_m"};
  trial.columns.resize(4);
  for (int i = 0; i < 60; ++i) {
    const double t = i / 120.0, free = std::max(0.0, t - release_s);
    trial.columns[0].push_back(t);
    trial.columns[1].push_back(0.3 + 0.001 * random.normal());
    trial.columns[2].push_back(0.001 * random.normal());
    trial.columns[3].push_back(height_m + up_m_s * free - 9.81 / 2 * free * free + 0.001 * random.normal());
  }
  return trial;
}

TEST(Hands, ThatHoldABallAreLeftOut) {
  const Scene scene = sceneOfJson(
      R"("robots": [], "floor": {"friction": 0.5}, "balls": [{"name": "ball", "radius_m": 0.02, "mass_kg": 0.0027, "position_m": [0, 0, 1]}])");
  const Recording fallen = withoutHands(dropped(1.5, 0, 0.2), scene);
  EXPECT_NEAR(fallen.columns[0].front(), 0.2, 0.05);
  EXPECT_THAT(fallen.notes, ElementsAre(HasSubstr("until then the ball rests in the air")));
  EXPECT_EQ(withoutHands(dropped(1.5, 3, 0), scene).rows(), 60u);
  EXPECT_EQ(withoutHands(dropped(1.5, 0, 0), scene).rows(), 60u);
  EXPECT_EQ(withoutHands(dropped(1.5, 0, 10), scene).rows(), 60u);  // it is never let go
}

TEST(Span, CutsATrial) {
  const TemporaryFolder folder;
  const std::string path = folder.write("log.csv", "t,q\n10,1\n10.5,2\n11,3\n11.5,4\n12,5\n");
  const auto read = [&](const std::string& span) {
    const Mapping mapping = mappingFromJson(
        R"({"time_s": {"column": "t"}, "rod.hinge.position_rad": {"column": "q"}, )" + span + "}", "m.json");
    return loadRecording(path, &mapping);
  };
  EXPECT_THAT(read(R"("from_s": 0.5, "until_s": 1.5)").columns[1], ElementsAre(2, 3, 4));
  EXPECT_THAT(read(R"("until_s": 1)").columns[0], ElementsAre(10, 10.5, 11));
  EXPECT_TRUE(read(R"("from_s": 0)").bounded);
  EXPECT_THAT(test::refusal([&] { read(R"("from_s": 2)"); }), HasSubstr("leave less than two rows of its 2 s"));
  EXPECT_THAT(test::refusal([&] { read(R"("from_s": 2, "until_s": 1)"); }), HasSubstr("until_s"));
}

}  // namespace
}  // namespace btr
