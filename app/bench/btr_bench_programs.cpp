// What btr bench says of whole commands: a gap analysis, a large database, running worlds, ranks of MPI. What they
// write goes into a folder of their own, which is removed.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/bench/btr_bench_clock.h"
#include "app/bench/btr_bench_rows.h"
#include "app/bench/btr_live_bench.h"
#include "core/cluster/child.h"
#include "core/run/bench/database_bench.h"
#include "core/run/bench/large_database.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/scratch_folder.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

/// Processor time of the children that have ended.
double childrenSeconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool isOnThePath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    std::error_code error;
    if (end > at && fs::exists(fs::path(folders.substr(at, end - at)) / program, error)) return true;
    at = end + 1;
  }
  return false;
}

/// Why mpirun did not: it draws lines around what it says.
std::string wordsOfMpirun(const std::string& errors) {
  if (errors.find("allow-run-as-root") != std::string::npos)
    return "mpirun does not work for root (OMPI_ALLOW_RUN_AS_ROOT=1, OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)";
  std::string words;
  for (std::size_t at = 0; at < errors.size();) {
    const std::size_t end = std::min(errors.find('\n', at), errors.size());
    const std::string line = errors.substr(at, end - at);
    if (line.find_first_not_of(" -\t\r") != std::string::npos) words = line;
    at = end + 1;
  }
  return words.empty() ? "mpirun failed without a word" : words;
}

/// A short kick of so many generations, its scene named by its whole path.
std::string shortKick(const BenchWork& work, const ScratchFolder& folder) {
  nlohmann::json document = nlohmann::json::parse(readFile(work.resources + "/experiments/kick-short.json"));
  document["scene"] = work.resources + "/scenes/kick.json";
  document["stages"]["first_generations"] = document["stages"]["total_generations"] = 6;
  document["stages"]["next_generations"] = 1;
  const std::string path = folder.file("kick.json");
  writeFile(path, document.dump());
  return path;
}

}  // namespace

std::vector<BenchRow> gapRows(const BenchWork& work) {
  const ScratchFolder folder("btr-bench");
  const std::string recordings = work.resources + "/recordings/xl330-made/", out = folder.file("report");
  const double wall = wallSeconds(), cpu = childrenSeconds();
  const ChildEnd end = runChild({work.program, "gap", "analyse", work.resources + "/scenes/xl330.json", "--recording",
                                 recordings + "made_kp200_sines.csv", "--recording", recordings + "made_kp400_slow.csv",
                                 "--held-out", recordings + "made_kp200_chirp.csv", "--out", out});
  const std::string what = "analysis of one joint, three recordings";
  if (end.exitCode != 0) return {{"gap analysis", what, NAN, "s", "", "", lastLine(end.err)}};
  const double took = wallSeconds() - wall, used = childrenSeconds() - cpu;
  const nlohmann::json report = nlohmann::json::parse(readFile(out + "/report.json"));
  double worst = 0;
  for (const auto& [channel, error] : report["heldout"]["channels"].items())
    if (error.value("noise_floor", 0.0) > 0)
      worst = std::max(worst, error.value("rmse_with_effects", NAN) / error["noise_floor"].get<double>());
  const std::string exact = printed("%s, held out %.2f noise floors", report.value("verdict", "?").c_str(), worst);
  return {{"gap analysis", what, took, "s", "", exact, printed("wall time, %d processors", processorCount())},
          {"gap analysis", "the same, CPU of all processes", used, "s", "", exact, ""}};
}

std::vector<BenchRow> databaseRows(const BenchWork& work) {
  const ScratchFolder folder("btr-bench");
  const std::string path = folder.file("large.db");
  LargeDatabase size;
  size.runs = std::max(1, work.individuals / (size.generations * size.population));
  makeLargeDatabase(path, work.host, work.resources + "/experiments/kick-short.json", size,
                    [&](int) { return work.goesOn(); });
  if (!work.goesOn()) return {};
  const DatabaseBench bench = benchDatabase(path, work.host, work.repeats, work.goesOn);
  const double count = static_cast<double>(std::max(1L, bench.individuals));
  const std::string note =
      printed("%ld runs, %ld individuals, %.1f MB", bench.runs, bench.individuals, 1e-6 * bench.bytes);
  std::vector<BenchRow> rows{{"database", "bytes an individual, all but traces",
                              (bench.bytes - bench.traceBytes) / count, "B", "", "300 are aimed at", note},
                             {"database", "bytes an individual, with traces", bench.bytes / count, "B", "", "", ""}};
  for (const DatabaseTiming& timing : bench.timings)
    rows.push_back({"database", timing.what, 1e3 * timing.seconds, "ms", "", "", printed("%ld rows", timing.rows)});
  return rows;
}

std::vector<BenchRow> liveRows(const BenchWork& work) {
  const Game game = loadGame(work.resources + "/games/two-walkers-2004.json");
  std::vector<BenchRow> rows;
  for (const LiveBenchTask& task : liveBenchTasks(game)) {
    if (!work.goesOn()) break;
    const LiveBenchRow row = measureLive(task, work.host, work.seconds, work.goesOn);
    const std::string step = printed("%g ms", 1e3 * task.game.scene.step_s);
    rows.push_back({"live scene", task.name + ", CPU per simulated second", 1e3 * row.cpuPerSimulated, "ms", step, "",
                    row.fault.empty() ? printed("%.1f times real time; memory %+.1f MB in the second half",
                                                row.realTimeFactor, row.growth_mb)
                                      : row.fault});
  }
  return rows;
}

std::vector<BenchRow> mpiRows(const BenchWork& work) {
  const std::string what = "two ranks, one worker each, against one";
  if (!isOnThePath("mpirun")) return {{"MPI", what, NAN, "times", "", "", "mpirun is not installed (openmpi-bin)"}};
  if (!fs::exists(fs::path(work.program).parent_path().parent_path() / "lib/libbtr_mpi.so"))
    return {{"MPI", what, NAN, "times", "", "", "this btr was built without MPI"}};
  const ScratchFolder folder("btr-bench");
  const std::string experiment = shortKick(work, folder);
  setenv("TMPDIR", folder.file("").c_str(), 0);  // Open MPI's own files
  double best[2] = {1e9, 1e9};
  for (int repeat = 0; repeat < std::min(2, work.repeats) && work.goesOn(); ++repeat)
    for (const int ranks : {1, 2}) {
      const std::string database = folder.file("ranks" + std::to_string(ranks) + "-" + std::to_string(repeat) + ".db");
      const double begin = wallSeconds();
      const ChildEnd end = runChild({"mpirun", "-n", std::to_string(ranks), "--oversubscribe", "--bind-to", "none",
                                     work.program, "run", experiment, "--db", database, "--jobs", "1", "--quiet"});
      if (end.exitCode != 0) return {{"MPI", what, NAN, "times", "", "", wordsOfMpirun(end.err)}};
      best[ranks - 1] = std::min(best[ranks - 1], wallSeconds() - begin);
    }
  return {{"MPI", what, best[0] / best[1], "times", "", "1.9 is aimed at, on idle cores",
           printed("six generations of 30 kicks, start of the ranks included: %.1f and %.1f s", best[0], best[1])}};
}

}  // namespace btr::cli
