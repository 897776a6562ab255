#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

SimulatorRecord simulatorOf(const Connection& connection, const Query& row) {
  SimulatorRecord s;
  row.get(s.id, s.run, s.number, s.parent, s.madeBy, s.evidence, s.madeAfterGeneration, s.createdAt);
  Query value(connection, "SELECT name, value FROM simulator_value WHERE simulator_id = ?", s.id);
  while (value.next()) {
    std::string name;
    double number = 0;
    value.get(name, number);
    s.simulator.values[name] = number;
  }
  Query effect(connection, "SELECT effect, place FROM simulator_effect WHERE simulator_id = ? ORDER BY position", s.id);
  while (effect.next()) {
    PlacedEffect& e = s.simulator.effects.emplace_back();
    effect.get(e.effect, e.at);
  }
  Query parameter(connection, "SELECT position, name, value FROM simulator_effect_value WHERE simulator_id = ?", s.id);
  while (parameter.next()) {
    std::int64_t position = 0;
    std::string name;
    double number = 0;
    parameter.get(position, name, number);
    s.simulator.effects.at(static_cast<std::size_t>(position)).parameters[name] = number;
  }
  return s;
}

constexpr const char* simulatorColumns =
    "SELECT id, run_id, number, parent_id, made_by, evidence, made_after_generation, created_at FROM simulator ";

std::string sql(const char* rest) { return std::string(simulatorColumns) + rest; }

}  // namespace

Id insertSimulator(const Connection& connection, const SimulatorRecord& s) {
  const int number =
      *Query(connection, "SELECT coalesce(max(number) + 1, 0) FROM simulator WHERE run_id = ?", s.run).value<int>();
  if (s.number != 0 && s.number != number)
    connection.refuse("simulator version " + std::to_string(s.number) + " is not allowed; the next of run " +
                      std::to_string(s.run) + " is " + std::to_string(number));
  if (s.parent != 0) requireRowOfRun(connection, "simulator", s.run, s.parent);
  const Id id =
      insert(connection,
             "INSERT INTO simulator (run_id, number, parent_id, made_by, evidence, made_after_generation, created_at) "
             "VALUES (?, ?, ?, ?, ?, ?, ?)",
             s.run, number, Reference{s.parent}, s.madeBy, s.evidence, s.madeAfterGeneration, orNow(s.createdAt));
  Query value(connection, "INSERT INTO simulator_value (simulator_id, name, value) VALUES (?, ?, ?)");
  for (const auto& [name, number_] : s.simulator.values) value.run(id, name, number_);
  Query effect(connection, "INSERT INTO simulator_effect (simulator_id, position, effect, place) VALUES (?, ?, ?, ?)");
  Query parameter(connection,
                  "INSERT INTO simulator_effect_value (simulator_id, position, name, value) VALUES (?, ?, ?, ?)");
  int position = 0;
  for (const PlacedEffect& e : s.simulator.effects) {
    effect.run(id, position, e.effect, e.at);
    for (const auto& [name, number_] : e.parameters) parameter.run(id, position, name, number_);
    ++position;
  }
  return id;
}

Id Database::addSimulator(const SimulatorRecord& simulator) {
  return connection_->write([&] {
    countersOf(*connection_, simulator.run);
    return insertSimulator(*connection_, simulator);
  });
}

std::vector<SimulatorRecord> Database::simulators(Id run) const {
  return connection_->read([&] {
    std::vector<SimulatorRecord> all;
    for (Query row(*connection_, sql("WHERE run_id = ? ORDER BY number").c_str(), run); row.next();)
      all.push_back(simulatorOf(*connection_, row));
    return all;
  });
}

SimulatorRecord Database::simulator(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, sql("WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "simulator", id);
    return simulatorOf(*connection_, row);
  });
}

SimulatorRecord Database::latestSimulator(Id run) const {
  return connection_->read([&] {
    Query row(*connection_, sql("WHERE run_id = ? ORDER BY number DESC LIMIT 1").c_str(), run);
    if (!row.next()) refuseUnknown(*connection_, "run", run);
    return simulatorOf(*connection_, row);
  });
}

void Database::addAdaptation(const AdaptationRecord& a) {
  connection_->write([&] {
    const int stage = countersOf(*connection_, a.run).stage + 1;
    const int number =
        *Query(*connection_, "SELECT coalesce(max(number), 0) + 1 FROM adaptation WHERE run_id = ? AND stage = ?",
               a.run, stage)
             .value<int>();
    if (a.stage != stage || a.number != number)
      connection_->refuse("generation " + std::to_string(a.number) + " of L3 in stage " + std::to_string(a.stage) +
                          " is not allowed; the next of run " + std::to_string(a.run) + " is " +
                          std::to_string(number) + " in stage " + std::to_string(stage));
    insert(*connection_,
           "INSERT INTO adaptation (run_id, stage, number, best_error, mean_error, evidence_sha256) "
           "VALUES (?, ?, ?, ?, ?, ?)",
           a.run, a.stage, a.number, a.bestError, a.meanError, a.evidenceSha256);
    // L3 goes on behind its latest generation: earlier states are not needed any more.
    Query(*connection_,
          "INSERT INTO adaptation_state (run_id, stage, number, random_state, learner_state) VALUES (?, ?, ?, ?, ?) "
          "ON CONFLICT (run_id) DO UPDATE SET stage = excluded.stage, number = excluded.number, "
          "random_state = excluded.random_state, learner_state = excluded.learner_state")
        .run(a.run, a.stage, a.number, a.randomState, a.learnerState);
    Query candidate(*connection_,
                    "INSERT INTO adaptation_candidate (run_id, stage, number, slot, error, chromosome, parameters) "
                    "VALUES (?, ?, ?, ?, ?, ?, ?)");
    int slot = 0;
    for (const AdaptationCandidate& c : a.candidates)
      candidate.run(a.run, a.stage, a.number, slot++, c.error, packedBits(c.chromosome), c.parameters);
  });
}

