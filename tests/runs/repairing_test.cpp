// Recordings of the measured individuals, their analysis and its adoption as a stage of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/reality/recorded_robot.h"
#include "core/run/reality/stand_in.h"
#include "core/run/reality/stored_recordings.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/genotypes.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

/// Two generations of four, two measured after each; after the first, one is recorded hung up and a knee is compared.
class Repairing : public testing::Test {
 protected:
  Repairing() : host_(PLUGIN_DIR) {
    setenv("UCHILSIM_BTR", BTR_PROGRAM, 1);
    text_ = nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json"));
    text_["controller"]["settings"] = {{"accumulate_s", 0.1}, {"hold_s", 0.0}, {"return_s", 0.1}};
    text_["learner"]["settings"]["population"] = 4;
    text_["adaptation"]["learner"]["settings"]["population"] = 2;
    text_["adaptation"]["settings"]["generations"] = 1;
    text_["stages"] = {
        {"first_generations", 1}, {"next_generations", 1}, {"total_generations", 2}, {"measured_individuals", 2}};
    text_["stand_in"]["hidden_effects"] = 0;
    text_["recordings"] = {{"settings", {{"after_stage", 1}, {"individuals", 1}, {"maximum_effects", 0}}},
                           {"joints", {"ers7.LF_J3"}}};
  }
  ExperimentSpec spec() const { return experimentFromJson(text_.dump(), "kick", SOURCE_DIR "/resources/experiments"); }
  RunEnd goOn(Database& database, Id run, int jobs, bool without = false) {
    RunOptions options;
    options.jobs = jobs;
    options.withoutRecordings = without;
    return continueRun(database, host_, run, StopFlag{false}, options);
  }
  /// A run whose first stage a person has measured, all at 0.5; it waits.
  Id measuredByAPerson(Database& database) {
    text_["reality"] = "person";
    const Id run = startRun(database, host_, spec(), 7);
    EXPECT_EQ(goOn(database, run, 1), RunEnd::waiting);
    for (const MeasurementTask& task : database.measurementTasks(run, 1)) {
      MeasurementRecord value;
      value.run = run;
      value.individual = task.individual;
      value.value = 0.5;
      database.addMeasurement(value);
    }
    return run;
  }
  /// The individual's recording by a robot that is as that simulator; the file's path.
  std::string record(const PreparedExperiment& prepared, const SimulatorSpec& robot, std::span<const double> parameters,
                     RobotPose pose, const std::string& name, Random& noise) const {
    const std::string csv = folder_.file(name);
    writeRecording(prepared.trial(recordedScene(prepared, robot, pose), parameters, 1, true).trace, csv, pose, noise);
    return csv;
  }
  Database fresh(const std::string& name) { return Database::open(folder_.file(name), Database::Mode::create); }

  TemporaryFolder folder_;
  PluginHost host_;
  nlohmann::json text_;
};

TEST_F(Repairing, TheStandInIsRecordedAndTheRunGoesOnInTheRepairedSimulator) {
  Database database = fresh("a.db");
  const Id run = startRun(database, host_, spec(), 7);
  ASSERT_EQ(goOn(database, run, 1), RunEnd::finished);

  const auto recordings = database.recordings(database.run(run).experiment);
  ASSERT_EQ(recordings.size(), 1u);
  EXPECT_EQ(recordings[0].individual, database.measurementTasks(run, 1)[0].individual);
  EXPECT_EQ(recordings[0].source, "stand-in reality");
  const std::vector<SimulatorRecord> all = database.simulators(run);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[1].madeBy, "gap analysis");
  EXPECT_EQ(all[1].parent, all[0].id);
  EXPECT_EQ(all[1].madeAfterGeneration, 1);
  EXPECT_EQ(all[2].madeBy, "L3");
  EXPECT_EQ(all[2].parent, all[1].id);
  EXPECT_EQ(all[3].madeBy, "L3");
  const nlohmann::json evidence = nlohmann::json::parse(all[1].evidence);
  EXPECT_EQ(evidence["recordings_sha256"][0], recordings[0].sha256);
  EXPECT_TRUE(evidence["calibrated"].contains("servo_p_nm_rad"));

  EXPECT_LT(evidence["ladder"].back()["error_in_noise_floors"], evidence["ladder"].front()["error_in_noise_floors"]);

  // The same bits with another number of workers.
  Database other = fresh("b.db");
  const Id again = startRun(other, host_, spec(), 7);
  ASSERT_EQ(goOn(other, again, 2), RunEnd::finished);
  const auto second = other.simulators(again);
  ASSERT_EQ(second.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(second[i].simulator, all[i].simulator);
  EXPECT_EQ(other.lastGeneration(again)->best, database.lastGeneration(run)->best);
}

