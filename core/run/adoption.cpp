#include "core/run/adoption.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/gap_report.h"
#include "core/run/prepared_experiment.h"
#include "core/run/run_lock.h"
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

SimulatorRecord add(Database& database, const RunRecord& run, const SimulatorRecord& parent, SimulatorSpec simulator,
                    const std::string& madeBy, const std::string& evidence) {
  SimulatorRecord version;
  version.run = run.id;
  version.parent = parent.id;
  version.simulator = std::move(simulator);
  version.madeBy = madeBy;
  version.evidence = evidence;
  version.madeAfterGeneration = run.generation;
  version.createdAt = utcNow();
  return database.simulator(database.addSimulator(version));
}

std::string evidenceOf(const std::string& report, const GapReport& found, const std::string& hash) {
  nlohmann::json evidence{{"report", std::filesystem::absolute(report).lexically_normal().string()},
                          {"report_sha256", hash},
                          {"verdict", toText(found.verdict)},
                          {"sentence", found.sentence},
                          {"seed", found.seed},
                          {"version", found.version},
                          {"recordings_sha256", nlohmann::json::array()}};
  for (const GapReport::Trial& trial : found.trials) evidence["recordings_sha256"].push_back(trial.sha256);
  return evidence.dump();
}

}  // namespace

SimulatorRecord adoptSimulator(Database& database, const PluginHost& host, Id run, const SimulatorSpec& simulator,
                               const std::string& evidence) {
  database.run(run);  // an unknown run leaves no lock file
  const RunLock lock(database.path(), run);
  const RunRecord record = database.run(run);
  requireRest(database, record);
  const SimulatorRecord parent = database.latestSimulator(run);
  SimulatorSpec adopted = simulator;
  for (const auto& [name, value] : parent.simulator.values) adopted.values.try_emplace(name, value);
  if (adopted == parent.simulator)
    throw InputError(nameOf(database, run) + ": its version " + std::to_string(parent.number) +
                     " is this simulator already");
  // An effect or a path that this run's scene does not have is refused here, not in its workers.
  prepareFromRun(record, host).scene(adopted);
  return add(database, record, parent, std::move(adopted), "gap analysis", evidence);
}

SimulatorRecord adoptFromFiles(Database& database, const PluginHost& host, Id run, const std::string& simulator,
                               const std::string& report) {
  const std::string text = readFile(simulator);
  const SimulatorSpec wanted = simulatorFromJson(text, simulator);
  if (report.empty()) {
    const nlohmann::json evidence{{"simulator_file", std::filesystem::absolute(simulator).lexically_normal().string()},
                                  {"simulator_sha256", sha256(text)}};
    return adoptSimulator(database, host, run, wanted, evidence.dump());
  }
  const GapReport found = loadReport(report);
  if (found.after != wanted)
    throw InputError(simulator + ": is not the simulator that the report in " + report + " has found");
  const std::string hash = sha256(readFile((std::filesystem::path(report) / "report.json").string()));
  return adoptSimulator(database, host, run, wanted, evidenceOf(report, found, hash));
}

SimulatorRecord revertSimulator(Database& database, Id run, std::optional<int> number) {
  database.run(run);  // an unknown run leaves no lock file
  const RunLock lock(database.path(), run);
  const RunRecord record = database.run(run);
  requireRest(database, record);
  const std::vector<SimulatorRecord> all = database.simulators(run);
  const SimulatorRecord& newest = all.back();
  const auto wanted = std::find_if(all.begin(), all.end(), [&](const SimulatorRecord& s) {
    return number ? s.number == *number : s.id == newest.parent;
  });
  if (wanted == all.end() || wanted->id == newest.id)
    throw InputError(nameOf(database, run),
                     number ? "version " + std::to_string(*number) : std::string("reverting the first version"),
                     newest.number == 0 ? std::string("a run that has more than its first version")
                                        : "a version from 0 to " + std::to_string(newest.number - 1));
  const nlohmann::json evidence{{"reverts_to", wanted->number}, {"from", newest.number}};
  return add(database, record, newest, wanted->simulator, "by hand", evidence.dump());
}

}  // namespace btr
