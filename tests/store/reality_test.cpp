// Iterations of L2 as they are begun and finished.
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;

class Reality : public StoreTest {
 protected:
  void SetUp() override {
    GenerationRecord generation = generationOf(run_, 1, 3, 2);
    db_.addGeneration(generation);
    db_.addMeasurementStage(run_, 1, {{run_, 1, 1, 1, 1.0, 1, false}});
  }
  std::vector<IndividualRecord> policies(int count) const {
    std::vector<IndividualRecord> all;
    for (int i = 0; i < count; ++i) {
      IndividualRecord& policy = all.emplace_back();
      policy.simulator = 1;
      policy.parameters = {0.5 * i, -0.0};
      policy.fitness = i;
    }
    return all;
  }
  RealityIteration begun(int number = 1, int stage = 1) const {
    return {run_, stage, number, {1, 2}, {}, "random", "asked", "", {}};
  }

  Database db_ = create();
  Id run_ = startRun(db_);
};

TEST_F(Reality, PoliciesWaitInTheirOrderBesideTheStagesOwnIndividuals) {
  std::vector<IndividualRecord> three = policies(3);
  db_.beginRealityIteration(begun(), three, {"a", "", "c"}, {2, 0, 1}, 4);
  const auto tasks = db_.measurementTasks(run_, 1);
  ASSERT_EQ(4u, tasks.size());
  EXPECT_EQ(0, tasks[0].iteration);
  const std::vector<Id> expected{three[2].id, three[0].id, three[1].id};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(expected[i], tasks[i + 1].individual);
    EXPECT_EQ(static_cast<int>(i) + 2, tasks[i + 1].position);
    EXPECT_EQ(1, tasks[i + 1].iteration);
    EXPECT_EQ(4, tasks[i + 1].wantedRepeats);
  }
  EXPECT_EQ("c", db_.trace(three[2].id));
  EXPECT_FALSE(db_.trace(three[1].id));
  EXPECT_EQ(RunState::waiting, db_.run(run_).state);
  // Nobody that L1 bred is joined by a policy.
  EXPECT_EQ(3u, db_.individuals(run_).size());
  EXPECT_EQ(3u, db_.individuals(run_, 1).size());
  EXPECT_EQ(3u, db_.lastGeneration(run_)->individuals.size());
  EXPECT_EQ(3u, db_.bestIndividuals(run_, 99, 1, 0).size());
  EXPECT_EQ(3u, db_.individualsOfSimulator(run_, 1).size());
  EXPECT_EQ(1, db_.individual(three[0].id).iteration);
  db_.addMeasurement({.run = run_, .individual = three[1].id, .value = 2});
}

TEST_F(Reality, WithoutRepeatsNobodyIsAskedToMeasure) {
  std::vector<IndividualRecord> two = policies(2);
  db_.beginRealityIteration(begun(), two, {"", ""}, {}, 0);
  EXPECT_EQ(1u, db_.measurementTasks(run_).size());
  EXPECT_EQ(2u, db_.realityPolicies(run_, 1, 1).size());
}

TEST_F(Reality, ABegunIterationIsKnownUntilItIsFinished) {
  EXPECT_FALSE(db_.begunRealityIteration(run_, 1));
  std::vector<IndividualRecord> two = policies(2);
  db_.beginRealityIteration(begun(), two, {"", ""}, {0, 1}, 1);
  const auto waiting = db_.begunRealityIteration(run_, 1);
  ASSERT_TRUE(waiting);
  EXPECT_EQ("asked", waiting->learnerState);
  EXPECT_EQ((std::vector<double>{1, 2}), waiting->centreBefore);
  EXPECT_TRUE(db_.realityIterations(run_).empty());

  RealityIteration done = begun();
  done.centreAfter = {3, 4};
  done.learnerState = "told";
  done.policies = {{two[0].id, 1.5, 0.25, 2}, {two[1].id, {}, 0, 0}};
  db_.addRealityIteration(done);
  EXPECT_FALSE(db_.begunRealityIteration(run_, 1));
  const auto all = db_.realityIterations(run_, 1);
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ((std::vector<double>{1, 2}), all[0].centreBefore);
  EXPECT_EQ((std::vector<double>{3, 4}), all[0].centreAfter);
  EXPECT_EQ("told", all[0].learnerState);
  ASSERT_EQ(2u, all[0].policies.size());
  EXPECT_EQ(1.5, all[0].policies[0].fitness);
  EXPECT_FALSE(all[0].policies[1].fitness) << "all its values were void";
  EXPECT_TRUE(db_.realityIterations(run_, 2).empty());
}

TEST_F(Reality, IsEndedByAPersonOnceItHasBegunAndOnlyInThatStage) {
  EXPECT_THAT(refusal([&] { db_.endRealityLearning(run_, "me"); }), HasSubstr("does not learn in reality now"));
  EXPECT_FALSE(db_.isRealityLearningEnded(run_, 1));
  std::vector<IndividualRecord> one = policies(1);
  db_.beginRealityIteration(begun(), one, {""}, {0}, 1);
  db_.endRealityLearning(run_, "me");
  db_.endRealityLearning(run_, "me too");
  EXPECT_TRUE(db_.isRealityLearningEnded(run_, 1));
  EXPECT_FALSE(db_.isRealityLearningEnded(run_, 2));
}

TEST_F(Reality, ALearnerWithoutACentreHasNone) {
  std::vector<IndividualRecord> one = policies(1);
  RealityIteration none = begun();
  none.centreBefore.clear();
  db_.beginRealityIteration(none, one, {""}, {0}, 1);
  none.policies = {{one[0].id, 1, 0, 1}};
  db_.addRealityIteration(none);
  EXPECT_TRUE(db_.realityIterations(run_)[0].centreBefore.empty());
  EXPECT_TRUE(db_.realityIterations(run_)[0].centreAfter.empty());
}

TEST_F(Reality, RefusesWhatIsNotTheNextAndKeepsNothingOfIt) {
  std::vector<IndividualRecord> two = policies(2);
  const auto begin = [&](const RealityIteration& i) {
    return refusal([&] { db_.beginRealityIteration(i, two, {"", ""}, {0, 1}, 1); });
  };
  EXPECT_THAT(begin(begun(2)), HasSubstr("the next is 1 in stage 1"));
  EXPECT_THAT(begin(begun(1, 2)), HasSubstr("the next is 1 in stage 1"));
  EXPECT_THAT(refusal([&] {
                db_.beginRealityIteration(begun(), two, {""}, {0, 1}, 1);
              }),
              HasSubstr("each with its trace"));
  EXPECT_EQ("accepted", begin(begun()));
  EXPECT_THAT(begin(begun()), HasSubstr("has its policies already"));
  RealityIteration other = begun();
  other.policies = {{two[1].id, 1, 0, 1}, {two[0].id, 1, 0, 1}};
  EXPECT_THAT(refusal([&] { db_.addRealityIteration(other); }), HasSubstr("other policies"));
  EXPECT_TRUE(db_.realityIterations(run_).empty());
  EXPECT_EQ(3u, db_.measurementTasks(run_).size());
}

}  // namespace
}  // namespace btr