/// How many values of the p gain L3 tried outside the interval that the recordings had told, and of how many.
std::pair<int, int> outsideOfWhatWasTold(const Database& database, Id run) {
  const nlohmann::json told =
      nlohmann::json::parse(database.simulators(run)[1].evidence)["calibrated"]["servo_p_nm_rad"];
  int outside = 0, all = 0;
  for (const int stage : {1, 2})
    for (const AdaptationRecord& generation : database.adaptations(run, stage))
      for (const AdaptationCandidate& candidate : generation.candidates) {
        const double p = candidate.parameters.at(1);  // beside the mass of the body
        outside += p < told["ci95"][0] || p > told["ci95"][1];
        ++all;
      }
  return {outside, all};
}

TEST_F(Repairing, L3LeavesWhatRecordingsToldInItsIntervalWhereThatIsWanted) {
  text_["adaptation"]["parameters"] = {"servo_p_nm_rad", "body_mass_kg"};
  // Long enough for a knee to tell its gain.
  text_["controller"]["settings"] = {{"accumulate_s", 0.4}, {"hold_s", 0.3}, {"return_s", 0.4}};
  for (const char* wanted : {"anywhere", "within_intervals"}) {
    text_["recordings"]["settings"]["told_numbers"] = wanted;
    Database database = fresh(std::string(wanted) + ".db");
    const Id run = startRun(database, host_, spec(), 7);
    ASSERT_EQ(goOn(database, run, 2), RunEnd::finished);
    const auto [outside, all] = outsideOfWhatWasTold(database, run);
    EXPECT_EQ(all, 4) << wanted;
    if (wanted == std::string("anywhere"))
      EXPECT_GT(outside, 0);  // of 2 to 30 N·m/rad
    else
      EXPECT_EQ(outside, 0);
  }
}

TEST_F(Repairing, InBothPosesFewerMayHangThanStand) {
  text_["recordings"]["settings"]["robot"] = "hung_up_then_on_floor";
  text_["recordings"]["settings"]["individuals"] = 2;
  text_["recordings"]["settings"]["hung_up_individuals"] = 1;
  text_["recordings"]["effects_on_floor"] = {"contact_compliance"};
  Database database = fresh("a.db");
  const Id run = startRun(database, host_, spec(), 7);
  ASSERT_EQ(goOn(database, run, 2), RunEnd::finished);
  std::map<RobotPose, std::vector<Id>> recorded;
  for (const RecordingRecord& recording : database.recordings(database.run(run).experiment))
    recorded[poseOf(loadRecording(exportRecording(database, recording.id, folder_.file("out"))))].push_back(
        recording.individual);
  const std::vector<MeasurementTask> tasks = database.measurementTasks(run, 1);
  EXPECT_EQ(recorded[RobotPose::hungUp], std::vector{tasks[0].individual});
  EXPECT_EQ(recorded[RobotPose::onFloor], (std::vector{tasks[0].individual, tasks[1].individual}));
  EXPECT_EQ(nlohmann::json::parse(database.simulators(run)[2].evidence)["recordings"].size(), 2u);
}

