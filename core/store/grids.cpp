#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

constexpr const char* gridColumns =
    "SELECT id, experiment_id, name, method, seed, spec_json, spec_sha256, created_at FROM grid ";

GridRecord gridOf(const Query& row) {
  GridRecord g;
  row.get(g.id, g.experiment, g.name, g.method, g.seed, g.specJson, g.specSha256, g.createdAt);
  return g;
}

void begin(const Connection& connection, Id grid, const std::vector<GridStart>& starts) {
  Query row(connection,
            "INSERT INTO grid_run (grid_id, cell, run_id, begun_at, begun_at_individual) VALUES (?, ?, ?, ?, ?)");
  for (const GridStart& start : starts) {
    RunRecord record = start.run;
    record.note = start.note;
    const Id run = insertRun(connection, record, start.simulator);
    row.run(grid, start.cell, run, Reference{start.begunAt}, Reference{start.begunAtIndividual});
  }
}

Id runOfCell(const Connection& connection, Id grid, int cell) {
  const auto run =
      Query(connection, "SELECT run_id FROM grid_run WHERE grid_id = ? AND cell = ?", grid, cell).value<Id>();
  if (!run) connection.refuse("cell " + std::to_string(cell) + " of grid " + std::to_string(grid) + " has no run yet");
  return *run;
}

/// Stores the generation as the next of the cell's run; the id of its individual in `slot`.
Id store(const Connection& connection, Id grid, int cell, GenerationRecord& generation, int slot) {
  const Id run = runOfCell(connection, grid, cell);
  if (generation.run != run)
    connection.refuse("a generation of run " + std::to_string(generation.run) + " is not allowed; cell " +
                      std::to_string(cell) + " has run " + std::to_string(run));
  insertGeneration(connection, generation);
  for (const IndividualRecord& i : generation.individuals)
    if (i.slot == slot) return i.id;
  return 0;
}

Id insertGrid(const Connection& connection, const GridRecord& g, const std::vector<GridCellRecord>& cells,
              const std::vector<GridStart>& first) {
  requireRow(connection, "experiment", g.experiment);
  const Id grid = insert(connection,
                         "INSERT INTO grid (experiment_id, name, method, seed, spec_json, spec_sha256, created_at) "
                         "VALUES (?, ?, ?, ?, ?, ?, ?)",
                         g.experiment, g.name, g.method, g.seed, g.specJson, g.specSha256, orNow(g.createdAt));
  // Those that learn come first: the others refer to them.
  Query row(connection,
            "INSERT INTO grid_cell (grid_id, number, distance_m, bearing_rad, direction_rad, mirror_of) VALUES (?, "
            "?, ?, ?, ?, ?)");
  for (const bool mirrored : {false, true})
    for (const GridCellRecord& c : cells)
      if ((c.mirrorOf != 0) == mirrored)
        row.run(grid, c.number, c.task[0], c.task[1], c.task[2], Reference{c.mirrorOf});
  begin(connection, grid, first);
  return grid;
}

}  // namespace

Id Database::addGrid(const GridRecord& grid, const std::vector<GridCellRecord>& cells,
                     const std::vector<GridStart>& first) {
  return connection_->write([&] { return insertGrid(*connection_, grid, cells, first); });
}

Id Database::addGrid(const ExperimentRecord& experiment, GridRecord grid, const std::vector<GridCellRecord>& cells,
                     std::vector<GridStart> first) {
  return connection_->write([&] {
    grid.experiment = insertExperiment(*connection_, experiment);
    for (GridStart& start : first) start.run.experiment = grid.experiment;
    return insertGrid(*connection_, grid, cells, first);
  });
}

void Database::beginGridCells(Id grid, const std::vector<GridStart>& starts) {
  connection_->write([&] { begin(*connection_, grid, starts); });
}

void Database::addGridRound(Id grid, std::vector<GridStep>& steps) {
  std::vector<GridStep> stored = steps;
  connection_->write([&] {
    Query row(*connection_,
              "INSERT INTO grid_best (grid_id, cell, generation, individual_id, similarity) VALUES (?, ?, ?, ?, ?)");
    for (GridStep& step : stored) {
      const Id id = store(*connection_, grid, step.best.cell, step.generation, step.slot);
      step.best.generation = step.generation.number;
      if (step.best.individual == 0) step.best.individual = id;
      requireRowOfRun(*connection_, "individual", step.generation.run, step.best.individual);
      row.run(grid, step.best.cell, step.best.generation, step.best.individual, step.best.similarity);
    }
  });
  steps = std::move(stored);
}

