// What is stored is read back as it was, and what must not be stored is refused whole.
#include <bit>
#include <cmath>
#include <limits>

#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

class Records : public StoreTest {
 protected:
  Database db_ = create();
  Id run_ = startRun(db_);

  void addGenerations(int count, int individuals = 3) {
    for (int number = 1; number <= count; ++number) {
      GenerationRecord generation = generationOf(run_, number, individuals, 2);
      db_.addGeneration(generation);
    }
  }
};

TEST_F(Records, ExperimentsAreFoundByIdAndByText) {
  const Id id = db_.addExperiment({0, "walk µ", "{\"a\": 1}", "2026-11-21T10:11:12Z", "first"});
  db_.setExperimentNote(id, "second");
  const ExperimentRecord stored = db_.experiment(id);
  EXPECT_EQ("walk µ", stored.name);
  EXPECT_EQ("{\"a\": 1}", stored.specJson);
  EXPECT_EQ("2026-11-21T10:11:12Z", stored.createdAt);
  EXPECT_EQ("second", stored.note);
  EXPECT_EQ(id, db_.findExperiment("{\"a\": 1}"));
  EXPECT_FALSE(db_.findExperiment("{\"a\": 2}"));
  EXPECT_EQ(2u, db_.experiments().size());
  EXPECT_EQ(file() + ": experiment 99 is not in the database", refusal([&] { db_.experiment(99); }));
  EXPECT_EQ(file() + ": experiment 99 is not in the database", refusal([&] { db_.setExperimentNote(99, ""); }));
}

