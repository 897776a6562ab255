// Runs of another database, with new numbers.
#include <SQLiteCpp/SQLiteCpp.h>

#include <map>

#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Mode = Database::Mode;

constexpr std::size_t large = 1 << 20;

class Merge : public StoreTest {
 protected:
  /// A run of two generations that was measured, adapted and recorded once.
  Id fill(Database& db, std::uint64_t seed, const std::string& name) {
    ExperimentRecord experiment = kickExperiment();
    experiment.name = name;
    const auto known = db.experiments();
    const auto same = std::ranges::find(known, name, &ExperimentRecord::name);
    const Id of = same == known.end() ? db.addExperiment(experiment) : same->id;
    const Id run = db.addRun(runOf(of, seed), SimulatorRecord{});
    for (int number = 1; number <= 2; ++number) {
      GenerationRecord generation = generationOf(run, number, 4, 3);
      generation.simulator = db.latestSimulator(run).id;
      db.addGeneration(generation);
    }
    const std::vector<IndividualRecord> all = db.individuals(run, 2);
    db.setTrace(all[0].id, std::string(2000, 't'), "a hash");
    db.setTrace(all[1].id, std::string(20, 't'), "another");
    MeasurementTask task;
    task.run = run;
    task.stage = task.position = 1;
    task.individual = all[0].id;
    db.addMeasurementStage(run, 1, {task});
    MeasurementRecord value;
    value.run = run;
    value.individual = all[0].id;
    value.value = 0.1 * static_cast<double>(seed);
    value.source = "person";
    db.addMeasurement(value);
    RecordingRecord recording;
    recording.experiment = of;
    recording.individual = all[0].id;
    recording.name = "kick.csv";
    recording.csv = "t\n" + std::to_string(seed);
    recording.mappingJson = "{}";
    const Id stored = db.addRecording(recording);
    SimulatorRecord adapted;
    adapted.run = run;
    adapted.parent = db.latestSimulator(run).id;
    adapted.madeBy = "L3";
    adapted.evidence = R"({"error":0.25,"individuals":[)" + std::to_string(all[0].id) + R"(],"recordings":[)" +
                       std::to_string(stored) + "]}";
    db.addSimulator(adapted);
    return run;
  }
  static std::int64_t number(const std::string& path, const std::string& sql) {
    SQLite::Database database(path, SQLite::OPEN_READONLY);
    return database.execAndGet(sql).getInt64();
  }
  static std::map<std::string, std::int64_t> counts(const std::string& path) {
    SQLite::Database database(path, SQLite::OPEN_READONLY);
    std::vector<std::string> tables;
    SQLite::Statement names(database,
                            "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite%'");
    while (names.executeStep()) tables.push_back(names.getColumn(0).getString());
    std::map<std::string, std::int64_t> rows;
    for (const std::string& table : tables)
      rows[table] = database.execAndGet("SELECT count(*) FROM " + table).getInt64();
    return rows;
  }
};

TEST_F(Merge, AllRowsOfBothAreThereAndReferToEachOtherAsBefore) {
  Database ours = create();
  fill(ours, 1, "ours");
  fill(ours, 2, "both");
  Database theirs = Database::open(pathOf("lab.db"), Mode::create);
  const Id first = fill(theirs, 3, "both"), second = fill(theirs, 4, "theirs");
  const auto before = counts(file()), added = counts(pathOf("lab.db"));

  const MergedRuns merged = ours.merge(pathOf("lab.db"), large);
  EXPECT_EQ(merged.runs, 2);
  EXPECT_EQ(merged.experiments, 1);  // "both" is one
  EXPECT_EQ(merged.individuals, 16);
  for (const auto& [table, rows] : counts(file()))
    EXPECT_EQ(rows, before.at(table) + added.at(table) - (table == "experiment" ? 1 : 0)) << table;
  EXPECT_EQ(counts(pathOf("lab.db")), added);
  EXPECT_EQ(number(file(), "SELECT count(*) FROM pragma_foreign_key_check"), 0);

  ASSERT_EQ(ours.runs().size(), 4u);
  EXPECT_EQ(ours.runs(ours.experiments()[1].id).size(), 2u);
  for (const auto& [theirId, seed] : {std::pair{first, 3u}, {second, 4u}}) {
    const auto all = ours.runs();
    const Id run = std::ranges::find(all, seed, &RunRecord::seed)->id;
    EXPECT_NE(run, theirId);
    EXPECT_EQ(ours.experiment(ours.run(run).experiment).name, seed == 3 ? "both" : "theirs");
    const auto here = ours.individuals(run), there = theirs.individuals(theirId);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_EQ(here[i].parameters, there[i].parameters);
      EXPECT_EQ(here[i].chromosome, there[i].chromosome);
      EXPECT_EQ(ours.trace(here[i].id), theirs.trace(there[i].id));
    }
    const auto values = ours.measurements(run);
    ASSERT_EQ(values.size(), 1u);
    EXPECT_EQ(values[0].value, 0.1 * seed);
    EXPECT_EQ(values[0].individual, here[4].id);
    // What a simulator version rests on has the new numbers, too.
    const SimulatorRecord adapted = ours.latestSimulator(run);
    EXPECT_EQ(adapted.parent, ours.simulators(run)[0].id);
    const auto recordings = ours.recordings(ours.run(run).experiment);
    const Id recorded = std::ranges::find(recordings, here[4].id, &RecordingRecord::individual)->id;
    EXPECT_EQ(adapted.evidence, R"({"error":0.25,"individuals":[)" + std::to_string(here[4].id) +
                                    R"(],"recordings":[)" + std::to_string(recorded) + "]}");
  }
}

