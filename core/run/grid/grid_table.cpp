#include "core/run/grid/grid_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/learn/vector_grid.h"
#include "core/run/export.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/experiment_spec.h"

namespace btr {

GridSummary summaryOf(const Database& database, const PluginHost& host, Id grid) {
  GridSummary s;
  s.grid = database.grid(grid);
  s.spec = storedGrid(s.grid.specJson, "grid " + std::to_string(grid));
  const std::vector<GridCell> cells = cellsOf(s.spec);
  for (const GridCell& cell : cells) s.learning += cell.mirrorOf == 0;
  const std::vector<GridCellRecord> stored = database.gridCells(grid);
  const auto begun = std::ranges::find_if(stored, [](const GridCellRecord& c) { return c.run != 0; });
  if (begun == stored.end()) return s;
  const ExperimentSpec experiment = experimentFromJson(database.run(begun->run).specJson, s.grid.name, "");
  const std::vector<Parameter> genotype = host.controller(experiment.controller.name)->genotype();
  s.unit = host.fitness(experiment.fitness.name)->unit();

  std::vector<const GridRow*> rowOf(cells.size() + 1, nullptr);
  s.rows.reserve(cells.size());
  for (const GridSolution& solution : database.gridSolutions(grid)) {
    const auto k = static_cast<std::size_t>(solution.cell - 1);
    const IndividualRecord individual = database.individual(solution.individual);
    GridRow row;
    row.cell = solution.cell;
    row.task = cells[k].task;
    row.fitness = individual.fitness;
    row.ownFitness = solution.own ? database.individual(solution.own).fitness : individual.fitness;
    row.failed = solution.failed;
    row.takenFrom = solution.takenFrom;
    row.mirrorOf = cells[k].mirrorOf;
    row.begunAt = stored[k].begunAt;
    row.run = stored[k].run;
    row.individual = individual.id;
    row.parameters = individual.parameters;
    s.failed += row.failed;
    s.taken += row.takenFrom != 0;
    s.rows.push_back(std::move(row));
    rowOf[k + 1] = &s.rows.back();
  }
  for (GridRow& row : s.rows) {
    if (row.mirrorOf)
      if (const GridRow* source = rowOf[static_cast<std::size_t>(row.mirrorOf)]) row.sourceTookFrom = source->takenFrom;
    s.cellMean += row.fitness / static_cast<double>(s.rows.size());
    double sum = 0;
    int count = 0;
    for (const int n : cells[static_cast<std::size_t>(row.cell - 1)].neighbours) {
      const GridRow* other = rowOf[static_cast<std::size_t>(n)];
      if (!other) continue;
      const double alike = similarity(genotype, row.parameters, other->parameters);
      sum += alike;
      ++count;
      if (n > row.cell) s.edges.push_back({row.cell, n, alike});
    }
    if (count) row.similarity = sum / count;
  }
  for (const GridEdge& edge : s.edges) s.edgeMean += edge.similarity / static_cast<double>(s.edges.size());

  const std::vector<GridPoint> points = database.gridPoints(grid);
  s.points = static_cast<int>(points.size());
  std::map<std::string, int> counts;
  for (const GridPoint& point : points) {
    s.pointMean += point.fitness / static_cast<double>(points.size());
    for (const auto& [name, value] : point.figures) {
      s.figureMeans[name] += std::abs(value);
      ++counts[name];
    }
  }
  for (auto& [name, value] : s.figureMeans) value /= counts[name];
  return s;
}

GridComparison compareGrids(const Database& database, const PluginHost& host, const std::string& specSha256) {
  GridComparison comparison;
  std::vector<GridRecord> grids;
  for (const GridRecord& g : database.grids())
    if (g.specSha256 == specSha256 && isGridFinished(database, g.id)) grids.push_back(g);
  std::ranges::stable_sort(grids, {}, &GridRecord::seed);

  std::vector<std::map<std::uint64_t, std::pair<double, double>>> means;  // cells and points, by method and seed
  for (const auto method :
       {GridSpec::Method::independent, GridSpec::Method::contamination, GridSpec::Method::similarity}) {
    GridMethodRow row;
    row.method = toText(method);
    std::vector<double> cells, points, edges, cellsMore, pointsMore;
    std::map<std::uint64_t, std::pair<double, double>> own;
    for (const GridRecord& g : grids) {
      if (g.method != row.method) continue;
      const GridSummary s = summaryOf(database, host, g.id);
      comparison.name = g.name;
      comparison.unit = s.unit;
      row.grids.push_back(g.id);
      row.seeds.push_back(g.seed);
      cells.push_back(s.cellMean);
      edges.push_back(s.edgeMean);
      if (s.points) points.push_back(s.pointMean);
      own[g.seed] = {s.cellMean, s.pointMean};
      row.failed += s.failed;
      row.taken += s.taken;
      if (!means.empty())
        if (const auto base = means.front().find(g.seed); base != means.front().end()) {
          cellsMore.push_back(s.cellMean - base->second.first);
          if (s.points) pointsMore.push_back(s.pointMean - base->second.second);
        }
    }
    if (row.grids.empty()) continue;
    row.failed /= static_cast<double>(row.grids.size());
    row.taken /= static_cast<double>(row.grids.size());
    row.cells = spreadOf(cells);
    row.points = spreadOf(points);
    row.edges = spreadOf(edges);
    row.cellsDifference = spreadOf(cellsMore);
    row.pointsDifference = spreadOf(pointsMore);
    means.push_back(std::move(own));
    comparison.methods.push_back(std::move(row));
  }
  return comparison;
}

std::string cellsCsv(const GridSummary& summary, const std::vector<Parameter>& genotype) {
  const std::string unit = unitSuffix(summary.unit);
  std::string text = "cell,distance_m,bearing_rad,direction_rad,fitness" + unit + ",own_fitness" + unit +
                     ",similarity,failed,taken_from,mirror_of,begun_at,run,individual";
  for (const Parameter& p : genotype) text += "," + p.name;
  text += '\n';
  const auto cellOrNone = [](int number) { return number ? std::to_string(number) : std::string(); };
  for (const GridRow& row : summary.rows) {
    text += std::to_string(row.cell);
    for (const double value : row.task) text += "," + toText(value);
    text += "," + toText(row.fitness) + "," + toText(row.ownFitness) + "," + toText(row.similarity) + "," +
            (row.failed ? "1," : "0,") + cellOrNone(row.takenFrom) + "," + cellOrNone(row.mirrorOf) + "," +
            cellOrNone(row.begunAt) + "," + std::to_string(row.run) + "," + std::to_string(row.individual);
    for (const double value : row.parameters) text += "," + toText(value);
    text += '\n';
  }
  return text;
}

std::string methodsCsv(const GridComparison& comparison) {
  const std::string unit = unitSuffix(comparison.unit);
  std::string text = "method,seeds";
  for (const char* name : {"cells", "points", "cells_difference", "points_difference"})
    text += "," + std::string(name) + unit + "," + name + "_ci95_half" + unit;
  text += ",similarity,similarity_ci95_half,failed_cells,taken_cells\n";
  for (const GridMethodRow& row : comparison.methods) {
    text += row.method + "," + std::to_string(row.grids.size());
    for (const Spread* s : {&row.cells, &row.points, &row.cellsDifference, &row.pointsDifference, &row.edges})
      text += s->count == 0 ? std::string(",,") : "," + toText(s->mean) + "," + toText(s->halfWidth95);
    text += "," + toText(row.failed) + "," + toText(row.taken) + '\n';
  }
  return text;
}

std::string toJsonText(const GridComparison& comparison, const std::vector<GridSummary>& grids) {
  using nlohmann::json;
  const auto spread = [](const Spread& s) -> json {
    if (s.count == 0) return nullptr;
    return {{"mean", s.mean}, {"ci95_half", s.halfWidth95}, {"count", s.count}};
  };
  json methods = json::array(), all = json::array();
  for (const GridMethodRow& row : comparison.methods)
    methods.push_back({{"method", row.method},
                       {"seeds", row.seeds},
                       {"grids", row.grids},
                       {"cells", spread(row.cells)},
                       {"points", spread(row.points)},
                       {"similarity", spread(row.edges)},
                       {"cells_difference", spread(row.cellsDifference)},
                       {"points_difference", spread(row.pointsDifference)},
                       {"failed_cells", row.failed},
                       {"taken_cells", row.taken}});
  for (const GridSummary& s : grids) {
    json rows = json::array(), edges = json::array();
    for (const GridRow& row : s.rows)
      rows.push_back({{"cell", row.cell},
                      {"distance_m", row.task[0]},
                      {"bearing_rad", row.task[1]},
                      {"direction_rad", row.task[2]},
                      {"fitness", row.fitness},
                      {"own_fitness", row.ownFitness},
                      {"similarity", row.similarity},
                      {"failed", row.failed},
                      {"taken_from", row.takenFrom},
                      {"mirror_of", row.mirrorOf},
                      {"begun_at", row.begunAt},
                      {"run", row.run},
                      {"individual", row.individual},
                      {"parameters", row.parameters}});
    for (const GridEdge& edge : s.edges) edges.push_back({edge.one, edge.other, edge.similarity});
    all.push_back({{"grid", s.grid.id},
                   {"name", s.grid.name},
                   {"method", s.grid.method},
                   {"seed", s.grid.seed},
                   {"cell_mean", s.cellMean},
                   {"points", s.points},
                   {"point_mean", s.pointMean},
                   {"point_figures", s.figureMeans},
                   {"failed_cells", s.failed},
                   {"taken_cells", s.taken},
                   {"similarity", s.edgeMean},
                   {"cells", rows},
                   {"edges", edges}});
  }
  return json{{"format", "uchilsim-grids-1"},
              {"name", comparison.name},
              {"unit", comparison.unit},
              {"methods", methods},
              {"grids", all}}
      .dump(1);
}

}  // namespace btr
