// btr gap residual: recorded against simulated.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/btr_commands.h"
#include "app/cluster/btr_cluster.h"
#include "app/progress_line.h"
#include "core/cluster/analysis/shared_analysis.h"
#include "core/gap/fit/fitted_start.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/job_share.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/inverse.h"
#include "core/gap/replay/inverse_text.h"
#include "core/gap/replay/predict.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/residual_text.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"
#include "core/spec/system/cancelled.h"

namespace btr::cli {
namespace {

/// --start: where a replay of each trial begins.
void addStart(CLI::App& command, StartEstimator& start) {
  start = fittedStart;
  command
      .add_option_function<std::string>(
          "--start",
          [&start](const std::string& text) { start = text == "estimated" ? StartEstimator(fittedStart) : nullptr; },
          "where each trial begins: fitted to all of its samples, as in an analysis (estimated), or as its first ones "
          "say (first-samples)")
      ->check(CLI::IsMember({"estimated", "first-samples"}))
      ->default_str("estimated");
}

struct ResidualArguments {
  ResidualRequest request;
  bool inverse = false;
  InverseOptions filters;
};

void residualCommand(const ResidualArguments& arguments, Shell& shell) {
  const bool show = isatty(STDERR_FILENO);
  bool stopped = false;
  const auto progress = [&](std::size_t done, std::size_t all) {
    if (show) std::fprintf(stderr, "\rreplayed %zu of %zu recordings \x1b[K", done, all);
    stopped = *shell.stop;
    return !stopped;
  };
  const EffectFactory effects = shell.plugins().effectFactory();
  std::string text;
  if (arguments.inverse) {
    const InverseReport report = runInverse(arguments.request, effects, arguments.filters, progress);
    text = shell.json ? toJsonText(report) : inverseTable(report);
  } else {
    const ResidualReport report = runResidual(arguments.request, effects, progress);
    text = shell.json ? toJsonText(report) : residualTable(report);
  }
  if (show) std::fprintf(stderr, "\n");
  std::cout << text;
  if (stopped) shell.exitCode = stoppedEarly;
}

/// All is done once the report is written, not before.
constexpr double nearlyAll = 0.999;

long jobsOf(const std::vector<PlaceReport>& places) {
  return std::accumulate(places.begin(), places.end(), 0L,
                         [](long sum, const PlaceReport& place) { return sum + place.jobs; });
}

/// True from so many seconds after now on.
std::function<bool()> after(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  return [end] { return std::chrono::steady_clock::now() >= end; };
}

/// Of one of several ranks: rank 0 hands out the work and prints, the others return when it lets them.
void analyseOnRanks(const AnalysisRequest& request, const std::string& placesFile, ProgressLine& progress,
                    Shell& shell) {
  const int workers = request.options.jobs > 0 ? request.options.jobs : shareOfProcessors();
  CoordinatorOptions options;
  options.command.insert(options.command.end(), {"--workers", std::to_string(workers)});
  RankRole role = takeRole(shell, std::move(options));
  if (role.isDone) return;
  PlacesFile places;
  places.begin(placesFile);
  SharedAnalysis analysis(std::move(role.link), shell.plugins(), role.options);
  const auto begun = std::chrono::steady_clock::now();
  const auto tell = [&](const std::string& stage, double share) {
    if (!places.isKept()) return;
    const auto report = analysis.report();
    const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    places.tell(stage, share, elapsed_s > 0 ? static_cast<double>(jobsOf(report)) / elapsed_s : 0, report);
  };
  const auto text = analysis.run(
      request,
      [&](const std::string& stage, double share) {
        tell(stage, std::min(share, nearlyAll));
        return progress(stage, share);
      },
      *shell.stop);
  tell("", 1);
  progress.end();
  for (const std::string& note : analysis.notes()) std::fprintf(stderr, "btr: %s\n", note.c_str());
  tellHosts(analysis.report(), "parts of the analysis");
  std::cout << (shell.json ? text.json : text.plain);
}

void analyseHere(AnalysisRequest request, const std::string& placesFile, ProgressLine& progress, Shell& shell) {
  if (request.options.jobs == 0) request.options.jobs = processorCount();
  PlacesFile places;
  places.begin(placesFile);
  const EffectLibrary library{shell.plugins().effectFactory(), shell.plugins().effects()};
  const GapReport report = runAnalysis(request, library, [&](const std::string& stage, double share) {
    places.tell(stage, std::min(share, nearlyAll), 0, {});
    return progress(stage, share);
  });
  places.tell("", 1, 0, {});
  progress.end();
  std::cout << (shell.json ? toJsonText(report) : toPlainText(report));
}

struct AnalyseArguments {
  AnalysisRequest request;
  std::string places;
  double within_s = 0;  ///< 0: as long as it takes
  bool lines = false;
};

void analyseCommand(const AnalyseArguments& asked, Shell& shell) {
  ProgressLine progress(shell, asked.lines);
  const bool isShared = launchOfThisProcess().size > 1;
  // Ranks decide alike at every step; no two clocks do.
  if (isShared && asked.within_s > 0)
    throw InputError("--within " + toText(asked.within_s), "several ranks", "one process, or no limit of time");
  AnalysisRequest request = asked.request;
  if (asked.within_s > 0) request.options.isEnough = after(asked.within_s);
  try {
    if (isShared)
      analyseOnRanks(request, asked.places, progress, shell);
    else
      analyseHere(request, asked.places, progress, shell);
  } catch (const Cancelled&) {
    progress.end();
    std::fprintf(stderr, "stopped; nothing was written\n");
    shell.exitCode = stoppedEarly;
  }
}

void addAnalyse(CLI::App& gap, Shell& shell) {
  auto asked = std::make_shared<AnalyseArguments>();
  AnalysisRequest* const request = &asked->request;
  request->options.jobs = 0;
  CLI::App* analyse = gap.add_subcommand("analyse", "find the physics that the simulator left out");
  analyse->add_option("SCENE.json", request->scene, "scene file; its \"calibrate\" list is what a fit may change")
      ->required();
  analyse->add_option("--recording", request->recordings, "recorded trial (.csv), several are several trials")
      ->required()
      ->take_all();
  analyse->add_option("--held-out", request->heldOut, "trials that no fit sees, scored at the end")->take_all();
  analyse->add_option("--mapping", request->mapping, "which column is which channel, for all recordings");
  analyse->add_option("--simulator", request->simulator, "simulator version to start from (simulator.json)");
  CLI::Option* out =
      analyse->add_option("--out", request->out, "folder for report.json, report.html, simulator.json")->required();
  shell.writesFolder(analyse, out,
                     {"report.json", "report.html", "simulator.json", "next_command.csv", "remainder.csv"});
  analyse
      ->add_option("--jobs", request->options.jobs,
                   "worker processes (as many as processors, if not said); of each rank under mpirun or srun")
      ->transform(wholeNumber(1, 256));
  analyse->add_option("--seed", request->options.seed, "of the fits' starting points")->transform(seedNumber());
  analyse->add_option("--effects", request->options.effects, "consider only these")->take_all();
  analyse
      ->add_option("--maximum-effects", request->options.maximumEffects,
                   "at most so many are added; at several joints of a robot the same effect counts once")
      ->transform(wholeNumber(0, 8));
  analyse->add_flag("--as-recorded", request->options.asRecorded,
                    "go on although a column is certainly not what its name says");
  constexpr double longest_s = 1e6;
  analyse
      ->add_option("--within", asked->within_s,
                   "seconds after which nothing more is looked for; the report has what was found until then")
      ->transform(decimalNumber(1, longest_s));
  analyse->add_flag("--progress", asked->lines, "a line STAGE SHARE on standard error at every step");
  addPlacesOption(analyse, asked->places);
  analyse->callback([asked, &shell] { analyseCommand(*asked, shell); });
}

void predictCommand(const PredictRequest& request, Shell& shell) try {
  nlohmann::json all = nlohmann::json::array();
  const auto goesOn = [&shell] { return !*shell.stop; };
  for (const Recording& predicted : runPredict(request, shell.plugins().effectFactory(), goesOn)) {
    all.push_back({{"file", predicted.source}, {"rows", predicted.rows()}, {"notes", predicted.notes}});
    if (shell.json) continue;
    std::cout << predicted.source << ": " << predicted.rows() << " rows, " << predicted.channels.size() - 1
              << " channels\n";
    for (const std::string& note : predicted.notes) std::cout << "  note: " << note << '\n';
  }
  if (shell.json) printJson(all);
} catch (const Cancelled&) {
  std::fprintf(stderr, "stopped; nothing was written\n");
  shell.exitCode = stoppedEarly;
}

void addPredict(CLI::App& gap, Shell& shell) {
  auto request = std::make_shared<PredictRequest>();
  CLI::App* predict = gap.add_subcommand("predict", "what would be recorded under a recording's commands");
  predict->add_option("SCENE.json", request->scene, "scene file")->required();
  predict->add_option("--recording", request->recording, "whose times, commands and first samples are used (.csv)")
      ->required();
  predict->add_option("--simulator", request->simulator, "simulator version to use (simulator.json)");
  predict->add_option("--mapping", request->mapping, "which column is which channel");
  addStart(*predict, request->start);
  shell.writesFile(predict, predict->add_option("--out", request->out, "file to write (.csv)")->required());
  predict->callback([request, &shell] { predictCommand(*request, shell); });
}

}  // namespace

void addGapCommands(CLI::App& app, Shell& shell) {
  CLI::App* gap = app.add_subcommand("gap", "simulated against recorded");
  gap->require_subcommand(1);
  addGapAdoptCommands(*gap, shell);
  addGapStoreCommands(*gap, shell);
  addGapProveCommands(*gap, shell);
  auto arguments = std::make_shared<ResidualArguments>();
  ResidualRequest* request = &arguments->request;
  CLI::App* residual = gap->add_subcommand("residual", "simulate the recorded commands, report the mismatch");
  residual->add_option("SCENE.json", request->scene, "scene file")->required();
  residual->add_option("--recording", request->recordings, "recorded trial (.csv), several are several trials")
      ->required()
      ->take_all();
  residual->add_option("--mapping", request->mapping, "which column is which channel, for all recordings");
  residual->add_option("--simulator", request->simulator, "simulator version to use (simulator.json)");
  shell.writesFolder(residual, residual->add_option("--out", request->out, "folder for tables and overlay plots"),
                     {"residual.json", "residual.txt", "inverse.json", "inverse.txt"});
  residual->add_flag("--as-recorded", request->asRecorded, "go on although the time is certainly not in seconds");
  addStart(*residual, request->start);
  CLI::Option* inverse = residual->add_flag("--inverse", arguments->inverse,
                                            "follow the recorded motion and compare the torque that it takes");
  residual->add_option("--lowpass", arguments->filters.lowpass_hz, "of the positions that are followed [Hz]")
      ->transform(decimalNumber())
      ->needs(inverse)
      ->capture_default_str();
  residual->add_option("--every", arguments->filters.every, "torques are filtered and compared at every n-th sample")
      ->transform(wholeNumber(1, 1000000))
      ->needs(inverse)
      ->capture_default_str();
  residual->callback([arguments, &shell] { residualCommand(*arguments, shell); });
  addAnalyse(*gap, shell);
  addPredict(*gap, shell);
}

}  // namespace btr::cli