TEST_F(Repairing, InBothPosesEachIsRecordedAndAnalysedAndTheSecondBuildsOnTheFirst) {
  text_["recordings"]["settings"]["robot"] = "hung_up_then_on_floor";
  text_["recordings"]["effects_on_floor"] = {"contact_compliance"};
  Database database = fresh("a.db");
  const Id run = startRun(database, host_, spec(), 7);
  ASSERT_EQ(goOn(database, run, 2), RunEnd::finished);

  const Id individual = database.measurementTasks(run, 1)[0].individual;
  const auto recordings = database.recordings(database.run(run).experiment);
  ASSERT_EQ(recordings.size(), 2u);
  std::vector<Recording> first;
  for (const RecordingRecord& recording : recordings) {
    EXPECT_EQ(recording.individual, individual);
    first.push_back(loadRecording(exportRecording(database, recording.id, folder_.file("out"))));
  }
  EXPECT_EQ(poseOf(first[0]), RobotPose::hungUp);
  EXPECT_EQ(poseOf(first[1]), RobotPose::onFloor);

  const std::vector<SimulatorRecord> all = database.simulators(run);
  ASSERT_GE(all.size(), 4u);
  const auto evidence = [&](std::size_t version) { return nlohmann::json::parse(all[version].evidence); };
  for (std::size_t version : {1u, 2u}) {
    EXPECT_EQ(all[version].madeBy, "gap analysis");
    EXPECT_EQ(all[version].parent, all[version - 1].id);
    EXPECT_EQ(evidence(version)["recordings"], nlohmann::json{recordings[version - 1].id});
  }
  EXPECT_EQ(all[3].madeBy, "L3");
  EXPECT_EQ(evidence(1)["robot"], "hung_up");
  EXPECT_TRUE(evidence(1)["calibrated"].contains("servo_p_nm_rad"));
  EXPECT_EQ(evidence(2)["robot"], "on_floor");
  EXPECT_EQ(evidence(2)["calibrated"].size(), 3u);
  for (const char* name : {"friction", "slip1_m_s_n", "slip2_m_s_n"})
    EXPECT_TRUE(evidence(2)["calibrated"].contains(name)) << name;
  // What the hung-up robot said of its servos stays.
  EXPECT_EQ(all[2].simulator.values.at("servo_p_nm_rad"), all[1].simulator.values.at("servo_p_nm_rad"));
}

TEST_F(Repairing, AFloorThatNobodyMeasuredIsToldByRecordingsOnIt) {
  text_["recordings"]["settings"]["robot"] = "hung_up_then_on_floor";
  PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  prepared.sceneSpec.step_s = 0.002;
  const SimulatorSpec given = spec().simulator;
  SimulatorSpec real = given;
  const std::map<std::string, double> truth{{"friction", 0.7}, {"slip1_m_s_n", 0.002}, {"slip2_m_s_n", 0.03}};
  for (const auto& [name, value] : truth) real.values[name] = value;
  std::vector<Recording> recordings;
  Random noise(3), kicks(4);
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> kick = test::drawnFrom(prepared.genotype, kicks);
    const std::string name = "floor" + std::to_string(i) + ".csv";
    recordings.push_back(loadRecording(record(prepared, real, kick, RobotPose::onFloor, name, noise)));
  }
  AnalysisOptions options;
  options.maximumEffects = 0;
  options.designNext = options.learnRest = false;
  options.effects = {"contact_compliance"};
  const auto analysed = [&](const SimulatorSpec& simulator) {
    return analyse(recordedProblem(prepared, simulator, recordings, RobotPose::onFloor),
                   {host_.effectFactory(), host_.effects()}, options);
  };
  // The simulator that made them leaves noise alone: no foot slips at the start that the recording does not show.
  EXPECT_EQ(toText(analysed(real).verdict), std::string("no_mismatch"));

  const GapReport report = analysed(given);
  EXPECT_EQ(toText(report.verdict), std::string("parameters_suffice")) << report.sentence;
  ASSERT_EQ(report.calibrated.size(), truth.size());
  for (const GapReport::Number& number : report.calibrated) {
    const double off = std::abs(number.value - truth.at(number.name));
    // Twice the half width of 95 %: of three numbers one lies outside its 95 % in one of seven draws of noise.
    EXPECT_LT(off, number.ci95.high - number.ci95.low) << number.name << " " << number.value;
    EXPECT_LT(off, 0.25 * std::abs(number.before - truth.at(number.name))) << number.name << " " << number.value;
  }
}

