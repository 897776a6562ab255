// A robot's behaviour as a program of its own: what every such program has in common.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/remote/program/program_world.h"
#include "core/spec/number_options.h"

namespace {

using btr::InputError;
using btr::toText;

std::atomic<bool> stopped = false;

extern "C" void stopRobotProgram(int) { stopped = true; }

enum ExitCode { done = 0, badInput = 1, badUsage = 2, stoppedEarly = 3 };

/// "NAME=NUMBER", or a word of a parameter that has choices.
btr::Values valuesOf(const std::vector<std::string>& words, const std::vector<btr::Parameter>& declared,
                     const char* option) {
  btr::Values values;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals), text = equals == std::string::npos ? "" : word.substr(equals + 1);
    std::optional<double> number = btr::toNumber(text);
    if (const btr::Parameter* parameter = btr::find(declared, name); parameter && !number)
      for (std::size_t i = 0; i < parameter->choices.size(); ++i)
        if (parameter->choices[i] == text) number = static_cast<double>(i);
    if (!number) throw InputError(option, word, "NAME=NUMBER");
    values[name] = *number;
  }
  btr::resolve(declared, values, option);
  return values;
}

std::string declarations(const char* title, const std::vector<btr::Parameter>& declared) {
  if (declared.empty()) return "";
  std::string text = std::string(title) + ":\n";
  for (const btr::Parameter& each : declared)
    text += "  " + each.name + (each.unit.empty() ? "" : " [" + each.unit + "]") + ": " + each.meaning + ", " +
            toText(each.minimum) + " to " + toText(each.maximum) + ", else " + toText(each.byDefault) + "\n";
  return text;
}

int tell(const btr::remote::ProgramOutcome& outcome, bool asJson) {
  const double seconds = static_cast<double>(outcome.periods) * outcome.period_s;
  if (asJson) {
    const nlohmann::json result{{"periods", outcome.periods}, {"simulated_s", seconds},
                                {"late", outcome.late},       {"trace_sha256", outcome.traceSha256},
                                {"log", outcome.log},         {"fault", outcome.fault}};
    std::printf("%s\n", result.dump(1).c_str());
  } else {
    std::printf("%s s, %ld control periods\n", toText(seconds).c_str(), outcome.periods);
    if (!outcome.traceSha256.empty()) std::printf("trace %s\n", outcome.traceSha256.c_str());
    if (!outcome.log.empty()) std::printf("log %s\n", outcome.log.c_str());
  }
  if (outcome.late > 0)
    std::fprintf(stderr, "too late in %ld of %ld periods: the robot did what it had been told before\n", outcome.late,
                 outcome.late + outcome.periods);
  if (!outcome.fault.empty()) std::fprintf(stderr, "the world stopped: %s\n", outcome.fault.c_str());
  return !outcome.fault.empty() ? badInput : stopped ? stoppedEarly : done;
}

}  // namespace

int uchilsim::runProgram(int argc, char** argv, const BehaviourController& controller) {
  btr::remote::ServerAddress address;
  btr::remote::ProgramPlan plan;
  btr::remote::PlayedMotion played;
  std::vector<std::string> settings, parameters;
  bool once = false, asJson = false, unlogged = false;
  CLI::App app{"The behaviour \"" + controller.name() + "\": moves a robot of a world that a server runs (btr serve)"};
  app.footer(declarations("Parameters", controller.genotype()) + declarations("Settings", controller.settings()));
  app.add_option("--server", address.server, "HOST:PORT or unix:PATH")->required();
  CLI::Option* game = app.add_option("--game", plan.game,
                                     "a game, scene or robot of the server's folder: it is opened, played and closed");
  app.add_option("--world", plan.world, "or the name of a world that runs")->excludes(game);
  app.add_option("--robot", plan.robot, "which robot of it")->required();
  app.add_option("--parameter", parameters, "NAME=NUMBER of one of its parameters");
  app.add_option("--setting", settings, "NAME=NUMBER of one of its settings");
  app.add_option("--seconds", plan.seconds, "how long, simulated; 0: until it is over or stopped")
      ->transform(btr::cli::decimalNumber(0, 1e9))
      ->capture_default_str();
  app.add_flag("--once", once, "it does not begin again when it is over");
  app.add_option("--seed", plan.seed, "of the game (default: its own)")->transform(btr::cli::seedNumber());
  app.add_flag("--unlogged", unlogged, "the server writes no log of the game");
  app.add_option("--token-file", address.tokenFile, "a file with the token alone, where the server wants one")
      ->check(CLI::ExistingFile);
  app.add_option("--ca", address.authority, "TLS: certificate of who signed the server's (PEM)")
      ->check(CLI::ExistingFile);
  app.add_flag("--json", asJson, "the result as JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : badUsage;
  }
  std::signal(SIGINT, stopRobotProgram);
  std::signal(SIGTERM, stopRobotProgram);
  try {
    if (plan.game.empty() && plan.world.empty())
      throw InputError("--game", "none", "a game, or --world of one that runs");
    played = {valuesOf(settings, controller.settings(), "--setting"),
              valuesOf(parameters, controller.genotype(), "--parameter"), !once};
    plan.logged = !unlogged;
    plan.stopped = [] { return stopped.load(); };
    btr::remote::ServerLink server(address);
    return tell(btr::remote::playOnServer(server, controller, played, plan), asJson);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return badInput;
  }
}
