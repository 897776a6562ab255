// Several connections and processes on one database: the window and a run beside it.
#include "tests/store/processes.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Mode = Database::Mode;

class Sharing : public StoreTest {};

TEST_F(Sharing, AReaderSeesAtOnceWhatAWriterHasStored) {
  Database writer = create();
  const Id run = startRun(writer);
  const Database reader = Database::open(file(), Mode::readOnly);
  for (int number = 1; number <= 3; ++number) {
    GenerationRecord generation = generationOf(run, number);
    writer.addGeneration(generation);
    EXPECT_EQ(static_cast<std::size_t>(number), reader.generations(run).size());
    EXPECT_EQ(number, reader.run(run).generation);
  }
}

TEST_F(Sharing, TheDataVersionChangesWithEveryCommitOfAnybodyAndOnlyThen) {
  Database one = create();
  const Id run = startRun(one);
  Database two = Database::open(file(), Mode::readWrite);
  const Database reader = Database::open(file(), Mode::readOnly);
  auto versions = [&] { return std::vector{one.dataVersion(), two.dataVersion(), reader.dataVersion()}; };
  auto before = versions();
  const auto changed = [&] {
    const auto after = versions();
    int count = 0;
    for (std::size_t k = 0; k < after.size(); ++k) count += after[k] > before[k];
    before = after;
    return count;
  };
  EXPECT_EQ(0, changed());
  one.setRunNote(run, "a");
  EXPECT_EQ(3, changed());
  two.setRunNote(run, "b");
  EXPECT_EQ(3, changed());
  reader.run(run);
  one.individuals(run);
  EXPECT_EQ(0, changed());
  EXPECT_EQ("DONE", inAnotherProcess([&] {
              Database::open(file(), Mode::readWrite).requestStop(run, true);
              return std::string("DONE");
            }));
  EXPECT_EQ(3, changed());
}

TEST_F(Sharing, TwoProcessesWriteSideBySide) {
  {
    Database database = create();
    startRun(database);
    database.addRun(runOf(1, 2), {});
  }
  const auto writeTo = [&](Id run) {
    Database database = Database::open(file(), Mode::readWrite);
    for (int number = 1; number <= 40; ++number) {
      GenerationRecord generation = generationOf(run, number);
      generation.simulator = run;
      database.addGeneration(generation);
    }
    return std::string("DONE");
  };
  EXPECT_THAT(inProcesses({[&] { return writeTo(1); }, [&] { return writeTo(2); }}), testing::Each("DONE"));
  const Database database = Database::open(file(), Mode::readOnly);
  for (const Id run : {1, 2}) {
    EXPECT_EQ(40u, database.generations(run).size());
    EXPECT_EQ(40u * 30, database.individuals(run).size());
  }
}

TEST_F(Sharing, ProcessesThatCreateTheSameDatabaseShareIt) {
  constexpr int count = 6;
  const std::function<std::string()> work = [&] {
    Database database = create();
    startRun(database);
    return std::string("DONE");
  };
  EXPECT_THAT(inProcesses(std::vector(count, work)), testing::Each("DONE"));
  EXPECT_EQ(static_cast<std::size_t>(count), create().runs().size());
  EXPECT_EQ(1, std::distance(std::filesystem::directory_iterator(folder_), {})) << "no drafts are left";
}

TEST_F(Sharing, ALockThatIsHeldTooLongIsSaidAndNothingIsStored) {
  { startRun(*std::make_unique<Database>(create())); }
  Database database = Database::open(file(), Mode::readWrite, 30);
  SQLite::Database other(file(), SQLite::OPEN_READWRITE);
  {
    const SQLite::Transaction held(other, SQLite::TransactionBehavior::IMMEDIATE);
    EXPECT_EQ(file() + ": another process keeps the database locked; try again when it is done",
              refusal([&] { database.setRunNote(1, "x"); }));
    EXPECT_THROW(database.setRunNote(1, "x"), NotStored) << "a working run may try again later";
    EXPECT_EQ("", database.run(1).note) << "reading goes on";
  }
  database.setRunNote(1, "y");
  EXPECT_EQ("y", database.run(1).note);
}