TEST_F(Repairing, AfterHangingEffectsOfTheFloorAreConsideredUnlessOthersAreNamed) {
  text_["recordings"]["settings"]["robot"] = "hung_up_then_on_floor";
  const auto considered = [&](RobotPose pose) {
    return consideredEffects(prepareFromFiles(spec(), host_), host_, pose);
  };
  const std::vector<std::string> hung = considered(RobotPose::hungUp), floor = considered(RobotPose::onFloor);
  EXPECT_EQ(hung.size() + floor.size(), host_.effects().size());
  EXPECT_EQ(std::ranges::count(hung, "backlash"), 1);
  EXPECT_EQ(std::ranges::count(floor, "slip"), 1);
  text_["recordings"]["effects_on_floor"] = {"restitution"};
  EXPECT_EQ(considered(RobotPose::onFloor), std::vector<std::string>{"restitution"});
  text_["recordings"].erase("effects_on_floor");
  text_["recordings"]["settings"]["robot"] = "on_floor";
  EXPECT_EQ(considered(RobotPose::onFloor), host_.effects());
}

TEST_F(Repairing, WithAPersonTheRunWaitsForRecordingsAndTakesThoseThatAreAttached) {
  Database database = fresh("a.db");
  const Id run = measuredByAPerson(database);
  const std::vector<MeasurementTask> tasks = database.measurementTasks(run, 1);
  ASSERT_EQ(goOn(database, run, 1), RunEnd::waiting);
  EXPECT_THAT(database.run(run).message, HasSubstr("1 of 1 individuals wait for a recording"));
  ASSERT_EQ(database.simulators(run).size(), 1u);

  // The same robot as simulated, recorded by somebody.
  const PreparedExperiment prepared = prepareFromRun(database.run(run), host_);
  const SimulatorSpec plain = database.latestSimulator(run).simulator;
  Random noise(3);
  const auto parameters = database.individual(tasks[0].individual).parameters;
  const std::string csv = record(prepared, plain, parameters, RobotPose::hungUp, "knee.csv", noise);
  importRecording(database, database.run(run).experiment, csv, "", tasks[0].individual);
  ASSERT_EQ(goOn(database, run, 1), RunEnd::waiting);  // for the second stage's measurements
  EXPECT_EQ(database.simulators(run).at(1).madeBy, "gap analysis");
  EXPECT_EQ(database.run(run).stage, 1);
}

TEST_F(Repairing, WithAPersonBothPosesAreAskedForOneAfterTheOther) {
  text_["recordings"]["settings"]["robot"] = "hung_up_then_on_floor";
  text_["recordings"]["effects_on_floor"] = {"contact_compliance"};
  Database database = fresh("a.db");
  const Id run = measuredByAPerson(database);
  const std::vector<MeasurementTask> tasks = database.measurementTasks(run, 1);
  const PreparedExperiment prepared = prepareFromRun(database.run(run), host_);
  const SimulatorSpec plain = database.latestSimulator(run).simulator;
  const auto parameters = database.individual(tasks[0].individual).parameters;
  const auto attach = [&](RobotPose pose) {
    Random noise(3);
    const std::string csv = record(prepared, plain, parameters, pose, std::string(toText(pose)) + ".csv", noise);
    importRecording(database, database.run(run).experiment, csv, "", tasks[0].individual);
  };
  // The order in which they come does not matter.
  attach(RobotPose::onFloor);
  ASSERT_EQ(goOn(database, run, 1), RunEnd::waiting);
  EXPECT_THAT(database.run(run).message, HasSubstr("1 of 1 individuals wait for a recording of the robot hung up"));
  ASSERT_EQ(database.simulators(run).size(), 1u);
  attach(RobotPose::hungUp);
  ASSERT_EQ(goOn(database, run, 1), RunEnd::waiting);  // for the second stage's measurements
  EXPECT_EQ(database.run(run).stage, 1);
  ASSERT_GE(database.simulators(run).size(), 3u);
  EXPECT_EQ(nlohmann::json::parse(database.simulators(run)[1].evidence)["robot"], "hung_up");
  EXPECT_EQ(nlohmann::json::parse(database.simulators(run)[2].evidence)["robot"], "on_floor");
}

TEST_F(Repairing, WithAPersonItGoesOnWithoutRecordingsIfToldSo) {
  Database database = fresh("a.db");
  const Id run = measuredByAPerson(database);
  ASSERT_EQ(goOn(database, run, 1, true), RunEnd::waiting);
  EXPECT_EQ(database.run(run).stage, 1);
  EXPECT_EQ(database.simulators(run).at(1).madeBy, "L3");
}

