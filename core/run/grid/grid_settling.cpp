// What a grid's cells end with: failed ones may take a neighbour's solution, mirrored ones take the image of theirs.
#include <algorithm>
#include <numeric>

#include "core/run/grid/grid_kicks.h"
#include "core/run/grid/grid_work.h"

namespace btr {

bool GridWork::settle() {
  progress.phase = "settling";
  const std::size_t settled = db_.gridSolutions(record_.id).size();
  const auto learning = static_cast<std::size_t>(progress.cells);
  if (settled < learning && !settleLearned()) return false;
  return settled == cells_.size() || settleMirrored();
}

/// A generation of vectors that no learner proposed, as the next of a run.
GenerationRecord GridWork::generationOf(Id run, const std::vector<std::vector<double>>& parameters,
                                        std::span<const TrialReply> replies) const {
  GenerationRecord generation;
  generation.run = run;
  generation.simulator = db_.latestSimulator(run).id;
  generation.number = 1;
  if (const auto last = db_.lastGeneration(run)) {
    generation.number = last->number + 1;
    generation.randomState = last->randomState;
    generation.learnerState = last->learnerState;
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    IndividualRecord i;
    i.slot = static_cast<int>(k);
    i.parameters = parameters[k];
    i.fitness = replies[k].fitness;
    i.outcome = replies[k].outcome;
    i.detail = replies[k].detail;
    i.traceSha256 = replies[k].traceSha256;
    i.trialSeed = jobOf(cells_.front().task, {}).seed;
    generation.failed += !isFinished(i.outcome);
    generation.mean += i.fitness / static_cast<double>(parameters.size());
    generation.individuals.push_back(std::move(i));
  }
  const auto byFitness = [](const IndividualRecord& i) { return i.fitness; };
  generation.best = std::ranges::max_element(generation.individuals, {}, byFitness)->fitness;
  generation.worst = std::ranges::min_element(generation.individuals, {}, byFitness)->fitness;
  generation.trials = static_cast<int>(parameters.size());
  return generation;
}

bool GridWork::settleLearned() {
  const double threshold = setting("failure_threshold");
  const auto failed = [&](int number) { return best_.at(number).fitness < threshold; };
  const std::vector<GridCellRecord> stored = db_.gridCells(record_.id);

  // Which neighbours' solutions each failed cell tries.
  std::vector<TrialJob> jobs;
  std::map<int, std::vector<int>> from;
  std::map<int, std::size_t> first;
  for (const GridCell& c : cells_) {
    if (c.mirrorOf != 0 || !failed(c.number) || setting("replace_failed") == 0) continue;
    first[c.number] = jobs.size();
    for (const int n : c.neighbours) {
      const int source = learnerOf(n);
      if (source == c.number || failed(source)) continue;
      from[c.number].push_back(n);
      jobs.push_back(jobOf(c.task, imageIf(cell(n).mirrorOf != 0, best_.at(source).parameters)));
    }
  }
  const auto replies = evaluate(jobs);
  if (!replies) return false;

  std::vector<GridSettlement> settlements;
  for (const GridCell& c : cells_) {
    if (c.mirrorOf != 0) continue;
    GridSettlement settled;
    settled.solution = {c.number, best_.at(c.number).id, best_.at(c.number).id, failed(c.number), 0, 0};
    if (const auto neighbours = from.find(c.number); neighbours != from.end()) {
      std::vector<std::vector<double>> tried;
      const std::size_t begin = first.at(c.number);
      for (std::size_t k = 0; k < neighbours->second.size(); ++k) tried.push_back(jobs[begin + k].parameters);
      settled.generation = generationOf(stored[static_cast<std::size_t>(c.number - 1)].run, tried,
                                        std::span(*replies).subspan(begin, tried.size()));
      const auto& individuals = settled.generation->individuals;
      const auto best = std::ranges::max_element(individuals, {}, &IndividualRecord::fitness);
      if (best->fitness > best_.at(c.number).fitness) {
        settled.slot = best->slot;
        settled.solution.individual = 0;
        settled.solution.takenFrom = neighbours->second[static_cast<std::size_t>(best->slot)];
        settled.solution.takenIndividual = best_.at(learnerOf(settled.solution.takenFrom)).id;
      }
    }
    settlements.push_back(std::move(settled));
  }
  db_.settleGrid(record_.id, settlements);
  return true;
}

bool GridWork::settleMirrored() {
  std::vector<GridStart> starts;
  std::vector<GridCellRecord> stored = db_.gridCells(record_.id);
  for (const GridCell& c : cells_)
    if (c.mirrorOf != 0 && stored[static_cast<std::size_t>(c.number - 1)].run == 0)
      starts.push_back(gridStart(base_, spec_, method_, record_.experiment, record_.seed, c, base_.specInWords.start));
  if (!starts.empty()) db_.beginGridCells(record_.id, starts);
  stored = db_.gridCells(record_.id);

  std::map<int, GridSolution> solutions;
  for (const GridSolution& solution : db_.gridSolutions(record_.id)) solutions[solution.cell] = solution;
  std::vector<TrialJob> jobs;
  for (const GridCell& c : cells_)
    if (c.mirrorOf != 0)
      jobs.push_back(jobOf(c.task, imageIf(true, db_.individual(solutions.at(c.mirrorOf).individual).parameters)));
  const auto replies = evaluate(jobs);
  if (!replies) return false;

  std::vector<GridSettlement> settlements;
  for (const GridCell& c : cells_) {
    if (c.mirrorOf == 0) continue;
    const std::size_t k = settlements.size();
    GridSettlement settled;
    settled.generation = generationOf(stored[static_cast<std::size_t>(c.number - 1)].run, {jobs[k].parameters},
                                      std::span(*replies).subspan(k, 1));
    settled.slot = 0;
    settled.solution.cell = c.number;
    settled.solution.failed = solutions.at(c.mirrorOf).failed || (*replies)[k].fitness < setting("failure_threshold");
    settlements.push_back(std::move(settled));
  }
  db_.settleGrid(record_.id, settlements);
  return true;
}

bool GridWork::tryPoints() {
  const auto wanted = static_cast<int>(setting("points"));
  if (wanted == 0 || !db_.gridPoints(record_.id).empty()) return true;
  progress.phase = "points between";
  const VectorGrid kicks = solvedGrid(db_, host_, record_.id);
  Random random = Random::forPurpose(record_.seed, "grid points");
  std::vector<GridPoint> points;
  std::vector<TrialJob> jobs;
  for (int k = 0; k < wanted; ++k) {
    GridPoint point;
    point.number = k + 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point.task[axis] = random.uniform(spec_.axes[axis].front(), spec_.axes[axis].back());
    point.parameters = kicks.at(point.task, GridSpec::axisNames);
    jobs.push_back(jobOf(point.task, point.parameters));
    points.push_back(std::move(point));
  }
  const auto replies = evaluate(jobs);
  if (!replies) return false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].fitness = (*replies)[k].fitness;
    points[k].outcome = (*replies)[k].outcome;
    points[k].figures = (*replies)[k].figures;
  }
  db_.addGridPoints(record_.id, points);
  return true;
}

}  // namespace btr
