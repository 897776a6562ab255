#include <cmath>
#include <unordered_set>

#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

constexpr const char* generationColumns =
    "SELECT run_id, number, simulator_id, best, mean, worst, trials, reused, failed, seconds, finished_at FROM "
    "generation ";

GenerationRecord generationOf(const Query& row) {
  GenerationRecord g;
  row.get(g.run, g.number, g.simulator, g.best, g.mean, g.worst, g.trials, g.reused, g.failed, g.seconds, g.finishedAt);
  return g;
}

// What the individual takes from its generation, and the meaning of a negative sameAs.
void complete(const Connection& connection, const GenerationRecord& generation, std::size_t index,
              IndividualRecord& individual) {
  const std::string who =
      "generation " + std::to_string(generation.number) + ", slot " + std::to_string(individual.slot) + ": ";
  individual.run = generation.run;
  individual.generation = generation.number;
  if (individual.simulator == 0) individual.simulator = generation.simulator;
  individual.fitness += 0.0;
  if (std::isnan(individual.fitness)) connection.refuse(who + "the fitness nan is not allowed; a number");
  if (individual.sameAs < 0) {
    const Id slot = sameAsSlot(0) - individual.sameAs;
    Id found = 0;
    for (std::size_t k = 0; k < index; ++k)
      if (generation.individuals[k].slot == slot) found = generation.individuals[k].id;
    if (found == 0)
      connection.refuse(who + "same as slot " + std::to_string(slot) + " is not allowed; an earlier slot");
    individual.sameAs = found;
  } else if (individual.sameAs > 0) {
    requireRowOfRun(connection, "individual", generation.run, individual.sameAs);
  }
}

}  // namespace

void insertGeneration(const Connection& connection, GenerationRecord& g) {
  const int next = countersOf(connection, g.run).generation + 1;
  if (g.number != next)
    connection.refuse("generation " + std::to_string(g.number) + " is not allowed; the next of run " +
                      std::to_string(g.run) + " is " + std::to_string(next));
  requireRowOfRun(connection, "simulator", g.run, g.simulator);
  g.finishedAt = orNow(g.finishedAt);
  for (double* value : {&g.best, &g.mean, &g.worst, &g.seconds}) *value += 0.0;
  Query(connection,
        "INSERT INTO generation (run_id, number, simulator_id, best, mean, worst, trials, reused, failed, seconds, "
        "finished_at) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .run(g.run, g.number, g.simulator, g.best, g.mean, g.worst, g.trials, g.reused, g.failed, g.seconds,
           g.finishedAt);
  // A resumed run goes on behind its latest generation: earlier states are not needed any more.
  Query(connection,
        "INSERT INTO learner_state (run_id, number, random_state, learner_state) VALUES (?, ?, ?, ?) "
        "ON CONFLICT (run_id) DO UPDATE SET number = excluded.number, random_state = excluded.random_state, "
        "learner_state = excluded.learner_state")
      .run(g.run, g.number, g.randomState, g.learnerState);

  IndividualRow row(connection);
  for (std::size_t k = 0; k < g.individuals.size(); ++k) {
    IndividualRecord& i = g.individuals[k];
    complete(connection, g, k, i);
    if (i.simulator != g.simulator) requireRowOfRun(connection, "simulator", g.run, i.simulator);
    i.id = row.insert(i);
  }
  Query(connection, "UPDATE run_state SET generation = ?, updated_at = ? WHERE run_id = ?")
      .run(g.number, g.finishedAt, g.run);
}

void Database::addGeneration(GenerationRecord& generation) {
  // The record is written back only when all of it is stored.
  GenerationRecord g = generation;
  connection_->write([&] { insertGeneration(*connection_, g); });
  generation = std::move(g);
}

std::vector<GenerationRecord> Database::generations(Id run, int after) const {
  return connection_->read([&] {
    std::vector<GenerationRecord> all;
    Query row(*connection_,
              (std::string(generationColumns) + "WHERE run_id = ? AND number > ? ORDER BY number").c_str(), run, after);
    while (row.next()) all.push_back(generationOf(row));
    return all;
  });
}

