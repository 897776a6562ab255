// How far many machines pay: measures trials and what rank 0 does for them here, then lets the scheduler that btr uses
// hand out such trials to up to 1,000 simulated places. Never run by ctest.
//   bench_cluster [--svg FILE] [--csv FILE]
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <numeric>
#include <queue>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/cluster/coordinator.h"
#include "core/cluster/foreman.h"
#include "core/cluster/schedule.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/process.h"
#include "tests/temporary_folder.h"

namespace {

using namespace btr;

double cpuOf(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// CPU times of single trials of an experiment, drawn at random over its genotype.
std::vector<double> trialTimes(const std::string& experiment, int count, const PluginHost& host) {
  const PreparedExperiment prepared =
      prepareFromFiles(loadExperiment(std::string(SOURCE_DIR "/resources/experiments/") + experiment), host);
  const SimulatorSpec simulator = firstSimulator(prepared).simulator;
  Random random(3);
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) {
    TrialJob job;
    job.simulator = simulator;
    for (const Parameter& p : prepared.genotype) job.parameters.push_back(random.uniform(p.minimum, p.maximum));
    const double before = cpuOf(RUSAGE_SELF);
    runTrialJob(prepared, job);
    if (i > 0) times.push_back(cpuOf(RUSAGE_SELF) - before);  // the first one warms up
  }
  return times;
}

/// What rank 0 itself needs: CPU for each trial, and for each generation beside its trials.
struct Coordination {
  double job_s = 0, generation_s = 0;
};

Coordination coordination(const PluginHost& host) {
  const std::string examples = SOURCE_DIR "/resources/experiments";
  nlohmann::json text = nlohmann::json::parse(readFile(examples + "/kick-short.json"));
  constexpr int generations = 20, population = 30;
  text["learner"]["settings"]["population"] = population;
  text["stages"] = {{"first_generations", generations},
                    {"next_generations", generations},
                    {"total_generations", generations},
                    {"measured_individuals", 1}};
  text["reality"] = "person";
  const ExperimentSpec spec = experimentFromJson(text.dump(), "kick", examples);
  const PreparedExperiment prepared = prepareFromFiles(spec, host);
  CoordinatorOptions options;
  options.foremen = 2;
  Coordinator coordinator(nullptr, host, options);
  Coordination cost;
  const std::atomic<bool> goOn{false};

  TrialJob job;
  job.simulator = firstSimulator(prepared).simulator;
  for (const Parameter& p : prepared.genotype) job.parameters.push_back(p.byDefault);
  Evaluator evaluator(prepared, 1, &coordinator);
  evaluator.evaluate({job, job}, goOn);  // the foremen are there
  const std::vector<TrialJob> many(300, job);
  double before = cpuOf(RUSAGE_SELF);
  evaluator.evaluate(many, goOn);
  cost.job_s = (cpuOf(RUSAGE_SELF) - before) / static_cast<double>(many.size());

  TemporaryFolder folder;
  Database database = Database::open(folder.file("a.db"), Database::Mode::create);
  const Id run = startRun(database, host, spec, 1);
  RunOptions runOptions;
  runOptions.workforce = &coordinator;
  before = cpuOf(RUSAGE_SELF);
  continueRun(database, host, run, goOn, runOptions);
  const double all = cpuOf(RUSAGE_SELF) - before;
  cost.generation_s = std::max(0.0, all / generations - population * cost.job_s);
  return cost;
}

struct Simulated {
  double efficiency = 0;   ///< work done by all places, over what they could have done
  double coordinator = 0;  ///< share of the time in which rank 0 was busy
};

/// Rounds of `jobs` trials (a generation, or the generations of a grid's cells) on `places`, each message taking
/// `latency_s` on its way; rank 0 does one thing at a time.
Simulated simulate(const std::vector<double>& times, std::size_t jobs, std::size_t places, double latency_s,
                   const Coordination& cost, int rounds) {
  struct Event {
    double at;
    std::size_t place;
    bool operator>(const Event& other) const { return at > other.at; }
  };
  struct Piece {
    std::vector<std::size_t> jobs;
    double worked_s = 0, sent = 0;
  };
  struct Place {
    std::deque<Piece> pieces;
    double freeAt = 0;
  };
  Random random(1);
  Pace pace;
  double clock = 0, work = 0, busy = 0;  // of rank 0
  std::vector<Place> all(places);
  for (int round = 0; round < rounds; ++round) {
    Schedule schedule(jobs, places);
    std::size_t finished = 0;
    std::priority_queue<Event, std::vector<Event>, std::greater<>> arrivals;
    for (Place& place : all) place.freeAt = clock;
    const auto handOut = [&](std::size_t number) {
      Place& place = all[number];
      while (true) {
        Piece piece;
        piece.jobs = schedule.next(pace, place.pieces.size());
        if (piece.jobs.empty()) return;
        // Half of what a trial costs rank 0 is writing it, half reading its result.
        const double writing = 0.5 * cost.job_s * static_cast<double>(piece.jobs.size());
        clock += writing;
        busy += writing;
        piece.sent = clock;
        for (std::size_t i = 0; i < piece.jobs.size(); ++i)
          piece.worked_s += times[static_cast<std::size_t>(random.uniform() * static_cast<double>(times.size()))];
        work += piece.worked_s;
        place.freeAt = std::max(place.freeAt, clock + latency_s) + piece.worked_s;
        arrivals.push({place.freeAt + latency_s, number});
        place.pieces.push_back(std::move(piece));
      }
    };
    for (std::size_t number = 0; number < places; ++number) handOut(number);
    while (finished < jobs) {
      const Event event = arrivals.top();
      arrivals.pop();
      Place& place = all[event.place];
      const Piece piece = std::move(place.pieces.front());
      place.pieces.pop_front();
      clock = std::max(clock, event.at);
      const double reading = 0.5 * cost.job_s * static_cast<double>(piece.jobs.size());
      clock += reading;
      busy += reading;
      pace.add(piece.jobs.size(), piece.worked_s, clock - piece.sent);
      finished += piece.jobs.size();
      handOut(event.place);
    }
    clock += cost.generation_s;
    busy += cost.generation_s;
  }
  return {work / (clock * static_cast<double>(places)), busy / clock};
}

struct Curve {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;  ///< places, efficiency
};

/// Efficiency over places, both axes with their numbers; places logarithmic.
std::string drawn(const std::vector<Curve>& curves) {
  constexpr double width = 760, height = 420, left = 60, top = 20, right = 230, bottom = 50;
  const auto x = [&](double places) { return left + (width - left - right) * std::log10(places) / 3; };
  const auto y = [&](double efficiency) { return top + (height - top - bottom) * (1 - efficiency); };
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 420\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"760\" height=\"420\" fill=\"white\"/>\n";
  char line[400];
  for (const int tick : {1, 3, 10, 30, 100, 300, 1000}) {
    std::snprintf(line, sizeof line,
                  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/><text x=\"%.1f\" y=\"%.1f\" "
                  "text-anchor=\"middle\">%d</text>\n",
                  x(tick), y(1), x(tick), y(0), x(tick), y(0) + 18, tick);
    svg += line;
  }
  for (int percent = 0; percent <= 100; percent += 20) {
    std::snprintf(line, sizeof line,
                  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/><text x=\"%.1f\" y=\"%.1f\" "
                  "text-anchor=\"end\">%d %%</text>\n",
                  x(1), y(percent / 100.0), x(1000), y(percent / 100.0), left - 8, y(percent / 100.0) + 4, percent);
    svg += line;
  }
  double legend = top + 10;
  for (const Curve& curve : curves) {
    svg += "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" + curve.colour + "\" points=\"";
    for (const auto& [places, efficiency] : curve.points) {
      std::snprintf(line, sizeof line, "%.1f,%.1f ", x(places), y(efficiency));
      svg += line;
    }
    svg += "\"/>\n";
    std::snprintf(line, sizeof line,
                  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"/><text "
                  "x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                  width - right + 12, legend, width - right + 32, legend, curve.colour.c_str(), width - right + 38,
                  legend + 4, curve.name.c_str());
    svg += line;
    legend += 20;
  }
  std::snprintf(line, sizeof line,
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">places (cores that work)</text>\n", x(31.6),
                height - 10);
  return svg + line + "</svg>\n";
}

}  // namespace

