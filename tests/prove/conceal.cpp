// The blind generator: hides physics in recordings and seals the answer. It knows nothing of the analysis.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "core/plugin/plugin_host.h"
#include "core/spec/sha256.h"
#include "tests/prove/blind_case.h"

int main(int argc, char** argv) {
  using namespace btr;
  using namespace btr::prove;
  CLI::App app{"Draws a case for a blind trial of gap analysis from (seed, case) and seals its answer", "conceal"};
  app.require_subcommand(1);
  CaseRequest request;
  std::string folder;
  const auto addCommon = [&](CLI::App* command) {
    command->add_option("--seed", request.seed, "of the whole trial");
    command->add_option("--case", request.number, "number of the case");
    command->add_option("--engine", request.engine, "who is reality: ode or mujoco");
    command->add_option("--scene", request.scene, "kind of scene, drawn if it is not given");
    command->add_option("--kind", request.kind, "kind of case, drawn if it is not given");
    command->add_option("--dirt", request.dirt, "quiet, jitter, stale, multirate, dropped or mixed");
    command->add_option("--spoiled", request.spoiled, "trials, at most a third, that are not what their files say");
  };
  CLI::App* make = app.add_subcommand("make", "write scene and recordings; print the SHA-256 of the answer");
  addCommon(make);
  make->add_option("--out", folder, "folder of the case")->required();
  CLI::App* open = app.add_subcommand("open", "derive the answer again and print it");
  addCommon(open);
  CLI::App* fresh = app.add_subcommand("fresh", "write further recordings of the same case, after its verdict");
  addCommon(fresh);
  fresh->add_option("--out", folder, "folder of these recordings")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const PluginHost host(PluginHost::searchPath());
    const Hideable library{host.effectFactory(), host.effects()};
    const BlindCase blind = drawCase(request, library);
    const std::string answer = toJsonText(blind.answer);
    if (make->parsed()) writeCase(blind, library, folder);
    if (fresh->parsed()) writeFresh(blind, library, folder);
    if (make->parsed()) std::cout << sha256(answer) << "\n";
    if (open->parsed()) std::cout << answer;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "conceal: %s\n", error.what());
    return 1;
  }
  return 0;
}
