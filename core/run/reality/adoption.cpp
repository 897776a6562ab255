#include "core/run/reality/adoption.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/report/report_files.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/run/reality/identified_numbers.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/run/setup/run_lock.h"
#include "core/sim/scene.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

std::string nameOf(const Database& database, Id run) { return "run " + std::to_string(run) + " of " + database.path(); }

/// With the run's lock held: nobody else changes its state meanwhile.
void requireRest(const Database& database, const RunRecord& run) {
  const std::string allowed = "while a run waits for measurements or is stopped";
  if (run.state == RunState::finished)
    throw InputError(nameOf(database, run.id) + ": the run is finished; another simulator is taken " + allowed);
  if (!database.adaptations(run.id, run.stage + 1).empty())
    throw InputError(nameOf(database, run.id) + ": the adaptation of stage " + std::to_string(run.stage + 1) +
                     " has begun with the present simulator; continue the run until it has ended. "
                     "Another simulator is taken " +
                     allowed);
}

/// A version of the same run or rig that follows `parent`, not stored yet.
SimulatorRecord versionAfter(const SimulatorRecord& parent, SimulatorSpec simulator, const std::string& madeBy,
                             const std::string& evidence) {
  SimulatorRecord version;
  version.run = parent.run;
  version.rig = parent.rig;
  version.parent = parent.id;
  version.simulator = std::move(simulator);
  version.madeBy = madeBy;
  version.evidence = evidence;
  version.createdAt = utcNow();
  return version;
}

SimulatorRecord addToRun(Database& database, const RunRecord& run, SimulatorRecord version) {
  version.madeAfterGeneration = run.generation;
  return database.simulator(database.addSimulator(version));
}

std::string evidenceOf(const std::string& report, const GapReport& found, const std::string& hash) {
  nlohmann::json evidence{{"report", std::filesystem::absolute(report).lexically_normal().string()},
                          {"report_sha256", hash},
                          {"verdict", toText(found.verdict)},
                          {"sentence", found.sentence},
                          {"calibrated", toEvidence(found.calibrated)},
                          {"seed", found.seed},
                          {"version", found.version},
                          {"recordings_sha256", nlohmann::json::array()}};
  for (const GapReport::Trial& trial : found.trials) evidence["recordings_sha256"].push_back(trial.sha256);
  return evidence.dump();
}

/// A simulator from files with what says where it comes from.
struct Found {
  SimulatorSpec simulator;
  std::string evidence;     ///< JSON text
  std::string sceneSha256;  ///< of the report; "" without one
};

Found readFound(const std::string& simulator, const std::string& report) {
  const std::string text = readFile(simulator);
  Found found{simulatorFromJson(text, simulator), "", ""};
  if (report.empty()) {
    const nlohmann::json file{{"simulator_file", std::filesystem::absolute(simulator).lexically_normal().string()},
                              {"simulator_sha256", sha256(text)}};
    found.evidence = file.dump();
    return found;
  }
  const GapReport gap = loadReport(report);
  if (gap.after != found.simulator)
    throw InputError(simulator + ": is not the simulator that the report in " + report + " has found");
  found.evidence = evidenceOf(report, gap, sha256(readFile((std::filesystem::path(report) / "report.json").string())));
  found.sceneSha256 = gap.sceneSha256;
  return found;
}

/// What is adopted after `parent`: values that `simulator` does not name stay as they were. Refuses what changes
/// nothing.
SimulatorSpec inheriting(SimulatorSpec simulator, const SimulatorRecord& parent, const std::string& owner) {
  for (const auto& [name, value] : parent.simulator.values) simulator.values.try_emplace(name, value);
  if (simulator == parent.simulator)
    throw InputError(owner + ": its version " + std::to_string(parent.number) + " is this simulator already");
  return simulator;
}

/// The version that is to be the newest again: that of the number, else the newest one's parent.
const SimulatorRecord& revertedTo(const std::vector<SimulatorRecord>& all, std::optional<int> number,
                                  const std::string& owner, const std::string& what) {
  const SimulatorRecord& newest = all.back();
  const auto wanted = std::find_if(all.begin(), all.end(), [&](const SimulatorRecord& s) {
    return number ? s.number == *number : s.id == newest.parent;
  });
  if (wanted == all.end() || wanted->id == newest.id)
    throw InputError(owner, number ? "version " + std::to_string(*number) : std::string("reverting the first version"),
                     newest.number == 0 ? "a " + what + " that has more than its first version"
                                        : "a version from 0 to " + std::to_string(newest.number - 1));
  return *wanted;
}