TEST_F(Records, ARunKeepsItsSeedFilesStateAndProgramVersion) {
  RunRecord run = runOf(1, std::numeric_limits<std::uint64_t>::max());
  run.reality = "stand_in";
  run.files = {{"leg.urdf", "", "<robot/>"}, {"empty.wrl", "", ""}, {"binary", "", std::string("a\0b", 3)}};
  const Id id = db_.addRun(run, SimulatorRecord{});
  db_.setRunState(id, RunState::failed, "why");
  db_.setRunNote(id, "note");
  db_.setProgress(id, "{\"trials\": 3}");
  db_.requestStop(id, true);

  const RunRecord stored = db_.run(id);
  EXPECT_EQ(run.seed, stored.seed);
  EXPECT_EQ("stand_in", stored.reality);
  EXPECT_EQ(RunState::failed, stored.state);
  EXPECT_EQ("why", stored.message);
  EXPECT_EQ("note", stored.note);
  EXPECT_EQ("{\"trials\": 3}", stored.progressJson);
  EXPECT_TRUE(stored.stopRequested);
  EXPECT_EQ(programVersion(), stored.programVersion);
  EXPECT_THAT(stored.startedAt, MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z"));
  ASSERT_EQ(3u, stored.files.size());
  EXPECT_EQ("leg.urdf", stored.files[0].name);
  EXPECT_EQ(sha256("<robot/>"), stored.files[0].sha256);
  EXPECT_EQ("", stored.files[1].content);
  EXPECT_EQ(std::string("a\0b", 3), stored.files[2].content);
  EXPECT_EQ(id, db_.findRun("abc", run.seed));
  EXPECT_FALSE(db_.findRun("abc", 77));
  EXPECT_EQ(id, db_.latestRun());
  EXPECT_EQ(2u, db_.runs().size());
  EXPECT_EQ(2u, db_.runs(1).size());
  EXPECT_TRUE(db_.runs(2).empty());
}

TEST_F(Records, ARunThatCannotBeStoredLeavesNothingBehind) {
  RunRecord run = runOf(1);
  run.files = {{"leg.urdf", "0123", "<robot/>"}};
  EXPECT_THAT(refusal([&] { db_.addRun(run, {}); }), HasSubstr("leg.urdf: the hash 0123 is not allowed"));
  run.files.clear();
  run.reality = "";
  EXPECT_THAT(refusal([&] { db_.addRun(run, {}); }), HasSubstr("run's reality: no name is not allowed"));
  run.reality = "person";
  SimulatorRecord broken;
  broken.simulator.values = {{"friction", std::nan("")}};
  EXPECT_THAT(refusal([&] { db_.addRun(run, broken); }), HasSubstr("NaN"));
  EXPECT_THAT(refusal([&] { db_.addRun(runOf(9), {}); }), HasSubstr("experiment 9 is not in the database"));
  EXPECT_EQ(1u, db_.runs().size());
}

// As with a full disk: the run cannot be stored after its experiment was.
TEST_F(Records, ARunThatCannotBeStoredLeavesNoExperiment) {
  const std::size_t before = db_.experiments().size();
  RunRecord run = runOf(0);
  run.files = {{"leg.urdf", "0123", "<robot/>"}};
  EXPECT_THAT(refusal([&] { db_.addRun(kickExperiment(), run, {}); }), HasSubstr("leg.urdf"));
  EXPECT_EQ(before, db_.experiments().size());
  run.files.clear();
  const Id id = db_.addRun(kickExperiment(), run, {});
  ASSERT_EQ(before + 1, db_.experiments().size());
  EXPECT_EQ(db_.experiments().back().id, db_.run(id).experiment);
}

TEST_F(Records, GenerationsReadBackBitByBit) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double infinity = std::numeric_limits<double>::infinity();
  GenerationRecord generation = generationOf(run_, 1, 3, 2);
  generation.individuals[0].parameters = {-0.0, tiny, infinity, 0.1, 1e308};
  generation.individuals[0].fitness = -infinity;
  generation.individuals[1].parameters.clear();
  generation.individuals[1].fitness = std::nextafter(0.1, 1);
  generation.individuals[1].outcome = "exploded";
  generation.individuals[1].detail = "at 0.3 s";
  generation.individuals[2].fitness = -0.0;
  generation.best = tiny;
  generation.mean = 1e-300 / 3;
  generation.seconds = 0.25;
  db_.addGeneration(generation);
  EXPECT_FALSE(std::signbit(generation.individuals[2].fitness)) << "the caller goes on with what is stored";

  const std::optional<GenerationRecord> stored = db_.lastGeneration(run_);
  ASSERT_TRUE(stored);
  EXPECT_EQ(1, stored->number);
  EXPECT_EQ("random 1", stored->randomState);
  EXPECT_EQ("learner 1", stored->learnerState);
  EXPECT_EQ(tiny, stored->best);
  EXPECT_EQ(1e-300 / 3, stored->mean);
  ASSERT_EQ(3u, stored->individuals.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const IndividualRecord &a = generation.individuals[k], &b = stored->individuals[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(run_, b.run);
    EXPECT_EQ(1, b.generation);
    EXPECT_EQ(static_cast<int>(k), b.slot);
    EXPECT_EQ(1, b.simulator);
    EXPECT_EQ(a.chromosome, b.chromosome);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.fitness), std::bit_cast<std::uint64_t>(b.fitness));
    EXPECT_EQ(a.trialSeed, b.trialSeed);
    EXPECT_EQ(a.outcome, b.outcome);
    EXPECT_EQ(a.detail, b.detail);
    ASSERT_EQ(a.parameters.size(), b.parameters.size());
    for (std::size_t p = 0; p < a.parameters.size(); ++p)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.parameters[p]), std::bit_cast<std::uint64_t>(b.parameters[p]));
    EXPECT_EQ(b.chromosome, db_.individual(b.id).chromosome);
  }
  EXPECT_EQ(1, db_.run(run_).generation);
}

TEST_F(Records, OnlyTheNextGenerationIsAccepted) {
  addGenerations(2);
  for (const int wrong : {0, 1, 2, 4}) {
    GenerationRecord generation = generationOf(run_, wrong);
    EXPECT_EQ(file() + ": generation " + std::to_string(wrong) + " is not allowed; the next of run 1 is 3",
              refusal([&] { db_.addGeneration(generation); }));
  }
  EXPECT_EQ(2u, db_.generations(run_).size());
  EXPECT_THAT(db_.generations(run_, 1), ElementsAre(testing::Field(&GenerationRecord::number, 2)));
}

TEST_F(Records, AGenerationIsStoredWholeOrNotAtAll) {
  addGenerations(1);
  GenerationRecord generation = generationOf(run_, 2);
  generation.individuals[29].fitness = std::nan("");
  EXPECT_THAT(refusal([&] { db_.addGeneration(generation); }),
              HasSubstr("generation 2, slot 29: the fitness nan is not allowed"));
  generation.individuals[29].fitness = 1;
  generation.individuals[29].slot = 28;
  EXPECT_NE("accepted", refusal([&] { db_.addGeneration(generation); }));
  EXPECT_EQ(0, generation.individuals[0].id) << "nothing is written back either";
  EXPECT_EQ(3u, db_.individuals(run_).size());
  EXPECT_EQ(1, db_.run(run_).generation);
  GenerationRecord unknown = generationOf(7, 1);
  EXPECT_THAT(refusal([&] { db_.addGeneration(unknown); }), HasSubstr("run 7 is not in the database"));
}

