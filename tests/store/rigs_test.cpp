// Rigs: experiments without runs, with simulator versions of their own.
#include <SQLiteCpp/SQLiteCpp.h>

#include "core/store/migrations.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;

class Rigs : public StoreTest {
 protected:
  Rigs() : database_(create()), rig_(add("servo", "{\"a\": 1}")) {}
  Id add(const std::string& name, const std::string& spec) {
    SimulatorRecord asGiven;
    asGiven.madeBy = "start";
    return database_.addRig({0, name, spec, "", ""}, asGiven);
  }
  SimulatorRecord next(int number, double gain) {
    SimulatorRecord version;
    version.rig = rig_;
    version.number = number;
    version.parent = database_.rigSimulators(rig_).back().id;
    version.simulator = {{{"robots.arm.servos.elbow.p", gain}},
                         {{"backlash", "arm.elbow", {{"width_rad", 1.0 / 7}, {"damping_nm_s_rad", 1e-300}}}}};
    version.madeBy = "gap analysis";
    version.evidence = "{\"sentence\":\"play\"}";
    return version;
  }
  Database database_;
  Id rig_;
};

TEST_F(Rigs, VersionsKeepTheirBitsAndTheirParents) {
  const SimulatorRecord wanted = next(1, 1.0 / 3);
  const Id id = database_.addRigSimulator(wanted);
  const auto all = Database::open(file(), Database::Mode::readOnly).rigSimulators(rig_);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].number, 0);
  EXPECT_EQ(all[0].simulator, SimulatorSpec{});
  EXPECT_EQ(all[0].parent, 0);
  EXPECT_EQ(all[1].id, id);
  EXPECT_EQ(all[1].rig, rig_);
  EXPECT_EQ(all[1].run, 0);
  EXPECT_EQ(all[1].parent, all[0].id);
  EXPECT_EQ(all[1].simulator, wanted.simulator);
  EXPECT_EQ(all[1].madeBy, "gap analysis");
  EXPECT_EQ(all[1].evidence, wanted.evidence);
}

TEST_F(Rigs, TheSameSpecificationIsOneRig) {
  EXPECT_EQ(add("another name", "{\"a\": 1}"), rig_);
  EXPECT_EQ(database_.rigSimulators(rig_).size(), 1u);
  const Id other = add("servo", "{\"a\": 2}");
  EXPECT_NE(other, rig_);
  database_.addRigSimulator(next(1, 2));
  EXPECT_EQ(database_.rigSimulators(other).size(), 1u);
  EXPECT_EQ(database_.rigSimulators(0).size(), 3u);
}

TEST_F(Rigs, OfTwoThatFollowTheSameVersionTheSecondIsRefused) {
  const SimulatorRecord one = next(1, 2), other = next(1, 3);
  database_.addRigSimulator(one);
  EXPECT_THAT(refusal([&] { database_.addRigSimulator(other); }),
              HasSubstr("simulator version 1 is not allowed; the next of rig"));
  EXPECT_EQ(database_.rigSimulators(rig_).size(), 2u);
}

TEST_F(Rigs, AParentIsAVersionOfTheSameRig) {
  const Id other = add("other", "{\"a\": 2}");
  SimulatorRecord version = next(1, 2);
  version.parent = database_.rigSimulators(other).front().id;
  EXPECT_NE("accepted", refusal([&] { database_.addRigSimulator(version); }));
  EXPECT_EQ(database_.rigSimulators(rig_).size(), 1u);
}

TEST_F(Rigs, AnExperimentWithRunsIsNoRig) {
  const Id experiment = database_.addExperiment(kickExperiment());
  SimulatorRecord version;
  version.rig = experiment;
  EXPECT_NE("accepted", refusal([&] { database_.addRigSimulator(version); }));
  EXPECT_TRUE(database_.rigSimulators(experiment).empty());
}

TEST_F(Rigs, WhatWasFoundIsKept) {
  database_.addRigSimulator(next(1, 2));
  SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
  EXPECT_THROW(raw.exec("DELETE FROM rig_simulator"), SQLite::Exception);
  EXPECT_THROW(raw.exec("UPDATE rig_simulator SET simulator_json = '{}'"), SQLite::Exception);
}

TEST_F(Rigs, OfADatabaseFromBeforeThemComeWhenItIsOpenedForWriting) {
  const std::string old = pathOf("old.db");
  {
    SQLite::Database raw(old, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    migrate(raw, migrations().first(5));
  }
  EXPECT_TRUE(Database::open(old, Database::Mode::readWrite).rigSimulators(0).empty());
}

}  // namespace
}  // namespace btr
