// L2: policies that are tried in reality, iteration by iteration.
#include <cmath>

#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

std::string nameOf(Id run, int stage, int number) {
  return "iteration " + std::to_string(number) + " of L2 in stage " + std::to_string(stage) + " of run " +
         std::to_string(run);
}

/// Refuses what is not the next iteration of the run's present stage.
void requireNext(const Connection& connection, Id run, int stage, int number) {
  const int nextStage = countersOf(connection, run).stage + 1;
  const int next =
      *Query(connection, "SELECT coalesce(max(number), 0) + 1 FROM reality_iteration WHERE run_id = ? AND stage = ?",
             run, stage)
           .value<int>();
  if (stage != nextStage || number != next)
    connection.refuse(nameOf(run, stage, number) + " is not allowed; the next is " + std::to_string(next) +
                      " in stage " + std::to_string(nextStage));
}

std::vector<Id> policyIds(const Connection& connection, Id run, int stage, int number) {
  std::vector<Id> ids;
  Query row(connection,
            "SELECT individual_id FROM reality_policy WHERE run_id = ? AND stage = ? AND number = ? ORDER BY slot", run,
            stage, number);
  while (row.next()) row.get(ids.emplace_back());
  return ids;
}

}  // namespace

void Database::beginRealityIteration(const RealityIteration& begun, std::vector<IndividualRecord>& policies,
                                     const std::vector<std::string>& traces, const std::vector<std::size_t>& order,
                                     int wantedRepeats) {
  // The records are written back only when all of it is stored.
  std::vector<IndividualRecord> stored = policies;
  const Id run = begun.run;
  const int stage = begun.stage, number = begun.number;
  connection_->write([&] {
    requireNext(*connection_, run, stage, number);
    if (!policyIds(*connection_, run, stage, number).empty())
      connection_->refuse(nameOf(run, stage, number) + " has its policies already");
    if (stored.empty() || traces.size() != stored.size() || (wantedRepeats > 0 && order.size() != stored.size()))
      connection_->refuse(nameOf(run, stage, number) + " needs policies, each with its trace and place");
    const int generation = countersOf(*connection_, run).generation;
    int slot =
        *Query(*connection_, "SELECT coalesce(max(slot), -1) + 1 FROM individual WHERE run_id = ? AND generation = ?",
               run, generation)
             .value<int>();
    Query(*connection_,
          "INSERT INTO reality_begun (run_id, stage, number, centre_before, random_state, learner_state) "
          "VALUES (?, ?, ?, ?, ?, ?)")
        .run(run, stage, number, begun.centreBefore, begun.randomState, begun.learnerState);
    IndividualRow row(*connection_);
    Query policy(*connection_,
                 "INSERT INTO reality_policy (run_id, stage, number, slot, individual_id) VALUES (?, ?, ?, ?, ?)");
    Query trace(*connection_, "INSERT INTO trace (individual_id, packed) VALUES (?, ?)");
    for (std::size_t k = 0; k < stored.size(); ++k) {
      IndividualRecord& i = stored[k];
      i.run = run;
      i.generation = generation;
      i.slot = slot++;
      i.iteration = number;
      i.fitness += 0.0;
      requireRowOfRun(*connection_, "simulator", run, i.simulator);
      i.id = row.insert(i);
      policy.run(run, stage, number, static_cast<int>(k), i.id);
      if (!traces[k].empty()) trace.run(i.id, Blob{traces[k]});
    }
    if (wantedRepeats <= 0) return;

    int position =
        *Query(*connection_, "SELECT coalesce(max(position), 0) FROM measurement_task WHERE run_id = ? AND stage = ?",
               run, stage)
             .value<int>();
    Query task(*connection_,
               "INSERT INTO measurement_task (run_id, stage, position, individual_id, simulated_fitness, "
               "wanted_repeats, held_out, iteration) VALUES (?, ?, ?, ?, ?, ?, 0, ?)");
    for (const std::size_t k : order)
      task.run(run, stage, ++position, stored.at(k).id, stored.at(k).fitness, wantedRepeats, number);
    Query(*connection_, "UPDATE run_state SET state = 'waiting', message = ?, updated_at = ? WHERE run_id = ?")
        .run("waits for real fitness of " + std::to_string(stored.size()) + " policies", utcNow(), run);
  });
  policies = std::move(stored);
}