TEST_F(Records, ReusedIndividualsPointToTheSimulatedOne) {
  addGenerations(1);
  GenerationRecord generation = generationOf(run_, 2, 4, 2);
  generation.individuals[1].sameAs = 2;              // an individual of generation 1
  generation.individuals[3].sameAs = sameAsSlot(2);  // slot 2 of this one
  db_.addGeneration(generation);
  const auto stored = db_.individuals(run_, 2);
  EXPECT_EQ(2, stored[1].sameAs);
  EXPECT_EQ(stored[2].id, stored[3].sameAs);
  EXPECT_EQ(stored[3].sameAs, generation.individuals[3].sameAs);
  EXPECT_EQ(5u, db_.individualsOfSimulator(run_, 1).size()) << "three of generation 1, two of generation 2";

  GenerationRecord wrong = generationOf(run_, 3, 2, 2);
  wrong.individuals[0].sameAs = sameAsSlot(1);  // a later slot
  EXPECT_THAT(refusal([&] { db_.addGeneration(wrong); }), HasSubstr("slot 0: same as slot 1 is not allowed"));
  wrong.individuals[0].sameAs = 1000;
  EXPECT_THAT(refusal([&] { db_.addGeneration(wrong); }), HasSubstr("individual 1000 is not in the database"));
}

TEST_F(Records, TheBestOfALearnerWithoutChromosomesAreDistinctParameters) {
  GenerationRecord generation = generationOf(run_, 1, 4, 1);
  for (std::size_t k = 0; k < 4; ++k) {
    generation.individuals[k].chromosome = "";
    generation.individuals[k].parameters = {0.1 * static_cast<double>(k % 3), 1};
    generation.individuals[k].fitness = static_cast<double>(k);
  }
  db_.addGeneration(generation);
  std::vector<int> slots;
  for (const IndividualRecord& i : db_.bestIndividuals(run_, 10, 1, 0)) slots.push_back(i.slot);
  EXPECT_THAT(slots, ElementsAre(3, 2, 1));
}

TEST_F(Records, TheBestAreDistinctChromosomesAndTiesGoToTheEarlier) {
  for (int number = 1; number <= 3; ++number) {
    GenerationRecord generation = generationOf(run_, number, 4, 1);
    const char* chromosomes[] = {"00", "01", "10", "11"};
    const double fitness[] = {5, 5, 1.0 * number, 7};
    for (std::size_t k = 0; k < 4; ++k) {
      generation.individuals[k].chromosome = chromosomes[k];
      generation.individuals[k].fitness = fitness[k];
    }
    db_.addGeneration(generation);
  }
  const auto named = [](const std::vector<IndividualRecord>& all) {
    std::vector<std::string> names;
    for (const auto& i : all) names.push_back(i.chromosome + "@" + std::to_string(i.generation));
    return names;
  };
  EXPECT_THAT(named(db_.bestIndividuals(run_, 10, 1, 0)), ElementsAre("11@1", "00@1", "01@1", "10@3"));
  EXPECT_THAT(named(db_.bestIndividuals(run_, 2, 2, 0)), ElementsAre("11@2", "00@2"));
  EXPECT_THAT(named(db_.bestIndividuals(run_, 9, 1, 2)), ElementsAre("11@1", "00@1", "01@1", "10@2"));
  EXPECT_TRUE(db_.bestIndividuals(run_, 0, 1, 0).empty());
}

TEST_F(Records, ATraceIsKeptWithItsHashAndNeverReplaced) {
  addGenerations(1);
  EXPECT_FALSE(db_.trace(1));
  const std::string packed("\0packed\xff", 8);
  db_.setTrace(1, packed, "hash");
  EXPECT_EQ(packed, db_.trace(1));
  EXPECT_EQ("hash", db_.individual(1).traceSha256);
  EXPECT_THAT(refusal([&] { db_.setTrace(1, "other", "other"); }), HasSubstr("that of its trial is hash"));
  EXPECT_EQ("accepted", refusal([&] { db_.setTrace(1, packed, "hash"); }));
  EXPECT_THAT(refusal([&] { db_.setTrace(50, "x", "y"); }), HasSubstr("individual 50 is not in the database"));
  EXPECT_THAT(refusal([&] { db_.trace(50); }), HasSubstr("individual 50 is not in the database"));
}

