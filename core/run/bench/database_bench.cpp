#include "core/run/bench/database_bench.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/run/comparison.h"
#include "core/run/export.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/store/database.h"
#include "core/store/storage.h"

namespace btr {
namespace {

constexpr std::size_t comparedRuns = 10;

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Runs questions and notes their times.
class Timer {
 public:
  Timer(DatabaseBench& bench, int repeats, const std::function<bool()>& goesOn)
      : bench_(bench), repeats_(repeats), goesOn_(goesOn) {}

  /// `question` returns the number of rows that it has read.
  template <class Question>
  void time(const std::string& what, const Question& question) {
    DatabaseTiming timing{what, 1e9, 0};
    for (int repeat = 0; repeat < repeats_; ++repeat) {
      if (goesOn_ && !goesOn_()) return;
      const double begin = wallSeconds();
      timing.rows = static_cast<long>(question());
      timing.seconds = std::min(timing.seconds, wallSeconds() - begin);
    }
    bench_.timings.push_back(timing);
  }

 private:
  DatabaseBench& bench_;
  const int repeats_;
  const std::function<bool()>& goesOn_;
};

std::size_t rowsOf(const std::string& csv) { return static_cast<std::size_t>(std::ranges::count(csv, '\n')) - 1; }

void timeARun(const Database& database, const PluginHost& host, Id run, Timer& timer) {
  timer.time("a run's page: generations, versions, gaps, measurements", [&] {
    return database.generations(run).size() + database.simulators(run).size() + database.gaps(run).size() +
           database.measurementTasks(run).size() + database.measurements(run).size();
  });
  timer.time("all individuals of a run", [&] { return database.individuals(run).size(); });
  timer.time("the 30 best individuals of a run", [&] { return database.bestIndividuals(run, 30, 0, 0).size(); });
  timer.time("one individual, with its run's files", [&] {
    const std::optional<GenerationRecord> last = database.lastGeneration(run);
    if (!last || last->individuals.empty()) return 0;
    return database.run(database.individual(last->individuals.front().id).run).id == run ? 1 : 0;
  });
  timer.time("export of a run's individuals", [&] {
    const PreparedExperiment prepared = prepareFromRun(database.run(run), host);
    return rowsOf(exportCsv(database, run, "individuals", prepared.genotype, prepared.fitness->unit()));
  });
}

}  // namespace

DatabaseBench benchDatabase(const std::string& path, const PluginHost& host, int repeats,
                            const std::function<bool()>& goesOn) {
  DatabaseBench bench;
  bench.path = path;
  Timer timer(bench, repeats, goesOn);
  timer.time("open for reading", [&] {
    Database::open(path, Database::Mode::readOnly);
    return 1;
  });
  const Database database = Database::open(path, Database::Mode::readOnly);
  std::vector<RunRecord> runs;
  timer.time("list of experiments and runs", [&] {
    runs = database.runs();
    return runs.size() + database.experiments().size();
  });
  bench.runs = static_cast<long>(runs.size());
  if (!runs.empty()) {
    timer.time("simulator versions of all runs", [&] {
      std::size_t versions = 0;
      for (const RunRecord& run : runs) versions += database.simulators(run.id).size();
      return versions;
    });
    timeARun(database, host, runs[runs.size() / 2].id, timer);
    timer.time("comparison of ten runs", [&] {
      std::size_t rows = 0;
      for (std::size_t k = 0; k < std::min(comparedRuns, runs.size()); ++k)
        rows += database.run(runs[k].id).specJson.size() / runs[k].specJson.size() +
                database.generations(runs[k].id).size() + database.simulators(runs[k].id).size() +
                stageOutcomes(database, runs[k].id).size();
      return rows;
    });
    for (const RunRecord& run : runs)
      for (const GenerationRecord& generation : database.generations(run.id))
        bench.individuals += generation.trials + generation.reused;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  bench.peak_mb = 1024e-6 * static_cast<double>(usage.ru_maxrss);
  const std::map<std::string, std::int64_t> bytes = storedBytes(path);
  for (const auto& [table, count] : bytes) {
    bench.bytes += static_cast<double>(count);
    if (table == "individual") bench.individualBytes = static_cast<double>(count);
    if (table == "trace") bench.traceBytes = static_cast<double>(count);
  }
  return bench;
}

std::string databaseBenchTable(const DatabaseBench& bench) {
  std::string table;
  const auto line = [&table](const char* format, auto... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    table += text;
  };
  line("database: %ld runs, %ld individuals, %.1f MB\n", bench.runs, bench.individuals, 1e-6 * bench.bytes);
  const double count = static_cast<double>(std::max(1L, bench.individuals));
  line("bytes an individual: %.0f with its indices, %.0f with all that is stored but traces, %.0f with traces\n",
       bench.individualBytes / count, (bench.bytes - bench.traceBytes) / count, bench.bytes / count);
  line("%-60s %10s %10s\n", "question", "ms", "rows");
  for (const DatabaseTiming& timing : bench.timings)
    line("%-60s %10.2f %10ld\n", timing.what.c_str(), 1e3 * timing.seconds, timing.rows);
  line("Wall time, best of a few, file in the system's memory. Peak memory %.0f MB.\n", bench.peak_mb);
  return table;
}

}  // namespace btr