TEST_F(Repairing, AHungRobotMovesItsLegsAndStaysWhereItHangs) {
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  const Scene hung = recordedScene(prepared, spec().simulator, RobotPose::hungUp),
              stands = prepared.scene(spec().simulator);
  EXPECT_FALSE(hung.robots[0].freeBase);
  EXPECT_DOUBLE_EQ(hung.robots[0].start.translation().z(), stands.robots[0].start.translation().z() + 1);
  const std::vector<double> middle = test::middleOf(prepared.genotype);
  const TrialResult result = prepared.trial(hung, middle, 1, true);
  EXPECT_EQ(result.baseEnd_m, result.baseStart_m);
  EXPECT_EQ(result.balls[0].rest_m.head<2>(), result.balls[0].start_m.head<2>());

  // On the floor it is the trial itself.
  text_["recordings"]["settings"]["robot"] = "on_floor";
  const PreparedExperiment free = prepareFromFiles(spec(), host_);
  EXPECT_TRUE(recordedScene(free, spec().simulator, RobotPose::onFloor).robots[0].freeBase);
  EXPECT_EQ(recordedProblem(free, spec().simulator, {}, RobotPose::onFloor).scene.robots[0].base, "free");
  EXPECT_EQ(recordedProblem(prepared, spec().simulator, {}, RobotPose::hungUp).scene.robots[0].base, "fixed");
}

TEST_F(Repairing, OnlyTheNamedJointsAreCompared) {
  text_["recordings"]["calibrate"] = {"servo_p_nm_rad"};
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  Recording recording;
  recording.channels = {"time_s", "ers7.LF_J3.command_rad", "ers7.LF_J3.position_rad", "ers7.RF_J3.position_rad"};
  recording.columns = {{0, 1}, {0, 0}, {1, 1}, {2, 2}};
  const GapProblem problem = recordedProblem(prepared, spec().simulator, {recording}, RobotPose::hungUp);
  EXPECT_EQ(problem.recordings[0].channels,
            (std::vector<std::string>{"time_s", "ers7.LF_J3.command_rad", "ers7.LF_J3.position_rad"}));
  ASSERT_EQ(problem.scene.calibrate.size(), 1u);
  EXPECT_EQ(problem.scene.calibrate[0].path, "servo_p_nm_rad");
  // Within half of 7.5 N·m/rad, the experiment's own number.
  EXPECT_DOUBLE_EQ(problem.scene.calibrate[0].minimum, 3.75);
  EXPECT_DOUBLE_EQ(problem.scene.calibrate[0].maximum, 11.25);
}

TEST_F(Repairing, AfterHangingTheFloorMayBeAskedForThePlacesOfBodyAndBallAlone) {
  const std::vector<std::string> joints{"ers7.LF_J3.position_rad", "ers7.RF_J3.position_rad"};
  Recording recording;
  recording.channels = {"time_s", joints[0], joints[1], "ers7.base.x_m", "ball.x_m"};
  recording.columns = {{0, 1}, {1, 1}, {2, 2}, {0, 0}, {0, 0}};
  const auto notCompared = [&](RobotPose pose) {
    return recordedProblem(prepareFromFiles(spec(), host_), spec().simulator, {recording}, pose)
        .recordings[0]
        .notCompared;
  };
  auto& settings = text_["recordings"]["settings"];
  settings["robot"] = "hung_up_then_on_floor";
  EXPECT_THAT(notCompared(RobotPose::onFloor), testing::IsEmpty());
  settings["floor_compares"] = "body_and_ball";
  EXPECT_EQ(notCompared(RobotPose::onFloor), joints);
  // Nothing but the floor's recordings tells of the servos.
  settings["robot"] = "on_floor";
  EXPECT_EQ(notCompared(RobotPose::onFloor), std::vector{joints[1]});  // as the experiment names LF_J3 alone
}