TEST_F(Records, OfATraceThatIsNotKeptTheHashIs) {
  addGenerations(1);
  db_.setTrace(1, "", "hash");
  EXPECT_FALSE(db_.trace(1));
  EXPECT_EQ("hash", db_.individual(1).traceSha256);
  EXPECT_THAT(refusal([&] { db_.setTrace(1, "other", "other"); }), HasSubstr("that of its trial is hash"));
}

TEST_F(Records, MeasurementsAreVoidedButKept) {
  addGenerations(1);
  db_.addMeasurementStage(run_, 1, {{run_, 1, 3, 1, 1.02, 2, false}, {run_, 1, 1, 2, 1.0, 2, true}});
  EXPECT_EQ(RunState::waiting, db_.run(run_).state);
  const auto tasks = db_.measurementTasks(run_);
  ASSERT_EQ(2u, tasks.size());
  EXPECT_EQ(3, tasks[0].individual);
  EXPECT_EQ(1.02, tasks[0].simulatedFitness);
  EXPECT_EQ(2, tasks[0].wantedRepeats);
  EXPECT_TRUE(tasks[1].heldOut);
  EXPECT_EQ(2u, db_.measurementTasks(run_, 1).size());
  EXPECT_TRUE(db_.measurementTasks(run_, 2).empty());

  MeasurementRecord value{.run = run_, .individual = 3, .value = 0.1, .note = "slipped", .who = "Ana"};
  const Id first = db_.addMeasurement(value);
  value.value = -0.5;
  value.source = "stand_in";
  db_.addMeasurement(value);
  db_.setMeasurementVoid(first, true, "fell over");
  const auto stored = db_.measurements(run_);
  ASSERT_EQ(2u, stored.size());
  EXPECT_EQ(0.1, stored[0].value);
  EXPECT_TRUE(stored[0].isVoid);
  EXPECT_EQ("fell over", stored[0].note);
  EXPECT_EQ("Ana", stored[0].who);
  EXPECT_EQ("person", stored[0].source);
  EXPECT_EQ("stand_in", stored[1].source);
  EXPECT_FALSE(stored[1].isVoid);
  EXPECT_EQ("fell over", db_.measurement(first).note);
}

TEST_F(Records, MeasurementsThatNobodyAskedForAreRefusedAllTogether) {
  addGenerations(1);
  db_.addMeasurementStage(run_, 1, {{run_, 1, 3, 1, 1.02, 1, false}});
  const MeasurementRecord good{.run = run_, .individual = 3, .value = 1};
  MeasurementRecord bad = good;
  const auto refusalOf = [&] { return refusal([&] { db_.addMeasurements({good, bad}); }); };
  bad.individual = 2;
  EXPECT_EQ(file() + " individual 2: a measurement is not allowed; only individuals that run 1 asks for", refusalOf());
  bad.individual = 999;
  EXPECT_THAT(refusalOf(), HasSubstr("individual 999: a measurement is not allowed"));
  bad = good;
  bad.run = 4;
  EXPECT_THAT(refusalOf(), HasSubstr("run 4 is not in the database"));
  bad = good;
  bad.source = "";
  EXPECT_THAT(refusalOf(), HasSubstr("a source without a name is not allowed"));
  // Beyond the bounds of a stand-in's answers, gaps of it would not be finite any more.
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308, -1.000001e9}) {
    bad = good;
    bad.value = value;
    EXPECT_THAT(refusalOf(), HasSubstr("a finite number"));
  }
  bad = good;
  bad.note = "d\xE9rap\xE9";
  EXPECT_THAT(refusalOf(), HasSubstr("individual 3, note: the byte 0xE9 (number 2 of the text) is not allowed"));
  EXPECT_TRUE(db_.measurements(run_).empty());
  EXPECT_THAT(refusal([&] { db_.setMeasurementVoid(1, true, ""); }), HasSubstr("measurement 1 is not in the database"));
  EXPECT_EQ(2u, db_.addMeasurements({good, good}).size());
}

