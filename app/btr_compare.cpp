// btr compare: several experiments with the same seeds, side by side.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/btr_commands.h"
#include "app/cluster/btr_array.h"
#include "app/cluster/btr_cluster.h"
#include "core/run/comparison.h"

namespace btr::cli {
namespace {

struct CompareArguments {
  std::string file, database, csv, places;
  int jobs = 0;
  bool quiet = false;
  ArrayArguments array;
};

void print(const Comparison& comparison) {
  const std::string unit = comparison.unit.empty() ? "" : " [" + comparison.unit + "]";
  std::vector<std::vector<std::string>> rows;
  for (const ComparedArm& arm : comparison.arms)
    for (const ComparedStage& s : arm.stages)
      rows.push_back({arm.name, std::to_string(s.stage), std::to_string(s.gap.count), interval(s.gap),
                      interval(s.adapted), interval(s.realMean), interval(s.realBest), interval(s.gapDifference),
                      interval(s.realDifference)});
  std::cout << printable(comparison.name) << unit
            << "\nmean ± half of the 95 % interval over the seeds; gap: |real − simulated| of "
            << "individuals that no update had seen\n\n";
  writeOut("", table({"arm", "stage", "seeds", "gap", "after its update", "real fitness", "real best",
                      "gap − first arm's", "real − first arm's"},
                     rows));
}

/// An element for each arm and seed, whose run has begun in its database.
void compareElsewhere(const CompareArguments& a, const ComparisonSpec& spec, const ComparedExperiments& arms,
                      Shell& shell) {
  ArrayJob array;
  array.what = "compare";
  array.into = a.database;
  array.workers = std::max(1, a.jobs);
  const auto begin = [&](const std::string& folder, ArrayJob& job) {
    // Seed by seed: what is done first makes whole pairs.
    for (const std::uint64_t seed : spec.seeds)
      for (std::size_t arm = 0; arm < spec.arms.size(); ++arm) {
        job.elements.push_back(
            {spec.arms[arm].name + ", seed " + std::to_string(seed),
             {"run", "--run", "1", "--db", "{db}", "--jobs", std::to_string(job.workers), "--quiet"}});
        Database db = Database::open(elementDatabase(folder, job.elements.size()), Database::Mode::create);
        startRun(db, shell.plugins(), arms.experiments[arm], seed);
      }
  };
  beginArray(a.array, std::move(array), begin, shell);
}

void compare(const CompareArguments& a, Shell& shell) {
  ClusterJob cluster(shell, a.database, a.jobs);
  if (cluster.isDone()) return;
  cluster.tellTo(a.places);
  const ComparisonSpec spec = loadComparison(a.file);
  const ComparedExperiments arms = loadArms(spec, shell.plugins());  // before a database is made for them
  if (a.array.isWanted()) return compareElsewhere(a, spec, arms, shell);
  Database db = Database::open(a.database, Database::Mode::create, workingPatience_ms);
  shell.goesOn = true;
  RunOptions options;
  options.jobs = a.jobs;
  options.workforce = cluster.workforce();
  const double runs = static_cast<double>(spec.arms.size() * spec.seeds.size());
  double before = -1;  // runs before the one that is worked on
  std::string of;
  options.progress = [&](const RunProgress& p) {
    const double share = p.totalGenerations ? static_cast<double>(p.generation) / p.totalGenerations : 0;
    cluster.tellProgress(of + ", " + p.stage, (before + share) / runs, p.trialsPerSecond);
  };
  const Comparison all = runComparison(
      db, shell.plugins(), spec, arms, *shell.stop, options, [&](const std::string& arm, std::uint64_t seed) {
        ++before;
        of = arm + ", seed " + std::to_string(seed);
        if (!a.quiet) std::fprintf(stderr, "%s, seed %llu\n", arm.c_str(), static_cast<unsigned long long>(seed));
      });
  if (!a.quiet) cluster.tell();
  if (!a.csv.empty()) writeOut(a.csv, toCsv(all));
  if (shell.json)
    std::cout << toJsonText(all) << '\n';
  else
    print(all);
  shell.exitCode = all.end == RunEnd::finished ? done : all.end == RunEnd::waiting ? waitsForFitness : stoppedEarly;
}

}  // namespace

void addCompareCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "run or resume several experiments with the same seeds, compare");
  command->add_option("FILE", a->file, "comparison file (.json)")->required();
  command->add_option("--db", a->database, "experiment database")->required();
  command->add_option("--jobs", a->jobs, "worker processes (0: as many as processors)")
      ->transform(wholeNumber(0, 1024));
  shell.writesFile(command, command->add_option("--csv", a->csv, "write the table to this file, too"));
  command->add_flag("--quiet", a->quiet, "do not say which run is worked on");
  addArrayOptions(command, a->array);
  addPlacesOption(command, a->places);
  command->callback([a, &shell] { compare(*a, shell); });
}

}  // namespace btr::cli