std::vector<AdaptationRecord> Database::adaptations(Id run, int stage) const {
  return connection_->read([&] {
    std::vector<AdaptationRecord> all;
    Query row(*connection_,
              "SELECT run_id, stage, number, best_error, mean_error, coalesce(random_state, ''), "
              "coalesce(learner_state, ''), evidence_sha256 FROM adaptation "
              "LEFT JOIN adaptation_state USING (run_id, stage, number) WHERE run_id = ? AND stage = ? ORDER BY number",
              run, stage);
    while (row.next()) {
      AdaptationRecord& a = all.emplace_back();
      row.get(a.run, a.stage, a.number, a.bestError, a.meanError, a.randomState, a.learnerState, a.evidenceSha256);
      Query candidate(*connection_,
                      "SELECT chromosome, parameters, error FROM adaptation_candidate "
                      "WHERE run_id = ? AND stage = ? AND number = ? ORDER BY slot",
                      run, stage, a.number);
      while (candidate.next()) {
        AdaptationCandidate& c = a.candidates.emplace_back();
        Cell chromosome;
        candidate.get(chromosome, c.parameters, c.error);
        c.chromosome = bitsOf(chromosome);
      }
    }
    return all;
  });
}

Id Database::finishStage(const SimulatorRecord& simulator, GapRecord gap, RunState next) {
  return connection_->write([&] {
    const int stage = countersOf(*connection_, gap.run).stage + 1;
    if (gap.stage != stage || simulator.run != gap.run)
      connection_->refuse("finishing stage " + std::to_string(gap.stage) + " of run " + std::to_string(gap.run) +
                          " with a simulator of run " + std::to_string(simulator.run) +
                          " is not allowed; its next stage is " + std::to_string(stage));
    requireRowOfRun(*connection_, "simulator", gap.run, gap.simulatorBefore);
    gap.simulatorAfter = insertSimulator(*connection_, simulator);
    insert(*connection_,
           "INSERT INTO gap (run_id, stage, simulator_before, simulator_after, before, after, held_out_before, "
           "held_out_after, "
           "new_before, new_after, standard_error, individuals, held_out_standard_error, held_out_individuals) "
           "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
           gap.run, gap.stage, gap.simulatorBefore, gap.simulatorAfter, gap.before, gap.after, gap.heldOutBefore,
           gap.heldOutAfter, gap.newBefore, gap.newAfter, gap.standardError, gap.individuals, gap.heldOutStandardError,
           gap.heldOutIndividuals);
    Query(*connection_, "UPDATE run_state SET stage = ?, state = ?, message = '', updated_at = ? WHERE run_id = ?")
        .run(stage, toText(next), utcNow(), gap.run);
    return gap.simulatorAfter;
  });
}

void Database::passStage(Id run, int stage, RunState next) {
  connection_->write([&] {
    const std::string what = "passing stage " + std::to_string(stage) + " of run " + std::to_string(run);
    const int due = countersOf(*connection_, run).stage + 1;
    if (stage != due) connection_->refuse(what + " is not allowed; its next stage is " + std::to_string(due));
    if (Query(*connection_, "SELECT 1 FROM measurement_task WHERE run_id = ? AND stage = ?", run, stage).next())
      connection_->refuse(what + " is not allowed; it has individuals to measure");
    Query(*connection_, "UPDATE run_state SET stage = ?, state = ?, message = '', updated_at = ? WHERE run_id = ?")
        .run(stage, toText(next), utcNow(), run);
  });
}

std::vector<GapRecord> Database::gaps(Id run) const {
  return connection_->read([&] {
    std::vector<GapRecord> all;
    Query row(
        *connection_,
        "SELECT run_id, stage, simulator_before, simulator_after, before, after, held_out_before, held_out_after, "
        "new_before, new_after, standard_error, individuals, held_out_standard_error, held_out_individuals FROM gap "
        "WHERE run_id = ? ORDER BY stage",
        run);
    while (row.next()) {
      GapRecord& g = all.emplace_back();
      row.get(g.run, g.stage, g.simulatorBefore, g.simulatorAfter, g.before, g.after, g.heldOutBefore, g.heldOutAfter,
              g.newBefore, g.newAfter, g.standardError, g.individuals, g.heldOutStandardError, g.heldOutIndividuals);
    }
    return all;
  });
}

}  // namespace btr
