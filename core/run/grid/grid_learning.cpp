// A grid's cells learn: wave by wave, in a wave generation by generation.
#include <algorithm>
#include <limits>

#include "core/learn/vector_grid.h"
#include "core/run/grid/grid_work.h"

namespace btr {
namespace {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

bool comesFirst(const Tried& a, const Tried& b) { return a.fitness != b.fitness ? a.fitness > b.fitness : a.id < b.id; }

}  // namespace

GridWork::GridWork(Database& database, const PluginHost& host, Id grid, const StopFlag& stop,
                   const GridOptions& options)
    : db_(database),
      host_(host),
      stop_(stop),
      options_(options),
      record_(database.grid(grid)),
      spec_(storedGrid(record_.specJson, "grid " + std::to_string(grid))),
      method_(gridMethodFromText(record_.method)),
      cells_(cellsOf(spec_)),
      begun_(Clock::now()) {
  for (const GridCellRecord& stored : db_.gridCells(grid)) {
    if (stored.run == 0) continue;
    if (base_.genotype.empty()) {
      base_ = prepareFromRun(db_.run(stored.run), host_);
      // The cell may have begun at a neighbour: the others begin as the experiment says.
      const auto own = experimentFromJson(db_.experiment(record_.experiment).specJson, record_.name, "").start;
      base_.spec.start = base_.specInWords.start = own;
      base_.start = own ? resolve(base_.genotype, own->parameters, "start/parameters") : std::vector<double>();
      simulator_ = db_.latestSimulator(stored.run).simulator;
    }
  }
  // What the cells have learned so far.
  std::map<int, GridBest> last;
  for (const GridBest& best : db_.gridBests(grid)) last[best.cell] = best;
  for (const auto& [number, best] : last) {
    const IndividualRecord i = db_.individual(best.individual);
    best_[number] = {i.fitness, i.id, i.parameters};
    progress.done += best.generation;
  }
  for (const GridCell& c : cells_) progress.cells += c.mirrorOf == 0;
  progress.total = progress.cells * static_cast<int>(setting("generations"));
}

double GridWork::setting(const std::string& name) const { return valueOf(gridParameters(), spec_.settings, name); }

std::vector<double> GridWork::imageIf(bool mirrored, const std::vector<double>& parameters) const {
  return mirrored ? mirrorImage(base_.genotype, parameters) : parameters;
}

bool GridWork::stopped() {
  if (stop_) halt_ = true;
  if (!halt_ && secondsSince(looked_) > 1) {
    looked_ = Clock::now();
    for (const RunRecord& run : db_.runs(record_.experiment))
      if (run.stopRequested && db_.gridOfRun(run.id) == record_.id) halt_ = true;
  }
  return halt_;
}

std::optional<std::vector<TrialReply>> GridWork::evaluate(const std::vector<TrialJob>& jobs) {
  if (stopped()) return std::nullopt;
  if (!evaluator_) evaluator_ = std::make_unique<Evaluator>(base_, options_.workers, options_.workforce);
  const long before = progress.trials;
  return evaluator_->evaluate(jobs, halt_, [&](std::size_t done) {
    progress.trials = before + static_cast<long>(done);
    stopped();
    publish(false);
  });
}

void GridWork::publish(bool now) {
  if (!options_.progress || (!now && secondsSince(published_) < 1)) return;
  published_ = Clock::now();
  const double seconds = secondsSince(begun_);
  progress.trialsPerSecond = seconds > 0 ? static_cast<double>(progress.trials) / seconds : 0;
  progress.meanBest = 0;
  for (const auto& [number, best] : best_) progress.meanBest += best.fitness / static_cast<double>(best_.size());
  options_.progress(progress);
}

TrialJob GridWork::jobOf(std::span<const double, 3> task, std::vector<double> parameters) const {
  const std::uint64_t seed = Random::forPurpose(record_.seed, "grid trial").next() >> 1;
  return {simulator_, std::move(parameters), seed, false, taskOf(task)};
}

double GridWork::similarityAt(const GridCell& at, std::span<const double> parameters) const {
  double sum = 0;
  int count = 0;
  for (const int n : at.neighbours) {
    const auto best = best_.find(learnerOf(n));
    if (best == best_.end()) continue;
    sum += similarity(base_.genotype, parameters, imageIf(cell(n).mirrorOf != 0, best->second.parameters));
    ++count;
  }
  return count ? sum / count : 1;
}

double GridWork::worth(double fitness, double alike) const {
  if (method_ != GridSpec::Method::similarity) return fitness;
  return weightedFitness(fitness, alike, setting("similarity_strength"));
}

bool GridWork::learn() {
  progress.phase = "learning";
  std::vector<std::vector<int>> waves = wavesOf(cells_);
  if (method_ != GridSpec::Method::contamination) {
    // All at once.
    std::vector<int> all;
    for (const std::vector<int>& wave : waves) all.insert(all.end(), wave.begin(), wave.end());
    std::ranges::sort(all);
    waves = {all};
  }
  for (const std::vector<int>& wave : waves)
    if (!learnWave(wave)) return false;
  return true;
}

/// Runs for those cells of the wave that have none: their populations begin around a good point of a neighbour.
void GridWork::beginWave(const std::vector<int>& wave) {
  std::vector<GridStart> starts;
  const std::vector<GridCellRecord> stored = db_.gridCells(record_.id);
  for (const int number : wave) {
    if (stored[static_cast<std::size_t>(number - 1)].run != 0) continue;
    const GridCell& at = cell(number);
    int from = 0;
    for (const int n : at.neighbours) {
      const auto best = best_.find(learnerOf(n));
      if (best == best_.end() || best->second.fitness < setting("failure_threshold")) continue;
      if (from == 0 || best->second.fitness > best_.at(learnerOf(from)).fitness) from = n;
    }
    std::optional<SearchStart> around = base_.specInWords.start;
    if (from != 0) {
      const Tried& good = best_.at(learnerOf(from));
      const std::vector<double> vector = imageIf(cell(from).mirrorOf != 0, good.parameters);
      around.emplace();
      for (std::size_t i = 0; i < vector.size(); ++i) around->parameters[base_.genotype[i].name] = vector[i];
      around->share = setting("contamination_share");
      around->flip = setting("contamination_flip");
    }
    GridStart start = gridStart(base_, spec_, method_, record_.experiment, record_.seed, at, around);
    start.begunAt = from;
    start.begunAtIndividual = from ? best_.at(learnerOf(from)).id : 0;
    if (from) start.note += ", begun at cell " + std::to_string(from);
    starts.push_back(std::move(start));
  }
  if (!starts.empty()) db_.beginGridCells(record_.id, starts);
}

CellWork GridWork::resume(int number) const {
  CellWork work;
  work.cell = &cell(number);
  work.run = db_.gridCells(record_.id)[static_cast<std::size_t>(number - 1)].run;
  const RunRecord run = db_.run(work.run);
  work.prepared = std::make_unique<PreparedExperiment>(base_.withTask(taskOf(work.cell->task)));
  work.prepared->spec.start = experimentFromJson(run.specJson, "run " + std::to_string(run.id), "").start;
  if (const auto& start = work.prepared->spec.start)
    work.prepared->start = resolve(base_.genotype, start->parameters, "start/parameters");
  work.search = std::make_unique<Search>(db_, host_, *work.prepared, run, db_.latestSimulator(run.id));
  for (const IndividualRecord& i : db_.individuals(run.id))
    if (i.sameAs == 0) work.tried.push_back({i.fitness, i.id, i.parameters});
  std::ranges::sort(work.tried, comesFirst);
  return work;
}

bool GridWork::learnWave(const std::vector<int>& wave) {
  const auto generations = static_cast<int>(setting("generations"));
  std::map<int, int> reached;
  for (const GridBest& best : db_.gridBests(record_.id)) reached[best.cell] = best.generation;
  const bool done = std::ranges::all_of(wave, [&](int number) { return reached[number] >= generations; });
  if (!done) {
    beginWave(wave);
    std::vector<CellWork> cells;
    for (const int number : wave) {
      cells.push_back(resume(number));
      db_.setRunState(cells.back().run, RunState::learning, "");
    }
    while (cells.front().search->generation() < generations)
      if (!round(cells)) return false;
  }
  progress.cellsDone += static_cast<int>(wave.size());
  return true;
}

/// One generation of each cell of the wave.
bool GridWork::round(std::vector<CellWork>& wave) {
  const auto begun = Clock::now();
  std::vector<TrialJob> jobs;
  std::vector<std::size_t> first;
  for (CellWork& work : wave) {
    first.push_back(jobs.size());
    for (TrialJob& job : work.search->ask()) {
      job.task = taskOf(work.cell->task);
      jobs.push_back(std::move(job));
    }
  }
  first.push_back(jobs.size());
  const auto replies = evaluate(jobs);
  if (!replies) return false;

  std::vector<GridStep> steps;
  for (std::size_t k = 0; k < wave.size(); ++k) {
    CellWork& work = wave[k];
    GridStep step;
    step.best.cell = work.cell->number;
    step.generation = work.search->fill({replies->begin() + static_cast<std::ptrdiff_t>(first[k]),
                                         replies->begin() + static_cast<std::ptrdiff_t>(first[k + 1])});
    std::vector<double> told;
    for (const IndividualRecord& i : step.generation.individuals)
      told.push_back(worth(i.fitness, similarityAt(*work.cell, i.parameters)));
    work.search->tell(step.generation, told);
    step.generation.seconds = secondsSince(begun) / static_cast<double>(wave.size());

    // The best so far, as the neighbours were before this round. Worth is never above fitness: the list ends early.
    double highest = -std::numeric_limits<double>::infinity();
    for (const Tried& tried : work.tried) {
      if (tried.fitness <= highest) break;
      const double alike = similarityAt(*work.cell, tried.parameters);
      if (const double value = worth(tried.fitness, alike); value > highest) {
        highest = value;
        step.best.individual = tried.id;
        step.best.similarity = alike;
      }
    }
    for (std::size_t slot = 0; slot < told.size(); ++slot)
      if (step.generation.individuals[slot].sameAs == 0 && told[slot] > highest) {
        highest = told[slot];
        step.best.individual = 0;
        step.slot = static_cast<int>(slot);
        step.best.similarity = similarityAt(*work.cell, step.generation.individuals[slot].parameters);
      }
    steps.push_back(std::move(step));
  }
  db_.addGridRound(record_.id, steps);

  for (std::size_t k = 0; k < wave.size(); ++k) {
    wave[k].search->remember(steps[k].generation);
    for (const IndividualRecord& i : steps[k].generation.individuals)
      if (i.sameAs == 0) wave[k].tried.push_back({i.fitness, i.id, i.parameters});
    std::ranges::sort(wave[k].tried, comesFirst);
    best_[steps[k].best.cell] =
        *std::ranges::find(wave[k].tried, steps[k].best.individual, [](const Tried& t) { return t.id; });
  }
  progress.done += static_cast<int>(wave.size());
  const double seconds = secondsSince(begun);
  progress.secondsLeft = seconds / static_cast<double>(wave.size()) * (progress.total - progress.done);
  publish(false);
  return true;
}

}  // namespace btr
