#include <cmath>

#include "core/spec/error.h"
#include "core/spec/parameter.h"
#include "core/spec/utf8.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

constexpr const char* columns =
    "SELECT id, run_id, individual_id, value, is_void, note, who, source, entered_at FROM measurement ";

MeasurementRecord measurementOf(const Query& row) {
  MeasurementRecord m;
  row.get(m.id, m.run, m.individual, m.value, m.isVoid, m.note, m.who, m.source, m.enteredAt);
  return m;
}

Id store(const Connection& connection, const MeasurementRecord& m) {
  const std::string place = connection.path() + " individual " + std::to_string(m.individual);
  if (!(std::abs(m.value) <= largestFitness))
    throw InputError(place, "the value " + toText(m.value),
                     "a finite number " + toText(-largestFitness) + " to " + toText(largestFitness));
  requireUtf8(m.note, place + ", note");
  requireUtf8(m.who, place + ", who measured");
  requireUtf8(m.source, place + ", source");
  if (m.source.empty()) throw InputError(place, "a source without a name", "that of who entered the value");
  countersOf(connection, m.run);
  if (!Query(connection, "SELECT 1 FROM measurement_task WHERE individual_id = ? AND run_id = ?", m.individual, m.run)
           .next())
    throw InputError(place, "a measurement", "only individuals that run " + std::to_string(m.run) + " asks for");
  return insert(connection,
                "INSERT INTO measurement (run_id, individual_id, value, is_void, note, who, source, entered_at) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                m.run, m.individual, m.value, m.isVoid, m.note, m.who, m.source, orNow(m.enteredAt));
}

}  // namespace

void Database::addMeasurementStage(Id run, int stage, const std::vector<MeasurementTask>& tasks) {
  connection_->write([&] {
    const int next = countersOf(*connection_, run).stage + 1;
    const std::string what = "measurement stage " + std::to_string(stage) + " of run " + std::to_string(run);
    if (stage != next) connection_->refuse(what + " is not allowed; the next is " + std::to_string(next));
    if (tasks.empty()) connection_->refuse(what + " without an individual is not allowed");
    if (Query(*connection_, "SELECT 1 FROM measurement_task WHERE run_id = ? AND stage = ?", run, stage).next())
      connection_->refuse(what + " has its individuals already");
    Query task(*connection_,
               "INSERT INTO measurement_task (run_id, stage, position, individual_id, simulated_fitness, "
               "wanted_repeats, held_out, rank, disagreement, candidates) "
               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const MeasurementTask& t : tasks) {
      requireRowOfRun(*connection_, "individual", run, t.individual);
      task.run(run, stage, t.position, t.individual, t.simulatedFitness, t.wantedRepeats, t.heldOut, t.rank,
               t.disagreement, t.candidates);
    }
    Query(*connection_, "UPDATE run_state SET state = 'waiting', message = ?, updated_at = ? WHERE run_id = ?")
        .run("waits for real fitness of " + std::to_string(tasks.size()) + " individuals", utcNow(), run);
  });
}

std::vector<MeasurementTask> Database::measurementTasks(Id run, int stage) const {
  return connection_->read([&] {
    std::vector<MeasurementTask> all;
    Query row(*connection_,
              "SELECT run_id, stage, individual_id, position, simulated_fitness, wanted_repeats, held_out, "
              "iteration, rank, disagreement, candidates FROM measurement_task "
              "WHERE run_id = ?1 AND (?2 = 0 OR stage = ?2) ORDER BY stage, position",
              run, stage);
    while (row.next()) {
      MeasurementTask& t = all.emplace_back();
      row.get(t.run, t.stage, t.individual, t.position, t.simulatedFitness, t.wantedRepeats, t.heldOut, t.iteration,
              t.rank, t.disagreement, t.candidates);
    }
    return all;
  });
}

Id Database::addMeasurement(const MeasurementRecord& measurement) {
  return connection_->write([&] { return store(*connection_, measurement); });
}

std::vector<Id> Database::addMeasurements(const std::vector<MeasurementRecord>& measurements) {
  return connection_->write([&] {
    std::vector<Id> ids;
    for (const MeasurementRecord& m : measurements) ids.push_back(store(*connection_, m));
    return ids;
  });
}

void Database::setMeasurementVoid(Id measurement, bool isVoid, const std::string& note) {
  requireUtf8(note, path() + " measurement " + std::to_string(measurement) + ", note");
  connection_->write([&] {
    if (Query(*connection_, "UPDATE measurement SET is_void = ?, note = ? WHERE id = ?")
            .run(isVoid, note, measurement) == 0)
      refuseUnknown(*connection_, "measurement", measurement);
  });
}

std::vector<MeasurementRecord> Database::measurements(Id run) const {
  return connection_->read([&] {
    std::vector<MeasurementRecord> all;
    for (Query row(*connection_, (std::string(columns) + "WHERE run_id = ? ORDER BY id").c_str(), run); row.next();)
      all.push_back(measurementOf(row));
    return all;
  });
}

MeasurementRecord Database::measurement(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, (std::string(columns) + "WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "measurement", id);
    return measurementOf(row);
  });
}

}  // namespace btr