TEST_F(Records, OnlyTheNextStageIsOpenedAndOnlyOnce) {
  addGenerations(1);
  const std::vector<MeasurementTask> tasks{{run_, 1, 3, 1, 1.02, 1, false}};
  EXPECT_THAT(refusal([&] { db_.addMeasurementStage(run_, 2, tasks); }),
              HasSubstr("stage 2 of run 1 is not allowed; the next is 1"));
  EXPECT_THAT(refusal([&] { db_.addMeasurementStage(run_, 1, {}); }), HasSubstr("without an individual"));
  db_.addMeasurementStage(run_, 1, tasks);
  EXPECT_THAT(refusal([&] { db_.addMeasurementStage(run_, 1, tasks); }), HasSubstr("has its individuals already"));
  const std::vector<MeasurementTask> unknown{{run_, 1, 300, 1, 1.02, 1, false}};
  const Id other = db_.addRun(runOf(1, 2), {});
  EXPECT_THAT(refusal([&] { db_.addMeasurementStage(other, 1, unknown); }),
              HasSubstr("individual 300 is not in the database"));
  EXPECT_THAT(refusal([&] { db_.addMeasurementStage(other, 1, tasks); }),
              HasSubstr("individual 3 belongs to run 1, not to run 2"));
}

TEST_F(Records, ATaskKeepsWhyItsIndividualIsMeasured) {
  addGenerations(1);
  db_.addMeasurementStage(
      run_, 1, {{run_, 1, 3, 1, 1.02, 1, false, 0, 2, {}, 0}, {run_, 1, 1, 2, 0.5, 1, true, 0, 1, 0.1 + 0.2, 6}});
  const auto tasks = db_.measurementTasks(run_, 1);
  ASSERT_EQ(2u, tasks.size());
  EXPECT_EQ(2, tasks[0].rank);
  EXPECT_FALSE(tasks[0].disagreement);
  EXPECT_EQ(0, tasks[0].candidates);
  EXPECT_EQ(1, tasks[1].rank);
  EXPECT_EQ(0.1 + 0.2, tasks[1].disagreement);
  EXPECT_EQ(6, tasks[1].candidates);
}

TEST_F(Records, AStageWithNobodyToMeasureIsPassedAndOneThatHasSomebodyIsNot) {
  addGenerations(1);
  EXPECT_THAT(refusal([&] { db_.passStage(run_, 2, RunState::learning); }), HasSubstr("its next stage is 1"));
  db_.passStage(run_, 1, RunState::learning);
  EXPECT_EQ(1, db_.run(run_).stage);
  EXPECT_TRUE(db_.gaps(run_).empty());
  db_.addMeasurementStage(run_, 2, {{run_, 2, 1, 1, 1.0, 1, false}});
  EXPECT_THAT(refusal([&] { db_.passStage(run_, 2, RunState::learning); }), HasSubstr("has individuals to measure"));
}