TEST_F(Repairing, OnTheFloorAsManySecondsAreComparedAsAreWantedAndNoVelocityIsAsked) {
  text_["recordings"]["settings"]["robot"] = "on_floor";
  const std::vector<double> middle = test::middleOf(prepareFromFiles(spec(), host_).genotype);
  const SimulatorSpec plain = spec().simulator;
  Random noise(3);
  const std::string csv =
      record(prepareFromFiles(spec(), host_), plain, middle, RobotPose::onFloor, "floor.csv", noise);
  const EffectLibrary library{host_.effectFactory(), host_.effects()};
  for (const double wanted_s : {0.1, 0.2}) {
    text_["recordings"]["settings"]["floor_compared_s"] = wanted_s;
    const GapProblem given =
        recordedProblem(prepareFromFiles(spec(), host_), plain, {loadRecording(csv)}, RobotPose::onFloor);
    const FitProblem problem = makeFitProblem(given, given.recordings, library);
    const std::vector<double>& time = problem.trials[0].recording.columns[0];
    ASSERT_LT(problem.trials[0].rows(), time.size());
    EXPECT_LE(time[problem.trials[0].rows() - 1], wanted_s);
    EXPECT_GT(time[problem.trials[0].rows()], wanted_s);
    for (const Nuisance& nuisance : problem.segments[0].nuisances) {
      EXPECT_NE(nuisance.what, Nuisance::What::baseVelocity);
      EXPECT_NE(nuisance.what, Nuisance::What::ballVelocity);
      EXPECT_NE(nuisance.what, Nuisance::What::jointRate);
    }
  }
}

TEST_F(Repairing, BranchesThatNobodyComparesCanBeLeftOutOfAHungRobot) {
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  const std::vector<double> middle = test::middleOf(prepared.genotype);
  Random noise(3);
  const SimulatorSpec plain = spec().simulator;
  const std::string csv = record(prepared, plain, middle, RobotPose::hungUp, "legs.csv", noise);

  // One knee as it is replayed with all other joints moving, and alone with its leg.
  const auto knee = [&](const std::vector<std::string>& joints) {
    PreparedExperiment asked = prepared;
    asked.spec.recordings.joints = joints;
    const GapProblem problem = recordedProblem(asked, plain, {loadRecording(csv)}, RobotPose::hungUp);
    const Scene scene = makeScene(problem.scene, problem.models, plain, prepared.effects);
    const Recording& recording = problem.recordings[0];
    const Binding binding = bind(scene, recording);
    const auto replayed = replayRecording(scene, recording, binding, startState(scene, recording, binding));
    const auto column = static_cast<std::size_t>(recording.column("ers7.LF_J3.position_rad"));
    std::vector<double> values;
    for (std::size_t c = 0; c < binding.measured.size(); ++c)
      if (binding.measured[c].column == column) values = replayed.values[c];
    return std::pair(values, recording.columns[column]);
  };
  const auto [all, recorded] = knee({});
  const auto [alone, same] = knee({"ers7.LF_J3"});
  ASSERT_EQ(all.size(), recorded.size());
  ASSERT_EQ(alone.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(alone[i], all[i], 1e-9);
    // And as it was recorded: the commands hold from the rows in which they stand, and the robot starts at rest. At
    // 5 rad/s a quarter of a period is 10 mrad.
    EXPECT_NEAR(all[i], recorded[i], 0.01) << i;
  }
}

TEST_F(Repairing, AServoBeginsAtRestOrInMotionWhicheverItsSamplesSay) {
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  const std::vector<double> middle = test::middleOf(prepared.genotype);
  Random noise(3);
  const SimulatorSpec plain = spec().simulator;
  const std::string csv = record(prepared, plain, middle, RobotPose::hungUp, "legs.csv", noise);
  const Scene scene = recordedScene(prepared, plain, RobotPose::hungUp);
  Recording recording = loadRecording(csv);
  const auto column = static_cast<std::size_t>(recording.column("ers7.LF_J3.position_rad"));
  const auto rate = [&] {
    const Binding binding = bind(scene, recording);
    const auto part = static_cast<std::size_t>(scene.robots[0].model.findJoint("LF_J3"));
    return startState(scene, recording, binding).robots[0].rates[part];
  };
  EXPECT_EQ(rate(), 0);  // it jumps off with the first command, but it stood

  // The same from its sixth sample on, where the knee is in full swing.
  const auto& q = recording.columns[column];
  const double swing = (q[7] - q[5]) / (recording.columns[0][7] - recording.columns[0][5]);
  for (auto& values : recording.columns) values.erase(values.begin(), values.begin() + 6);
  EXPECT_NEAR(rate(), swing, 0.1 * std::abs(swing));
}