std::vector<IndividualRecord> Database::realityPolicies(Id run, int stage, int number) const {
  return connection_->read([&] {
    std::vector<IndividualRecord> all;
    for (const Id id : policyIds(*connection_, run, stage, number)) {
      if (auto policy = Individuals(*connection_, "WHERE id = ?", id).next()) all.push_back(std::move(*policy));
    }
    return all;
  });
}

void Database::addRealityIteration(const RealityIteration& i) {
  connection_->write([&] {
    requireNext(*connection_, i.run, i.stage, i.number);
    const std::vector<Id> begun = policyIds(*connection_, i.run, i.stage, i.number);
    bool same = !begun.empty() && begun.size() == i.policies.size();
    for (std::size_t k = 0; same && k < begun.size(); ++k) same = begun[k] == i.policies[k].individual;
    if (!same)
      connection_->refuse(nameOf(i.run, i.stage, i.number) + " was begun with other policies than it ends with");
    Query(*connection_,
          "INSERT INTO reality_iteration (run_id, stage, number, centre_after, random_state, learner_state, "
          "finished_at) VALUES (?, ?, ?, ?, ?, ?, ?)")
        .run(i.run, i.stage, i.number, i.centreAfter, i.randomState, i.learnerState, orNow(i.finishedAt));
    Query result(*connection_,
                 "INSERT INTO reality_result (run_id, stage, number, slot, fitness, standard_error, count) "
                 "VALUES (?, ?, ?, ?, ?, ?, ?)");
    for (std::size_t k = 0; k < i.policies.size(); ++k)
      result.run(i.run, i.stage, i.number, static_cast<int>(k), i.policies[k].fitness, i.policies[k].standardError,
                 i.policies[k].count);
  });
}

std::optional<RealityIteration> Database::begunRealityIteration(Id run, int stage) const {
  return connection_->read([&]() -> std::optional<RealityIteration> {
    Query row(*connection_,
              "SELECT b.run_id, b.stage, b.number, b.centre_before, b.random_state, b.learner_state "
              "FROM reality_begun b LEFT JOIN reality_iteration i USING (run_id, stage, number) "
              "WHERE b.run_id = ? AND b.stage = ? AND i.finished_at IS NULL",
              run, stage);
    if (!row.next()) return std::nullopt;
    RealityIteration i;
    row.get(i.run, i.stage, i.number, i.centreBefore, i.randomState, i.learnerState);
    return i;
  });
}

void Database::endRealityLearning(Id run, const std::string& who) {
  connection_->write([&] {
    const int stage = countersOf(*connection_, run).stage + 1;
    if (!Query(*connection_, "SELECT 1 FROM reality_begun WHERE run_id = ? AND stage = ?", run, stage).next())
      connection_->refuse("run " + std::to_string(run) + " does not learn in reality now; L2 can be ended once its " +
                          "policies were proposed in stage " + std::to_string(stage));
    Query(*connection_, "INSERT OR IGNORE INTO reality_end (run_id, stage, who, asked_at) VALUES (?, ?, ?, ?)")
        .run(run, stage, who, utcNow());
  });
}

bool Database::isRealityLearningEnded(Id run, int stage) const {
  return connection_->read([&] {
    return Query(*connection_, "SELECT 1 FROM reality_end WHERE run_id = ? AND stage = ?", run, stage).next();
  });
}

std::vector<RealityIteration> Database::realityIterations(Id run, int stage) const {
  return connection_->read([&] {
    std::vector<RealityIteration> all;
    Query row(*connection_,
              "SELECT run_id, stage, number, centre_before, centre_after, i.random_state, i.learner_state, finished_at "
              "FROM reality_iteration i JOIN reality_begun USING (run_id, stage, number) "
              "WHERE run_id = ?1 AND (?2 = 0 OR stage = ?2) ORDER BY stage, number",
              run, stage);
    while (row.next()) {
      RealityIteration& i = all.emplace_back();
      row.get(i.run, i.stage, i.number, i.centreBefore, i.centreAfter, i.randomState, i.learnerState, i.finishedAt);
      Query result(*connection_,
                   "SELECT individual_id, fitness, standard_error, count FROM reality_result JOIN reality_policy "
                   "USING (run_id, stage, number, slot) WHERE run_id = ? AND stage = ? AND number = ? ORDER BY slot",
                   i.run, i.stage, i.number);
      while (result.next()) {
        RealityPolicy& p = i.policies.emplace_back();
        result.get(p.individual, p.fitness, p.standardError, p.count);
      }
    }
    return all;
  });
}

}  // namespace btr
