// Torques of joints that follow their recorded motion are compared while these turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/followed_rests.h"
#include "tests/gap/scene_of.h"

namespace btr {
namespace rests_of_joints {

/// One joint at 100 Hz: it rests for a second, turns by 0.5 rad/s, rests for `still_s`, turns again.
class FollowedHinge {
 public:
  Recording recordingWith(double still_s, double turning_s = 2) const {
    Recording recording;
    recording.source = "trial.csv";
    recording.channels = {"time_s", "rig.hinge.position_rad", "rig.hinge.torque_nm"};
    recording.columns.resize(3);
    double position = 0;
    const auto add = [&](double lasting_s, double rate) {
      for (int i = 0; i < std::lround(100 * lasting_s); ++i) {
        recording.columns[0].push_back(0.01 * static_cast<double>(recording.columns[0].size()));
        recording.columns[1].push_back(position);
        recording.columns[2].push_back(1);
        position += 0.01 * rate;
      }
    };
    add(1, 0);
    add(turning_s, 0.5);
    add(still_s, 0);
    add(turning_s, -0.5);
    return recording;
  }

  /// How many torques are left, and of which column something was taken.
  std::pair<long, std::vector<std::size_t>> leftOf(Recording recording) const {
    const std::vector<std::size_t> taken = leaveOutRests(recording, bind(scene_, recording), scene_);
    return {std::ranges::count_if(recording.columns[2], [](double x) { return std::isfinite(x); }), taken};
  }

 private:
  Scene scene_ = rigScene(R"("hinge": {"drive": "motion"})");
};

TEST(FollowedRests, ATorqueIsComparedWhileItsJointTurns) {
  const auto [left, taken] = FollowedHinge().leftOf(FollowedHinge().recordingWith(1));
  EXPECT_EQ(taken, std::vector<std::size_t>{2});
  EXPECT_NEAR(static_cast<double>(left), 400, 4);
}

/// 5 Hz are compared below: a step of the torque is seen for three quarters of 0.2 s on either side.
TEST(FollowedRests, WhatAFilterMixesARestIntoIsNotComparedEither) {
  Recording recording = FollowedHinge().recordingWith(1);
  recording.filterPeriod_s = 0.01;
  recording.filterCutoff_hz = 10;
  const auto [left, taken] = FollowedHinge().leftOf(recording);
  EXPECT_NEAR(static_cast<double>(left), 400 - 3 * 15, 6);
  Recording brief = FollowedHinge().recordingWith(0.02);
  brief.filterPeriod_s = 0.01;
  brief.filterCutoff_hz = 10;
  EXPECT_NEAR(static_cast<double>(FollowedHinge().leftOf(brief).first), 400 - 15 - 2 * 3, 8);
}

TEST(FollowedRests, AJointThatHardlyTurnsKeepsWhatItCarries) {
  const auto [left, taken] = FollowedHinge().leftOf(FollowedHinge().recordingWith(10, 0.5));
  EXPECT_TRUE(taken.empty());
  EXPECT_EQ(left, 1200);
}

}  // namespace rests_of_joints
}  // namespace btr
