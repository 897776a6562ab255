// btr gait check.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/run/reality/gait_check.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

struct GaitArguments {
  std::vector<std::string> gaits, heldOut, adapted;
  std::string out;
  GaitCheckOptions options;
};

void printTable(const GaitCheck& check) {
  std::vector<std::vector<std::string>> rows;
  for (const GaitResult& g : check.gaits)
    rows.push_back({g.name, g.robot, g.unit, brief(g.real), brief(g.before), signedPercent(g.relative(g.before)),
                    brief(g.after), signedPercent(g.relative(g.after)),
                    !g.measured ? "commanded"
                    : g.heldOut ? "held out"
                                : "fitted"});
  std::cout << table({"gait", "robot", "unit", "real", "before", "off by", "after", "off by", "used as"}, rows);
  std::cout << "\nroot mean square of simulated/real − 1: fitted " << brief(check.errorBefore) << " before, "
            << brief(check.errorAfter) << " after";
  if (check.heldOutBefore > 0)
    std::cout << "; held out " << brief(check.heldOutBefore) << " before, " << brief(check.heldOutAfter) << " after";
  std::cout << "\nadapted:";
  for (const auto& [name, value] : check.after.values) std::cout << ' ' << name << ' ' << brief(value);
  std::cout << (check.after.values.empty() ? " nothing was better than the starting values\n" : "\n");
}

void printCheck(const GaitCheck& check) {
  nlohmann::json gaits = nlohmann::json::array();
  for (const GaitResult& g : check.gaits)
    gaits.push_back({{"gait", g.name},
                     {"robot", g.robot},
                     {"unit", g.unit},
                     {"real", g.real},
                     {"kind", g.measured ? "measured" : "commanded"},
                     {"held_out", g.heldOut},
                     {"before", g.before},
                     {"after", g.after},
                     {"detail_before", g.detailBefore},
                     {"detail_after", g.detailAfter}});
  printJson({{"gaits", gaits},
             {"error_before", check.errorBefore},
             {"error_after", check.errorAfter},
             {"held_out_before", check.heldOutBefore},
             {"held_out_after", check.heldOutAfter},
             {"simulator", simulatorToJson(check.after)}});
}

void checkCommand(const GaitArguments& a, Shell& shell) {
  std::vector<GaitSpec> gaits;
  std::vector<bool> heldOut;
  for (const auto* files : {&a.gaits, &a.heldOut})
    for (const std::string& file : *files) {
      gaits.push_back(loadGait(file));
      heldOut.push_back(files == &a.heldOut);
    }
  GaitCheckOptions options = a.options;
  options.adapted = a.adapted;
  if (isatty(STDERR_FILENO))
    options.progress = [&](int generation, double error) {
      std::fprintf(stderr, "\rgeneration %d of %d, error %.4f", generation, options.generations, error);
      if (generation == options.generations) std::fprintf(stderr, "\n");
    };
  const auto check = checkGaits(gaits, heldOut, shell.plugins(), options, *shell.stop);
  if (!check) {
    std::cerr << "stopped: nothing was written\n";
    shell.exitCode = stoppedEarly;
    return;
  }
  if (!a.out.empty()) writeFile(a.out, toJsonText(check->after));
  shell.json ? printCheck(*check) : printTable(*check);
}

}  // namespace

void addGaitCommands(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<GaitArguments>();
  CLI::App* gait = app.add_subcommand("gait", "published gaits as a check on reality");
  gait->require_subcommand(1);
  CLI::App* check = gait->add_subcommand("check", "simulate gaits of known real speed, adapt the simulator to them");
  check->add_option("gaits", a->gaits, "gait files that the simulator is adapted to")->required();
  check->add_option("--held-out", a->heldOut, "gait files that the adaptation does not see");
  check->add_option("--adapt", a->adapted, "simulator parameters that may change; default: all but the masses");
  check->add_option("--generations", a->options.generations, "of the adaptation")->transform(wholeNumber(1, 100000));
  check->add_option("--population", a->options.population, "of the adaptation")->transform(wholeNumber(2, 10000));
  check->add_option("--jobs", a->options.jobs, "worker processes")->transform(wholeNumber(1, 1024));
  check->add_option("--seed", a->options.seed, "of the adaptation")->transform(seedNumber());
  shell.writesFile(check, check->add_option("--out", a->out, "write the adapted simulator to this file"));
  check->callback([a, &shell] { checkCommand(*a, shell); });
}

}  // namespace btr::cli
