// btr gap prove, tally: the blind trial, and the counting of its cases.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>

#include "app/btr_commands.h"
#include "app/cluster/btr_array.h"
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

/// An element for each case.
void proveElsewhere(const ProofRequest& request, const ArrayArguments& arguments, Shell& shell) {
  ArrayJob array;
  array.what = "gap prove";
  array.into = request.out;
  const auto begin = [&](const std::string&, ArrayJob& job) {
    for (std::size_t number = 1; number <= request.cases; ++number) {
      const std::string only = std::to_string(number);
      std::vector<std::string> words{
          "gap", "prove", "--cases", only, "--only", only, "--seed", std::to_string(request.seed), "--out", "{out}"};
      for (const auto& [option, value] : {std::pair<const char*, std::string>{"--engine", request.engine},
                                          {"--scene", request.scene},
                                          {"--kind", request.kind},
                                          {"--dirt", request.dirt},
                                          {"--spoiled", request.spoiled ? std::to_string(request.spoiled) : ""}})
        if (!value.empty()) words.insert(words.end(), {option, value});
      job.elements.push_back({"case " + only, std::move(words)});
    }
  };
  beginArray(arguments, std::move(array), begin, shell);
}

void proveCommand(ProofRequest request, Shell& shell) {
  request.generator = findGenerator();
  const PluginHost& plugins = shell.plugins();
  const EffectLibrary library{plugins.effectFactory(), plugins.effects()};
  const bool show = isatty(STDERR_FILENO);
  const auto analyst = [](const AnalysisRequest& asked, const EffectLibrary& effects) {
    return runAnalysis(asked, effects);
  };
  const auto begin = std::chrono::steady_clock::now();
  const auto cases = runProof(request, library, analyst, *shell.stop, [&](std::size_t done, std::size_t all) {
    if (!show) return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::fprintf(stderr, "\r%zu of %zu cases, %.0f s \x1b[K", done, all, seconds);
  });
  if (show) std::fprintf(stderr, "\n");
  printProof(score(cases), cases, shell);
  if (cases.size() < (request.only ? 1 : request.cases)) shell.exitCode = stoppedEarly;
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
  auto request = std::make_shared<ProofRequest>();
  request->options.designNext = false;
  CLI::App* prove = gap.add_subcommand("prove", "blind trial: conceal, analyse, open the seal, score");
  prove->add_option("--cases", request->cases, "cases 1 to N of the seed; finished ones are not repeated")
      ->transform(wholeNumber(1, 100000))
      ->capture_default_str();
  prove->add_option("--seed", request->seed, "of the generator")->transform(seedNumber())->capture_default_str();
  CLI::Option* out =
      prove->add_option("--out", request->out, "folder for cases, proof.json, proof.txt and proof.html")->required();
  shell.writesFolder(prove, out);
  prove->add_option("--jobs", request->jobs, "worker processes, one case each")
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
  prove->add_option("--only", request->only, "of these cases only this one")->transform(wholeNumber(1, 100000));
  auto array = std::make_shared<ArrayArguments>();
  addArrayOptions(prove, *array);
  prove->callback([request, array, &shell] {
    if (array->isWanted()) return proveElsewhere(*request, *array, shell);
    proveCommand(*request, shell);
  });
  addTally(gap, shell);
}

}  // namespace btr::cli
