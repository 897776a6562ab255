// btr gap prove, tally: the blind trial, and the counting of its cases.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "app/btr_commands.h"
#include "app/cluster/btr_array.h"
#include "app/cluster/btr_cluster.h"
#include "core/cluster/build_identity.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_run.h"
#include "core/gap/proof/proof_tally.h"
#include "core/gap/proof/proof_text.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/run_analysis.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

void printProof(const ProofScore& total, const std::vector<ProvedCase>& cases, const Shell& shell) {
  std::cout << (shell.json ? proofJson(total, cases) : proofText(total));
}

struct ProveArguments {
  ProofRequest request;
  ArrayArguments array;
  std::size_t perElement = 1;
  std::string places;  ///< file
};

/// "7" or "3-7".
void readRange(const std::string& text, ProofRequest& request) {
  const std::size_t dash = text.find('-');
  const auto numberFrom = [&](const std::string& part) {
    std::size_t number = 0;
    const auto read = std::from_chars(part.data(), part.data() + part.size(), number);
    if (read.ec != std::errc() || read.ptr != part.data() + part.size() || number < 1)
      throw CLI::ValidationError("--only", "\"" + text + "\": a case, as 3, or cases, as 3-7");
    return number;
  };
  request.from = numberFrom(text.substr(0, dash));
  request.to = dash == std::string::npos ? request.from : numberFrom(text.substr(dash + 1));
  if (request.to < request.from)
    throw CLI::ValidationError("--only", "\"" + text + "\": a case, as 3, or cases, as 3-7");
}

/// Cases that follow each other, at most so many together.
std::vector<std::vector<std::size_t>> handfuls(const std::vector<std::size_t>& numbers, std::size_t most) {
  std::vector<std::vector<std::size_t>> all;
  for (const std::size_t number : numbers) {
    if (all.empty() || all.back().size() >= most || all.back().back() + 1 != number) all.emplace_back();
    all.back().push_back(number);
  }
  return all;
}

std::vector<std::string> wordsOf(const ProofRequest& request, const std::vector<std::size_t>& cases) {
  const std::string first = std::to_string(cases.front()), last = std::to_string(cases.back());
  std::vector<std::string> words{"gap",     "prove",
                                 "--cases", last,
                                 "--only",  first + "-" + last,
                                 "--seed",  std::to_string(request.seed),
                                 "--out",   "{out}",
                                 "--place", request.place,
                                 "--jobs",  std::to_string(request.jobs)};
  for (const auto& [option, value] : {std::pair<const char*, std::string>{"--engine", request.engine},
                                      {"--scene", request.scene},
                                      {"--kind", request.kind},
                                      {"--dirt", request.dirt},
                                      {"--spoiled", request.spoiled ? std::to_string(request.spoiled) : ""}})
    if (!value.empty()) words.insert(words.end(), {option, value});
  return words;
}

/// An element for each case that is not finished yet, or for a handful of them.
void proveElsewhere(const ProveArguments& a, Shell& shell) {
  ProofRequest request = a.request;
  request.place = std::filesystem::absolute(request.out).lexically_normal().string();
  const std::vector<std::size_t> open = openCases(request);
  if (open.empty())
    throw InputError(request.out + ": all its cases are finished; without --slurm and --ssh they are counted");
  ArrayJob array;
  array.what = "gap prove";
  array.into = request.out;
  array.workers = request.jobs;
  const auto begin = [&](const std::string&, ArrayJob& job) {
    job.build = buildIdentity(shell.plugins(), request.generator);
    for (const std::vector<std::size_t>& cases : handfuls(open, a.perElement)) {
      const std::string first = std::to_string(cases.front()), last = std::to_string(cases.back());
      job.elements.push_back(
          {cases.size() == 1 ? "case " + first : "cases " + first + " to " + last, wordsOf(request, cases), cases});
    }
  };
  beginArray(a.array, std::move(array), begin, shell);
}