void Database::settleGrid(Id grid, std::vector<GridSettlement>& settlements) {
  std::vector<GridSettlement> stored = settlements;
  connection_->write([&] {
    Query row(*connection_,
              "INSERT INTO grid_solution (grid_id, cell, individual_id, own_individual_id, failed, taken_from, "
              "taken_individual_id) VALUES (?, ?, ?, ?, ?, ?, ?)");
    Query finished(*connection_,
                   "UPDATE run_state SET state = 'finished', message = '', updated_at = ? WHERE run_id = ?");
    for (GridSettlement& settled : stored) {
      GridSolution& s = settled.solution;
      if (settled.generation) {
        const Id id = store(*connection_, grid, s.cell, *settled.generation, settled.slot);
        if (s.individual == 0) s.individual = id;
      }
      const Id run = runOfCell(*connection_, grid, s.cell);
      requireRowOfRun(*connection_, "individual", run, s.individual);
      row.run(grid, s.cell, s.individual, Reference{s.own}, s.failed, Reference{s.takenFrom},
              Reference{s.takenIndividual});
      finished.run(utcNow(), run);
    }
  });
  settlements = std::move(stored);
}

void Database::addGridPoints(Id grid, const std::vector<GridPoint>& points) {
  connection_->write([&] {
    Query row(*connection_,
              "INSERT INTO grid_point (grid_id, number, distance_m, bearing_rad, direction_rad, fitness, outcome, "
              "figures_json, parameters) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const GridPoint& p : points)
      row.run(grid, p.number, p.task[0], p.task[1], p.task[2], p.fitness, p.outcome, toJson(p.figures, {}).dump(),
              p.parameters);
  });
}

std::vector<GridRecord> Database::grids() const {
  return connection_->read([&] {
    std::vector<GridRecord> all;
    for (Query row(*connection_, (std::string(gridColumns) + "ORDER BY id").c_str()); row.next();)
      all.push_back(gridOf(row));
    return all;
  });
}

GridRecord Database::grid(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, (std::string(gridColumns) + "WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "grid", id);
    return gridOf(row);
  });
}

std::optional<Id> Database::findGrid(const std::string& specSha256, const std::string& method,
                                     std::uint64_t seed) const {
  return connection_->read([&] {
    return Query(*connection_, "SELECT id FROM grid WHERE spec_sha256 = ? AND method = ? AND seed = ?", specSha256,
                 method, seed)
        .value<Id>();
  });
}

std::optional<Id> Database::gridOfRun(Id run) const {
  return connection_->read(
      [&] { return Query(*connection_, "SELECT grid_id FROM grid_run WHERE run_id = ?", run).value<Id>(); });
}

std::vector<GridCellRecord> Database::gridCells(Id grid) const {
  return connection_->read([&] {
    std::vector<GridCellRecord> all;
    Query row(*connection_,
              "SELECT number, distance_m, bearing_rad, direction_rad, mirror_of, run_id, begun_at, begun_at_individual "
              "FROM grid_cell c LEFT JOIN grid_run r ON r.grid_id = c.grid_id AND r.cell = c.number "
              "WHERE c.grid_id = ? ORDER BY number",
              grid);
    while (row.next()) {
      GridCellRecord& c = all.emplace_back();
      row.get(c.number, c.task[0], c.task[1], c.task[2], c.mirrorOf, c.run, c.begunAt, c.begunAtIndividual);
    }
    return all;
  });
}

std::vector<GridBest> Database::gridBests(Id grid) const {
  return connection_->read([&] {
    std::vector<GridBest> all;
    Query row(*connection_,
              "SELECT cell, generation, individual_id, similarity FROM grid_best WHERE grid_id = ? ORDER BY cell, "
              "generation",
              grid);
    while (row.next()) {
      GridBest& b = all.emplace_back();
      row.get(b.cell, b.generation, b.individual, b.similarity);
    }
    return all;
  });
}

std::vector<GridSolution> Database::gridSolutions(Id grid) const {
  return connection_->read([&] {
    std::vector<GridSolution> all;
    Query row(*connection_,
              "SELECT cell, individual_id, own_individual_id, failed, taken_from, taken_individual_id FROM "
              "grid_solution WHERE grid_id = ? ORDER BY cell",
              grid);
    while (row.next()) {
      GridSolution& s = all.emplace_back();
      row.get(s.cell, s.individual, s.own, s.failed, s.takenFrom, s.takenIndividual);
    }
    return all;
  });
}

std::vector<GridPoint> Database::gridPoints(Id grid) const {
  return connection_->read([&] {
    std::vector<GridPoint> all;
    Query row(*connection_,
              "SELECT number, distance_m, bearing_rad, direction_rad, fitness, outcome, figures_json, parameters FROM "
              "grid_point WHERE grid_id = ? ORDER BY number",
              grid);
    while (row.next()) {
      GridPoint& p = all.emplace_back();
      std::string figures;
      row.get(p.number, p.task[0], p.task[1], p.task[2], p.fitness, p.outcome, figures, p.parameters);
      p.figures = JsonReader::parse("{\"figures\":" + figures + "}", connection_->path()).anyValues("figures");
    }
    return all;
  });
}

}  // namespace btr
