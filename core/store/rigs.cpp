#include <nlohmann/json.hpp>

#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

constexpr const char* columns =
    "SELECT id, experiment_id, number, parent_id, simulator_json, made_by, evidence, created_at FROM rig_simulator ";

// As it was stored, whatever bounds a number has today.
SimulatorSpec simulatorOf(const Connection& connection, const std::string& text) {
  try {
    const nlohmann::json stored = nlohmann::json::parse(text);
    SimulatorSpec simulator;
    simulator.values = stored.at("values").get<Values>();
    for (const nlohmann::json& effect : stored.at("effects"))
      simulator.effects.push_back({effect.at("effect").get<std::string>(), effect.at("at").get<std::string>(),
                                   effect.at("parameters").get<Values>()});
    return simulator;
  } catch (const nlohmann::json::exception& error) {
    connection.refuse(std::string("is damaged: a simulator of a rig: ") + error.what());
  }
}

SimulatorRecord versionOf(const Connection& connection, const Query& row) {
  SimulatorRecord s;
  std::string text;
  row.get(s.id, s.rig, s.number, s.parent, text, s.madeBy, s.evidence, s.createdAt);
  s.simulator = simulatorOf(connection, text);
  return s;
}

int nextNumber(const Connection& connection, Id rig) {
  return *Query(connection, "SELECT coalesce(max(number) + 1, 0) FROM rig_simulator WHERE experiment_id = ?", rig)
              .value<int>();
}

Id insertVersion(const Connection& connection, const SimulatorRecord& s, int number) {
  return insert(connection,
                "INSERT INTO rig_simulator (experiment_id, number, parent_id, simulator_json, made_by, evidence, "
                "created_at) VALUES (?, ?, ?, ?, ?, ?, ?)",
                s.rig, number, Reference{s.parent}, toJsonText(s.simulator), s.madeBy, s.evidence, orNow(s.createdAt));
}

}  // namespace

Id Database::addRig(const ExperimentRecord& rig, const SimulatorRecord& first) {
  return connection_->write([&] {
    if (const auto known =
            Query(*connection_, "SELECT id FROM experiment WHERE spec_json = ? ORDER BY id DESC LIMIT 1", rig.specJson)
                .value<Id>())
      return *known;
    SimulatorRecord version = first;
    version.rig = insertExperiment(*connection_, rig);
    insertVersion(*connection_, version, 0);
    return version.rig;
  });
}

Id Database::addRigSimulator(const SimulatorRecord& s) {
  return connection_->write([&] {
    const int number = nextNumber(*connection_, s.rig);
    if (number == 0 || s.number != number)
      connection_->refuse("simulator version " + std::to_string(s.number) + " is not allowed; the next of rig " +
                          std::to_string(s.rig) + " is " + std::to_string(number));
    if (!Query(*connection_, "SELECT 1 FROM rig_simulator WHERE id = ? AND experiment_id = ?", s.parent, s.rig).next())
      refuseUnknown(*connection_, "simulator of rig " + std::to_string(s.rig) + ",", s.parent);
    return insertVersion(*connection_, s, number);
  });
}

std::vector<SimulatorRecord> Database::rigSimulators(Id rig) const {
  return connection_->read([&] {
    std::vector<SimulatorRecord> all;
    const std::string which = rig == 0 ? "ORDER BY experiment_id, number" : "WHERE experiment_id = ?1 ORDER BY number";
    Query row(*connection_, (columns + which).c_str());
    if (rig != 0) row.bindAll(rig);
    while (row.next()) all.push_back(versionOf(*connection_, row));
    return all;
  });
}

}  // namespace btr