int main(int argc, char** argv) {
  beginProgram();
  const PluginHost host(PLUGIN_DIR);
  if (argc > 1 && std::string(argv[1]) == "pieces") {
    servePieces(host, 120);
    return 0;
  }
  std::string svg, csv;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    (option == "--svg" ? svg : csv) = argv[i + 1];
  }
  const Coordination cost = coordination(host);
  std::printf("rank 0: %.3f ms of CPU for each trial, %.2f ms for each generation\n", 1e3 * cost.job_s,
              1e3 * cost.generation_s);
  std::map<std::string, std::vector<double>> tasks{{"kick", trialTimes("kick-short.json", 60, host)},
                                                   {"walk", trialTimes("walk-short.json", 30, host)}};
  // Blind cases: what each of a whole trial took when it was made.
  std::istringstream trial(readFile(SOURCE_DIR "/resources/trials/20261170.jsonl"));
  for (std::string line; std::getline(trial, line);)
    if (const double seconds = nlohmann::json::parse(line).value("seconds", 0.0); seconds > 0)
      tasks["analysis"].push_back(seconds);
  for (const auto& [name, times] : tasks)
    std::printf("%s: %.1f ms each, %.1f to %.1f\n", name.c_str(),
                1e3 * std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size()),
                1e3 * *std::min_element(times.begin(), times.end()),
                1e3 * *std::max_element(times.begin(), times.end()));

  std::string table = "task,jobs_in_a_round,latency_ms,places,efficiency,rank_0_busy\n";
  std::vector<Curve> curves;
  const std::map<std::string, std::string> colours{{"kick 100 1", "#1f77b4"},     {"kick 1000 1", "#2ca02c"},
                                                   {"kick 10000 0.1", "#bcbd22"}, {"kick 10000 1", "#d62728"},
                                                   {"kick 10000 5", "#e377c2"},   {"walk 1000 1", "#9467bd"},
                                                   {"walk 10000 1", "#17becf"},   {"analysis 10000 1", "#000000"}};
  for (const auto& [name, times] : tasks)
    for (const std::size_t jobs : {100u, 1000u, 10000u})
      for (const double latency_ms : {0.1, 1.0, 5.0}) {
        char key[64], row[160];
        std::snprintf(key, sizeof key, "%s %zu %g", name.c_str(), jobs, latency_ms);
        const auto colour = colours.find(key);
        std::snprintf(row, sizeof row, "%s, %zu a round, %g ms", name.c_str(), jobs, latency_ms);
        Curve curve{row, colour == colours.end() ? "" : colour->second, {}};
        for (const std::size_t places : {1, 2, 4, 8, 16, 32, 64, 100, 128, 180, 256, 360, 512, 720, 1000}) {
          const Simulated s = simulate(times, jobs, places, 1e-3 * latency_ms, cost, jobs >= 10000 ? 3 : 20);
          std::snprintf(row, sizeof row, "%s,%zu,%g,%zu,%.4f,%.4f\n", name.c_str(), jobs, latency_ms, places,
                        s.efficiency, s.coordinator);
          table += row;
          curve.points.emplace_back(static_cast<double>(places), s.efficiency);
        }
        if (!curve.colour.empty()) curves.push_back(curve);
      }
  if (!csv.empty()) writeFile(csv, table);
  if (!svg.empty()) writeFile(svg, drawn(curves));
  if (csv.empty()) std::printf("%s", table.c_str());
  return 0;
}