void proveCommand(ProveArguments& a, Shell& shell) {
  ClusterJob cluster(shell, "", a.request.jobs);
  if (cluster.isDone()) return;
  ProofRequest& request = a.request;
  request.generator = findGenerator();
  if (a.array.isWanted()) return proveElsewhere(a, shell);
  cluster.tellTo(a.places);
  request.force = cluster.caseForce();
  if (request.force && request.place.empty())
    request.place = std::filesystem::absolute(request.out).lexically_normal().string();
  const PluginHost& plugins = shell.plugins();
  const EffectLibrary library{plugins.effectFactory(), plugins.effects()};
  const bool show = isatty(STDERR_FILENO);
  const auto analyst = [](const AnalysisRequest& asked, const EffectLibrary& effects) {
    return runAnalysis(asked, effects);
  };
  const auto begin = std::chrono::steady_clock::now();
  std::size_t before = request.cases;
  bool isWhole = false;
  const auto tell = [&](std::size_t done, std::size_t all) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    before = std::min(before, done);
    isWhole = done == all;
    const double share = all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 1;
    cluster.tellProgress("blind cases", share, seconds > 0 ? static_cast<double>(done - before) / seconds : 0, true);
    if (show) std::fprintf(stderr, "\r%zu of %zu cases, %.0f s \x1b[K", done, all, seconds);
  };
  const auto cases = runProof(request, library, analyst, *shell.stop, tell);
  if (show) std::fprintf(stderr, "\n");
  cluster.tell("cases");
  printProof(score(cases), cases, shell);
  if (!isWhole) shell.exitCode = stoppedEarly;
}

struct TallyRequest {
  std::vector<std::string> trials;
  std::string out, save;
};

void tallyCommand(const TallyRequest& request, const Shell& shell) {
  const std::vector<ProvedCase> cases = provedCasesIn(request.trials);
  const ProofScore total = score(cases);
  if (!request.out.empty()) writeProof(request.out, total, cases);
  if (!request.save.empty()) writeFile(request.save, linesOf(cases));
  printProof(total, cases, shell);
}

void addTally(CLI::App& gap, Shell& shell) {
  auto request = std::make_shared<TallyRequest>();
  CLI::App* tally = gap.add_subcommand("tally", "count finished cases of blind trials together");
  tally->add_option("TRIAL", request->trials, "folder of a trial (prove --out), or a file that --save wrote")
      ->required()
      ->take_all();
  shell.writesFolder(tally, tally->add_option("--out", request->out, "folder for proof.json, proof.txt and proof.html"),
                     {"proof.json", "proof.txt", "proof.html"});
  shell.writesFile(tally, tally->add_option("--save", request->save, "file for the cases, one a line (.jsonl)"));
  tally->callback([request, &shell] { tallyCommand(*request, shell); });
}

}  // namespace

void addGapProveCommands(CLI::App& gap, Shell& shell) {
  auto a = std::make_shared<ProveArguments>();
  ProofRequest* request = &a->request;
  request->options.designNext = false;
  CLI::App* prove = gap.add_subcommand("prove", "blind trial: conceal, analyse, open the seal, score");
  prove->add_option("--cases", request->cases, "cases 1 to N of the seed; finished ones are not repeated")
      ->transform(wholeNumber(1, 100000))
      ->capture_default_str();
  prove->add_option("--seed", request->seed, "of the generator")->transform(seedNumber())->capture_default_str();
  CLI::Option* out =
      prove->add_option("--out", request->out, "folder for cases, proof.json, proof.txt and proof.html")->required();
  shell.writesFolder(prove, out);
  prove->add_option("--jobs", request->jobs, "worker processes, one case each; of every rank under mpirun")
      ->transform(wholeNumber(1, 1024))
      ->capture_default_str();
  prove->add_option("--engine", request->engine, "who is reality: ode or mujoco")
      ->check(CLI::IsMember({"ode", "mujoco"}));
  prove->add_option("--scene", request->scene, "only this kind of scene")
      ->check(CLI::IsMember({"pendulum", "leg", "carpet", "flight", "walk"}));
  prove->add_option("--kind", request->kind, "only this kind of case")
      ->check(CLI::IsMember({"nothing", "parameters", "one", "two", "outside"}));
  prove->add_option("--dirt", request->dirt, "what a logger did to the recordings")
      ->check(CLI::IsMember({"quiet", "jitter", "stale", "multirate", "dropped", "mixed"}));
  prove
      ->add_option("--spoiled", request->spoiled,
                   "trials of each case, at most a third, that are not what their files say")
      ->transform(wholeNumber(0, 100));
  prove->add_option_function<std::string>(
      "--only", [request](const std::string& text) { readRange(text, *request); },
      "of these cases only this one, or 3-7");
  prove->add_option("--place", request->place)->group("");  // of an element: where its cases are carried in the end
  addPlacesOption(prove, a->places);
  addArrayOptions(prove, a->array);
  prove->add_option("--per-element", a->perElement, "with --slurm and --ssh: cases of each element, one after another")
      ->transform(wholeNumber(1, 100000))
      ->capture_default_str();
  prove->callback([a, &shell] { proveCommand(*a, shell); });
  addTally(gap, shell);
}

}  // namespace btr::cli