std::optional<GenerationRecord> Database::lastGeneration(Id run) const {
  return connection_->read([&]() -> std::optional<GenerationRecord> {
    Query row(*connection_, (std::string(generationColumns) + "WHERE run_id = ? ORDER BY number DESC LIMIT 1").c_str(),
              run);
    if (!row.next()) return std::nullopt;
    GenerationRecord g = generationOf(row);
    Query state(*connection_, "SELECT random_state, learner_state FROM learner_state WHERE run_id = ? AND number = ?",
                run, g.number);
    if (state.next()) state.get(g.randomState, g.learnerState);
    g.individuals =
        Individuals(*connection_, "WHERE run_id = ? AND generation = ? AND iteration = 0 ORDER BY slot", run, g.number)
            .all();
    return g;
  });
}

std::vector<IndividualRecord> Database::individuals(Id run, int generation) const {
  return connection_->read([&] {
    if (generation == 0)
      return Individuals(*connection_, "WHERE run_id = ? AND iteration = 0 ORDER BY generation, slot", run).all();
    return Individuals(*connection_, "WHERE run_id = ? AND generation = ? AND iteration = 0 ORDER BY slot", run,
                       generation)
        .all();
  });
}

std::vector<IndividualRecord> Database::individualsOfSimulator(Id run, Id simulator) const {
  return connection_->read([&] {
    return Individuals(*connection_,
                       "WHERE simulator_id = ? AND same_as IS NULL AND run_id = ? AND iteration = 0 ORDER BY id",
                       simulator, run)
        .all();
  });
}

std::vector<IndividualRecord> Database::bestIndividuals(Id run, int count, int first, int last) const {
  return connection_->read([&] {
    std::vector<IndividualRecord> best;
    std::unordered_set<std::string> seen;
    Individuals row(*connection_,
                    "WHERE run_id = ?1 AND generation >= ?2 AND (?3 = 0 OR generation <= ?3) "
                    "AND iteration = 0 ORDER BY fitness DESC, generation, slot",
                    run, first, last);
    while (static_cast<int>(best.size()) < count) {
      std::optional<IndividualRecord> individual = row.next();
      if (!individual) break;
      if (seen.insert(identityOf(*individual)).second) best.push_back(std::move(*individual));
    }
    return best;
  });
}

IndividualRecord Database::individual(Id id) const {
  return connection_->read([&] {
    const std::optional<IndividualRecord> found = Individuals(*connection_, "WHERE id = ?", id).next();
    if (!found) refuseUnknown(*connection_, "individual", id);
    return *found;
  });
}

void Database::setTrace(Id individual, const std::string& packed, const std::string& hash) {
  connection_->write([&] {
    const auto cell = Query(*connection_, "SELECT trace_sha256 FROM individual WHERE id = ?", individual).value<Cell>();
    const auto stored = cell ? std::optional(hashOf(*cell)) : std::nullopt;
    if (!stored) refuseUnknown(*connection_, "individual", individual);
    if (hash.empty()) connection_->refuse("a trace without its hash is not allowed");
    if (!stored->empty() && *stored != hash)
      connection_->refuse("a trace " + hash + " of individual " + std::to_string(individual) +
                          " is not allowed; that of its trial is " + *stored);
    if (stored->empty())
      Query(*connection_, "UPDATE individual SET trace_sha256 = ? WHERE id = ?").run(packedHash(hash), individual);
    if (!packed.empty())
      Query(*connection_, "INSERT OR IGNORE INTO trace (individual_id, packed) VALUES (?, ?)")
          .run(individual, Blob{packed});
  });
}

std::optional<std::string> Database::trace(Id individual) const {
  return connection_->read([&] {
    requireRow(*connection_, "individual", individual);
    return Query(*connection_, "SELECT packed FROM trace WHERE individual_id = ?", individual).value<std::string>();
  });
}

}  // namespace btr
