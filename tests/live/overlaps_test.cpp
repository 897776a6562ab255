// What hands put into something else is named, with how deep it is, before the next step throws it out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/live/session.h"
#include "tests/live/game_files.h"

namespace btr::test {
namespace {

using Position = std::array<double, 3>;

/// The depth of the only overlap of two names, in whichever order; none: −1.
double depthOf(const Session& session, const std::string& one, const std::string& other) {
  double depth = -1;
  for (const Overlap& overlap : session.world().overlaps(0.01))
    if ((overlap.first == one && overlap.second == other) || (overlap.first == other && overlap.second == one)) {
      EXPECT_EQ(depth, -1) << "told once";
      depth = overlap.depth_m;
    }
  return depth;
}

TEST(Overlaps, AGameThatStandsWellHasNone) {
  Session session(dogs(), host());
  EXPECT_THAT(session.world().overlaps(0.01), testing::IsEmpty());
  run(session, 100);
  EXPECT_THAT(session.world().overlaps(0.01), testing::IsEmpty()) << "paws press in less";
}

TEST(Overlaps, AreAsDeepAsTheyWereMade) {
  Session session(dogs(), host());
  // A ball of 42.5 mm radius, 20 mm in the floor; 30 mm in a crate whose top is at 0.1 m.
  session.apply(PlaceAct{"ball", Position{0, 0.3, 0.0225}});
  EXPECT_NEAR(depthOf(session, "ball", ""), 0.02, 1e-12);
  session.apply(PlaceAct{"ball", Position{0, -0.4, 0.1 + 0.0425 - 0.03}});
  EXPECT_NEAR(depthOf(session, "ball", "crate"), 0.03, 1e-9);
  EXPECT_EQ(depthOf(session, "ball", ""), -1);
  // The crate moves away: nothing is left.
  session.apply(PlaceAct{"crate", Position{0, 1, 0.05}});
  EXPECT_THAT(session.world().overlaps(0.01), testing::IsEmpty());
}

TEST(Overlaps, NameRobotsInOnePlaceAndInTheFloor) {
  Session session(dogs(), host());
  const Eigen::Vector3d red = session.world().robot(0).base.translation();
  session.apply(PlaceAct{"blue1", Position{red.x(), red.y(), red.z()}});
  EXPECT_GT(depthOf(session, "red1", "blue1"), 0.05);
  session.apply(PlaceAct{"blue1", Position{0.6, 0.1, red.z() - 0.04}});
  EXPECT_EQ(depthOf(session, "red1", "blue1"), -1);
  EXPECT_NEAR(depthOf(session, "blue1", ""), 0.04, 0.01);
  const std::vector<Overlap> overlaps = session.world().overlaps(0.01);
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_THAT(overlaps[0].text(), testing::MatchesRegex("blue1 stands .* mm in the floor: it will be pushed out"));
}

// To ask changes nothing. There is one world in a process: one session after the other.
TEST(Overlaps, AskingLeavesTheBitsAsTheyAre) {
  const auto shaOf = [](bool asks) {
    Session session(dogs(), host());
    for (int i = 0; i < 100; ++i) {
      if (asks) session.world().overlaps(0.01);
      session.step();
    }
    return session.traceSha256();
  };
  EXPECT_EQ(shaOf(true), shaOf(false));
}

}  // namespace
}  // namespace btr::test