TEST_F(Merge, SomeRunsComeAloneWithAllThatIsTheirs) {
  Database theirs = Database::open(pathOf("lab.db"), Mode::create);
  fill(theirs, 1, "bad");
  const Id wanted = fill(theirs, 2, "good");
  fill(theirs, 3, "good");
  // What one run brings, from a database that has it alone.
  Database alone = Database::open(pathOf("alone.db"), Mode::create);
  fill(alone, 2, "good");

  Database ours = create();
  const MergedRuns merged = ours.merge(pathOf("lab.db"), large, {wanted});
  EXPECT_EQ(merged.runs, 1);
  EXPECT_EQ(merged.experiments, 1);
  const auto expected = counts(pathOf("alone.db"));
  for (const auto& [table, rows] : counts(file()))
    if (table != "stored_file") {
      EXPECT_EQ(rows, expected.at(table)) << table;
    }
  EXPECT_EQ(number(file(), "SELECT count(*) FROM pragma_foreign_key_check"), 0);
  EXPECT_EQ(ours.runs()[0].seed, 2u);
  EXPECT_EQ(ours.runs()[0].id, 1) << "numbered without gaps";
  EXPECT_EQ(ours.individuals(ours.runs()[0].id).size(), theirs.individuals(wanted).size());

  // The others may follow, this one not again.
  EXPECT_THAT(refusal([&] { ours.merge(pathOf("lab.db"), large, {wanted}); }), HasSubstr("run 1 is run 2 of "));
  EXPECT_THAT(refusal([&] {
                ours.merge(pathOf("lab.db"), large, {1, 7});
              }),
              testing::AllOf(HasSubstr("there is no run 7 in "), HasSubstr("nothing was copied")));
  EXPECT_EQ(ours.merge(pathOf("lab.db"), large, {3, 1}).runs, 2);
  EXPECT_EQ(ours.experiments().size(), 2u);
}

TEST_F(Merge, LargeTracesStayBehindAndTheirHashesComeAlong) {
  Database ours = create();
  Database theirs = Database::open(pathOf("lab.db"), Mode::create);
  const Id run = fill(theirs, 1, "kick");
  ours.merge(pathOf("lab.db"), 100);
  const auto here = ours.individuals(run, 2), there = theirs.individuals(run, 2);
  EXPECT_FALSE(ours.trace(here[0].id));
  EXPECT_TRUE(ours.trace(here[1].id));
  EXPECT_EQ(here[0].traceSha256, there[0].traceSha256);
}

TEST_F(Merge, RefusesWhatIsThereAlreadyAndCopiesNothing) {
  Database ours = create();
  fill(ours, 1, "kick");
  Database theirs = Database::open(pathOf("lab.db"), Mode::create);
  fill(theirs, 2, "kick");
  ours.merge(pathOf("lab.db"), large);
  fill(theirs, 3, "kick");
  const auto before = counts(file());
  EXPECT_THAT(refusal([&] { ours.merge(pathOf("lab.db"), large); }),
              testing::AllOf(HasSubstr("run 2 is run 1 of "), HasSubstr("nothing was copied")));
  EXPECT_THAT(refusal([&] { ours.merge(file(), large); }), HasSubstr("its own runs are there already"));
  EXPECT_THAT(refusal([&] { ours.merge(pathOf("no.db"), large); }), HasSubstr("there is no such file"));
  EXPECT_EQ(counts(file()), before);
  // And what follows is stored as ever.
  fill(ours, 9, "kick");
}

// A rig that is in both databases is one; what the other one found follows behind what ours did.
TEST_F(Merge, VersionsOfARigFollowOurs) {
  Database ours = create();
  fill(ours, 1, "ours");
  Database theirs = Database::open(pathOf("lab.db"), Mode::create);
  const auto adopt = [](Database& db, const std::string& spec, double gain) {
    const Id rig = db.addRig({0, "servo", spec, "", ""}, SimulatorRecord{});
    SimulatorRecord version;
    version.rig = rig;
    version.parent = db.rigSimulators(rig).back().id;
    version.number = db.rigSimulators(rig).back().number + 1;
    version.simulator.values = {{"friction", gain}};
    db.addRigSimulator(version);
    return rig;
  };
  const Id rig = adopt(ours, "{}", 1);
  adopt(theirs, "{\"only\": \"theirs\"}", 3);
  adopt(theirs, "{}", 2);
  ours.merge(pathOf("lab.db"), large);
  const auto all = ours.rigSimulators(rig);
  ASSERT_EQ(all.size(), 4u);
  for (int number = 0; number < 4; ++number) EXPECT_EQ(all[static_cast<std::size_t>(number)].number, number);
  EXPECT_EQ(all[1].simulator.values.at("friction"), 1);
  EXPECT_TRUE(all[2].simulator.values.empty());  // as given, again
  EXPECT_EQ(all[3].simulator.values.at("friction"), 2);
  EXPECT_EQ(all[3].parent, all[2].id);
  EXPECT_EQ(ours.rigSimulators(0).size(), 6u);
  EXPECT_EQ(number(file(), "SELECT count(*) FROM pragma_foreign_key_check"), 0);

  EXPECT_THAT(refusal([&] { ours.merge(pathOf("lab.db"), large); }), HasSubstr("nothing was copied"));
  EXPECT_EQ(ours.rigSimulators(0).size(), 6u);
}

}  // namespace
}  // namespace btr
