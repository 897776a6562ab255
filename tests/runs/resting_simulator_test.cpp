#include "core/run/reality/resting_simulator.h"

#include "core/run/reality/adoption.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

class RestingSimulatorTest : public StoreTest {
 protected:
  /// L3's next version, adapted to these individuals.
  SimulatorRecord adapted(int stage, const std::string& individuals) {
    SimulatorRecord version;
    version.run = run_;
    version.parent = database_.simulators(run_).back().id;
    version.madeBy = "L3";
    version.evidence = R"({"stage": )" + std::to_string(stage) + R"(, "individuals": )" + individuals + "}";
    return database_.simulator(database_.addSimulator(version));
  }
  Database database_ = create();
  Id run_ = startRun(database_);
};

TEST_F(RestingSimulatorTest, NothingRestsOnAValueBeforeL3) {
  EXPECT_FALSE(simulatorRestingOn(database_, run_, 7));
  adapted(1, "[8, 9]");
  EXPECT_FALSE(simulatorRestingOn(database_, run_, 7));
}

TEST_F(RestingSimulatorTest, TheFirstVersionThatSawTheIndividualIsNamedWithItsParent) {
  adapted(1, "[8]");
  adapted(2, "[7, 8]");
  adapted(3, "[7, 8, 9]");
  const auto resting = simulatorRestingOn(database_, run_, 7);
  ASSERT_TRUE(resting);
  EXPECT_EQ(2, resting->number);
  EXPECT_EQ(1, resting->parent);
  EXPECT_EQ(2, resting->stage);
}

TEST_F(RestingSimulatorTest, GoingBackToTheParentEndsIt) {
  adapted(1, "[7]");
  adapted(2, "[7, 8]");
  const int parent = simulatorRestingOn(database_, run_, 7)->parent;
  revertSimulator(database_, run_, parent);
  EXPECT_FALSE(simulatorRestingOn(database_, run_, 7));
}

}  // namespace
}  // namespace btr