TEST_F(Repairing, OnTheFloorARecordingBeginsWhereItsFirstSampleSaysAndAtRest) {
  text_["recordings"]["settings"]["robot"] = "on_floor";
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  const std::vector<double> middle = test::middleOf(prepared.genotype);
  Random noise(3);
  const SimulatorSpec plain = spec().simulator;
  const std::string csv = record(prepared, plain, middle, RobotPose::onFloor, "floor.csv", noise);
  const GapProblem problem = recordedProblem(prepared, plain, {loadRecording(csv)}, RobotPose::onFloor);
  const Recording& recording = problem.recordings[0];
  EXPECT_GE(recording.column("ers7.base.x_m"), 0);
  const Scene scene = makeScene(problem.scene, problem.models, plain, prepared.effects);
  const Binding binding = bind(scene, recording);
  const StartState state = startState(scene, recording, binding);
  for (std::size_t j = 0; j < state.robots[0].rates.size(); ++j) {
    EXPECT_EQ(state.robots[0].rates[j], 0);
    const int column = recording.column("ers7." + scene.robots[0].model.joints[j].name + ".position_rad");
    if (column < 0) continue;
    EXPECT_EQ(state.robots[0].positions[j], recording.columns[static_cast<std::size_t>(column)][0]) << column;
  }
  EXPECT_EQ(state.robots[0].velocity_m_s, Eigen::Vector3d::Zero());
  EXPECT_EQ(state.balls[0].velocity_m_s, Eigen::Vector3d::Zero());
}

TEST_F(Repairing, TheStandInDrawsFromWhatTheExperimentNames) {
  text_["stand_in"]["hidden_effects"] = 1;
  text_["stand_in"]["effect_size"] = 2.5;
  text_["concealed"] = {{"effects", {"backlash"}}, {"at", {"ers7.LF_J3", "ers7.RF_J3"}}};
  std::set<std::string> places;
  for (int seed = 1; seed <= 12; ++seed) {
    text_["stand_in"]["seed"] = seed;
    const Concealed concealed = drawConcealed(prepareFromFiles(spec(), host_), host_);
    ASSERT_EQ(concealed.simulator.effects.size(), 1u);
    const PlacedEffect& hidden = concealed.simulator.effects[0];
    EXPECT_EQ(hidden.effect, "backlash");
    places.insert(hidden.at);
    EXPECT_GE(hidden.parameters.at("width_rad"), 0.5 * 2.5 * 0.02);
    EXPECT_LE(hidden.parameters.at("width_rad"), 1.5 * 2.5 * 0.02);
  }
  EXPECT_EQ(places, (std::set<std::string>{"ers7.LF_J3", "ers7.RF_J3"}));
  text_["concealed"]["at"] = {"floor"};
  EXPECT_THROW(drawConcealed(prepareFromFiles(spec(), host_), host_), InputError);
}

TEST_F(Repairing, TheStandInsWorldHasItsOwnStepAndIfWantedAnotherRobotForEachSeed) {
  text_["stand_in"]["step_s"] = 0.001;
  const PreparedExperiment prepared = prepareFromFiles(spec(), host_);
  EXPECT_EQ(asReality(prepared, 1).sceneSpec.step_s, 0.001);
  const auto drawn = [&](std::uint64_t run) {
    return drawConcealed(asReality(prepareFromFiles(spec(), host_), run), host_).simulator;
  };
  EXPECT_EQ(drawn(1), drawn(2));
  text_["stand_in"]["drawn_by"] = "run_seed";
  EXPECT_NE(drawn(1), drawn(2));
  EXPECT_EQ(drawn(2), drawn(2));
  text_["stand_in"]["step_s"] = 0.003;
  EXPECT_THROW(asReality(prepareFromFiles(spec(), host_), 1), InputError);
}

}  // namespace
}  // namespace btr