TEST_F(Sharing, TheDatabaseItselfRefusesToForget) {
  {
    Database database = create();
    RunRecord run = runOf(database.addExperiment(kickExperiment()));
    run.files = {{"leg.urdf", "", "<robot/>"}};
    run.genes = {{0, 1, false}};
    SimulatorRecord start;
    start.simulator = {{{"friction", 0.8}}, {{"backlash", "leg.knee", {{"width_rad", 0.1}}}}};
    const Id id = database.addRun(run, start);
    GenerationRecord generation = generationOf(id, 1);
    database.addGeneration(generation);
    database.setTrace(1, "packed", "hash");
    database.addMeasurementStage(id, 1, {{id, 1, 1, 1, 1.0, 1, false}});
    database.addMeasurement({.run = id, .individual = 1, .value = 1});
    std::vector<IndividualRecord> policies(1);
    policies[0].simulator = 1;
    policies[0].parameters = {1};
    const RealityIteration begun{id, 1, 1, {1}, {2}, "", "", "", {}};
    database.beginRealityIteration(begun, policies, {"packed"}, {0}, 2);
    database.endRealityLearning(id, "me");
    RealityIteration done = begun;
    done.policies = {{policies[0].id, 1.5, 0, 1}};
    database.addRealityIteration(done);
    database.addAdaptation({id, 1, 1, 0, 0, "", "", {{"01", {1}, 1}}, ""});
    start.run = id;
    database.finishStage(start, {id, 1, 1, 0, 1, 1, {}, {}, 1, 1, 0, 1}, RunState::learning);
    database.addRecording({0, 1, 0, "r.csv", "", "", "a,b", "", ""});
    database.addRig({0, "servo", "{}", "", ""}, SimulatorRecord{});
    GridStart cell;
    cell.cell = 1;
    cell.run = runOf(1, 2);
    const Id grid =
        database.addGrid({0, 1, "whole", "independent", 1, "{}", "hash", ""}, {{1, {0.14, 0, 0}, 0, 0, 0, 0}}, {cell});
    const Id learner = database.gridCells(grid).front().run;
    GridStep step;
    step.generation = generationOf(learner, 1);
    step.generation.simulator = database.latestSimulator(learner).id;
    step.best.cell = 1;
    step.slot = 0;
    std::vector<GridStep> steps{step};
    database.addGridRound(grid, steps);
    const Id best = steps.front().best.individual;
    std::vector<GridSettlement> settled{{{1, best, best, false, 0, 0}, {}, -1}};
    database.settleGrid(grid, settled);
    database.addGridPoints(grid, {{1, {0.15, 0, 0}, {1}, 1, "finished", {}}});
  }
  SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
  std::vector<std::string> tables;
  for (SQLite::Statement row(raw, "SELECT name FROM sqlite_master WHERE type = 'table'"); row.executeStep();)
    tables.push_back(row.getColumn(0).getString());
  EXPECT_EQ(34u, tables.size());
  for (const std::string& table : tables) {
    EXPECT_GT(raw.execAndGet("SELECT count(*) FROM " + table).getInt(), 0) << table;
    EXPECT_THROW(raw.exec("DELETE FROM " + table), SQLite::Exception) << table;
  }
  for (const char* change : {"simulator SET parent_id = NULL",
                             "simulator_value SET value = 1",
                             "simulator_effect SET place = 'floor'",
                             "simulator_effect_value SET value = 2",
                             "measurement SET value = 2",
                             "measurement SET who = 'x'",
                             "measurement SET source = 'stand_in'",
                             "measurement SET entered_at = ''",
                             "individual SET fitness = 9",
                             "individual SET trace_sha256 = ''",
                             "generation SET best = 9",
                             "run SET seed = 3",
                             "experiment SET spec_json = ''",
                             "gap SET after = 0",
                             "recording_data SET csv = x''",
                             "stored_file SET content = x''",
                             "trace SET packed = x''",
                             "individual SET iteration = 3",
                             "measurement_task SET iteration = 3",
                             "reality_begun SET learner_state = 'x'",
                             "reality_iteration SET learner_state = 'x'",
                             "reality_policy SET individual_id = 1",
                             "reality_result SET fitness = 2"})
    EXPECT_THROW(raw.exec("UPDATE " + std::string(change)), SQLite::Exception) << change;
  EXPECT_EQ(1, raw.exec("UPDATE measurement SET is_void = 1, note = 'slipped'"));
  EXPECT_THROW(raw.exec("INSERT INTO measurement VALUES (9, 1, 1, 9e999, 0, '', '', 'person', '')"), SQLite::Exception);
}

}  // namespace
}  // namespace btr