TEST_F(Records, AStageEndsWithANewSimulatorItsGapAndTheNextState) {
  addGenerations(1);
  AdaptationRecord l3{run_, 1, 1, 0.5, 0.75, "r", "l", {{"01", {0.1, -0.0}, 0.5}, {"10", {0.2}, 1.0}}, "e"};
  db_.addAdaptation(l3);
  EXPECT_EQ("e", db_.adaptations(run_, 1).at(0).evidenceSha256);
  EXPECT_THAT(refusal([&] { db_.addAdaptation(l3); }), HasSubstr("the next of run 1 is 2 in stage 1"));

  SimulatorRecord adapted;
  adapted.run = run_;
  adapted.parent = 1;
  adapted.madeBy = "L3";
  adapted.evidence = "{\"stage\": 1}";
  adapted.madeAfterGeneration = 1;
  adapted.simulator.values = {{"friction", 0.1 + 0.2}, {"leg_mass_kg", 1.0}};
  adapted.simulator.effects = {{"backlash", "ers7.LF_J1", {{"width_rad", 0.051}}},
                               {"air_drag", "ball", {}},
                               {"backlash", "ers7.LF_J2", {{"width_rad", 1}}}};
  const GapRecord gap{run_, 1, 1, 0, 3.5, 1.25, std::nullopt, 2.0, 3.5, 1.5, 0.125, 10, 0.25, 3};
  const Id id = db_.finishStage(adapted, gap, RunState::learning);

  const SimulatorRecord stored = db_.simulator(id);
  EXPECT_EQ(1, stored.number);
  EXPECT_EQ(1, stored.parent);
  EXPECT_EQ("L3", stored.madeBy);
  EXPECT_EQ("{\"stage\": 1}", stored.evidence);
  EXPECT_EQ(1, stored.madeAfterGeneration);
  EXPECT_EQ(adapted.simulator, stored.simulator);
  EXPECT_EQ(id, db_.latestSimulator(run_).id);
  ASSERT_EQ(2u, db_.simulators(run_).size());
  EXPECT_EQ("start", db_.simulators(run_)[0].madeBy);
  EXPECT_EQ(RunState::learning, db_.run(run_).state);
  EXPECT_EQ(1, db_.run(run_).stage);
  ASSERT_EQ(1u, db_.gaps(run_).size());
  const GapRecord g = db_.gaps(run_)[0];
  EXPECT_EQ(id, g.simulatorAfter);
  EXPECT_EQ(3.5, g.before);
  EXPECT_EQ(1.25, g.after);
  EXPECT_FALSE(g.heldOutBefore);
  EXPECT_EQ(2.0, g.heldOutAfter);
  EXPECT_EQ(3.5, g.newBefore);
  EXPECT_EQ(1.5, g.newAfter);
  EXPECT_EQ(0.125, g.standardError);
  EXPECT_EQ(10, g.individuals);
  EXPECT_EQ(0.25, g.heldOutStandardError);
  EXPECT_EQ(3, g.heldOutIndividuals);
  const auto adaptations = db_.adaptations(run_, 1);
  ASSERT_EQ(1u, adaptations.size());
  EXPECT_EQ(0.5, adaptations[0].bestError);
  EXPECT_EQ(0.75, adaptations[0].meanError);
  ASSERT_EQ(2u, adaptations[0].candidates.size());
  EXPECT_TRUE(std::signbit(adaptations[0].candidates[0].parameters[1]));
  EXPECT_EQ("10", adaptations[0].candidates[1].chromosome);
  EXPECT_EQ(1.0, adaptations[0].candidates[1].error);

  EXPECT_THAT(refusal([&] { db_.finishStage(adapted, gap, RunState::learning); }), HasSubstr("its next stage is 2"));
  EXPECT_EQ(2u, db_.simulators(run_).size());
}

TEST_F(Records, ASimulatorNamesAParentOfItsOwnRun) {
  const Id other = db_.addRun(runOf(1, 2), {});
  SimulatorRecord simulator;
  simulator.run = other;
  simulator.parent = 1;
  EXPECT_THAT(refusal([&] { db_.addSimulator(simulator); }), HasSubstr("simulator 1 belongs to run 1, not to run 2"));
  simulator.parent = 2;
  simulator.number = 5;
  EXPECT_THAT(refusal([&] { db_.addSimulator(simulator); }),
              HasSubstr("version 5 is not allowed; the next of run 2 is 1"));
  simulator.number = 0;
  EXPECT_EQ(1, db_.simulator(db_.addSimulator(simulator)).number);
  simulator.run = 9;
  EXPECT_THAT(refusal([&] { db_.addSimulator(simulator); }), HasSubstr("run 9 is not in the database"));
}

TEST_F(Records, RecordingsKeepTheBytesOfTheirFile) {
  RecordingRecord recording{0, 1, 0, "r.csv", "", "{}", "", "XL330", ""};
  recording.csv = std::string("time_s,x\r\n0,1\0\xff", 15);
  const Id id = db_.addRecording(recording);
  const RecordingRecord stored = db_.recording(id);
  EXPECT_EQ(recording.csv, stored.csv);
  EXPECT_EQ(sha256(recording.csv), stored.sha256);
  EXPECT_EQ("r.csv", stored.name);
  EXPECT_EQ("XL330", stored.source);
  ASSERT_EQ(1u, db_.recordings(1).size());
  EXPECT_EQ("", db_.recordings(1)[0].csv);
  recording.sha256 = "00";
  EXPECT_THAT(refusal([&] { db_.addRecording(recording); }), HasSubstr("the hash 00 is not allowed"));
  recording.sha256 = "";
  recording.individual = 40;
  EXPECT_THAT(refusal([&] { db_.addRecording(recording); }), HasSubstr("individual 40 is not in the database"));
}

TEST_F(Records, ReadingOnlyRefusesToWrite) {
  Database reader = Database::open(file(), Database::Mode::readOnly);
  EXPECT_EQ(1u, reader.runs().size());
  EXPECT_THAT(refusal([&] { reader.setRunNote(run_, "x"); }), HasSubstr("cannot be changed"));
}

}  // namespace
}  // namespace btr