std::string reverting(const SimulatorRecord& to, const SimulatorRecord& from) {
  return nlohmann::json{{"reverts_to", to.number}, {"from", from.number}}.dump();
}

std::string nameOfRig(const Database& database, Id rig) {
  return "rig " + database.experiment(rig).name + " of " + database.path();
}

// The number says what was the newest when it was looked at: of two that adopt at once the second is refused.
SimulatorRecord addToRig(Database& database, const SimulatorRecord& newest, SimulatorRecord version) {
  version.number = newest.number + 1;
  version.id = database.addRigSimulator(version);
  return version;
}

}  // namespace

SimulatorRecord adoptSimulator(Database& database, const PluginHost& host, Id run, const SimulatorSpec& simulator,
                               const std::string& evidence) {
  database.run(run);  // an unknown run leaves no lock file
  const RunLock lock(database.path(), run);
  const RunRecord record = database.run(run);
  requireRest(database, record);
  const SimulatorRecord parent = database.latestSimulator(run);
  const SimulatorSpec adopted = inheriting(simulator, parent, nameOf(database, run));
  // An effect or a path that this run's scene does not have is refused here, not in its workers.
  prepareFromRun(record, host).scene(adopted);
  return addToRun(database, record, versionAfter(parent, adopted, "gap analysis", evidence));
}

SimulatorRecord adoptFromFiles(Database& database, const PluginHost& host, Id run, const std::string& simulator,
                               const std::string& report) {
  const Found found = readFound(simulator, report);
  return adoptSimulator(database, host, run, found.simulator, found.evidence);
}

SimulatorRecord adoptForRig(Database& database, const PluginHost& host, const std::string& scene,
                            const std::string& simulator, const std::string& report) {
  const Found found = readFound(simulator, report);
  if (!report.empty() && found.sceneSha256 != sha256(readFile(scene)))
    throw InputError(scene + ": is not the scene of the report in " + report + ", or has changed since; analyse again");
  // What its scene cannot build is refused before anything is stored.
  const Rig rig = loadRig(scene);
  makeScene(rig.scene, loadModels(rig.scene), found.simulator, host.effectFactory());
  const Id id = addRig(database, rig);
  const SimulatorRecord parent = database.rigSimulators(id).back();
  const SimulatorSpec adopted = inheriting(found.simulator, parent, nameOfRig(database, id));
  return addToRig(database, parent, versionAfter(parent, adopted, "gap analysis", found.evidence));
}

SimulatorRecord revertSimulator(Database& database, Id run, std::optional<int> number) {
  database.run(run);  // an unknown run leaves no lock file
  const RunLock lock(database.path(), run);
  const RunRecord record = database.run(run);
  requireRest(database, record);
  const std::vector<SimulatorRecord> all = database.simulators(run);
  const SimulatorRecord& wanted = revertedTo(all, number, nameOf(database, run), "run");
  return addToRun(database, record,
                  versionAfter(all.back(), wanted.simulator, "by hand", reverting(wanted, all.back())));
}

SimulatorRecord revertRig(Database& database, Id rig, std::optional<int> number) {
  const std::vector<SimulatorRecord> all = database.rigSimulators(rig);
  if (all.empty())
    throw InputError("experiment " + std::to_string(rig) + " of " + database.path() + ": it is not a rig");
  const SimulatorRecord& wanted = revertedTo(all, number, nameOfRig(database, rig), "rig");
  return addToRig(database, all.back(),
                  versionAfter(all.back(), wanted.simulator, "by hand", reverting(wanted, all.back())));
}

std::string originOf(const SimulatorRecord& version) {
  const auto evidence = nlohmann::json::parse(version.evidence, nullptr, false);
  if (evidence.is_object() && evidence.contains("reverts_to"))
    return "back to version " + std::to_string(evidence["reverts_to"].get<int>());
  return version.madeBy;
}

}  // namespace btr
