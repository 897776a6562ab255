// btr openr build, try: from sources to a stick, and a first run without a world.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "app/btr_commands.h"
#include "app/openr/btr_openr_robots.h"
#include "core/openr/builder/build_hint.h"
#include "core/openr/builder/stick_builder.h"
#include "core/openr/ended_text.h"
#include "core/openr/robot_process.h"
#include "core/openr/trivial_robot.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

void printBuild(const openr::StickBuild& build, const std::string& out) {
  for (const auto& object : build.objects) {
    if (!object.said.empty()) std::fprintf(stderr, "%s", object.said.c_str());
    if (object.modules.empty())
      std::fprintf(stderr, "%s: not built; %s\n", printable(object.folder).c_str(),
                   printable(openr::buildHint(object.said)).c_str());
    for (const std::string& module : object.modules)
      std::cout << printable(module) << "  from " << printable(object.folder) << "\n";
  }
  if (!build.absent.empty()) {
    std::cout << "OBJECT.CFG also names";
    for (const std::string& module : build.absent) std::cout << " " << printable(module);
    std::cout << ": not on the stick, started without; build their folders onto the same stick to have them\n";
  }
  std::cout << "stick: " << printable(out) << "\n";
}

void build(const openr::StickBuildOptions& options, Shell& shell) {
  const openr::StickBuild built = openr::buildStick(options);
  if (!built.complete()) shell.exitCode = badInput;
  if (!shell.json) return printBuild(built, options.out);
  nlohmann::json objects = nlohmann::json::array();
  for (const auto& object : built.objects)
    objects.push_back({{"folder", object.folder}, {"modules", object.modules}, {"compiler", object.said}});
  printJson({{"stick", options.out}, {"objects", objects}, {"absent", built.absent}});
}

struct TryArguments {
  openr::RobotProcess::Options process;
  double seconds = 10;
  bool motorPower = false, camera = false;
  std::string typed;
};

constexpr double frame_s = 0.008;

/// "1.234 MovingHead7: text"; what the system says has no name before it.
void printLines(const openr::OrderFrame& orders, double time_s) {
  for (const openr::ConsoleLine& line : orders.lines) {
    std::printf("%8.3f ", time_s);
    if (!line.object.empty()) std::printf("%s: ", printable(line.object).c_str());
    std::printf("%s\n", printableLine(line.text).c_str());
  }
}

/// How often each lamp that shone changed, by its place in the design.
class LampChanges {
 public:
  void add(const openr::OrderFrame& orders) {
    for (const auto& lamp : orders.lamps) {
      ++changes_[lamp.lamp];
      if (lamp.intensity > 0) shone_.insert(lamp.lamp);
    }
  }
  nlohmann::json named(const openr::RobotDesign& design) const {
    nlohmann::json lamps = nlohmann::json::object();
    for (const std::size_t lamp : shone_) lamps[design.lamps.at(lamp).name] = changes_.at(lamp);
    return lamps;
  }

 private:
  std::map<std::size_t, int> changes_;
  std::set<std::size_t> shone_;
};

/// "lamps that shone: face_3 (2 changes), mode_red (8 changes)"
void printLamps(const nlohmann::json& lamps) {
  std::string all;
  for (const auto& [name, changes] : lamps.items())
    all += (all.empty() ? "" : ", ") + name + " (" + changes.dump() + (changes == 1 ? " change)" : " changes)");
  if (!all.empty()) std::printf("lamps that shone: %s\n", all.c_str());
}

void tryOut(const TryArguments& arguments, Shell& shell) {
  const openr::RobotDesign& design = openr::robotDesign(arguments.process.design);
  openr::TrivialRobot robot(design);
  robot.typed = arguments.typed;
  openr::RobotProcess program(arguments.process);
  std::vector<std::int32_t> low = robot.joints(), high = low;
  LampChanges lamps;
  const auto last = static_cast<long>(arguments.seconds / frame_s);
  for (long frame = 0; frame <= last; ++frame) {
    robot.shutdown = frame == last || (shell.stop != nullptr && shell.stop->load());
    if (arguments.camera && frame % robot.imageEvery == robot.imageEvery - 1)
      robot.image = openr::TrivialRobot::roomWithBall(design, static_cast<double>(frame) * frame_s);
    const openr::OrderFrame orders = program.exchange(robot.sense());
    if (arguments.motorPower && frame == 0) {
      openr::OrderFrame on;
      on.motorPower = true;
      robot.obey(on);
    }
    openr::OrderFrame obeyed = orders;
    if (arguments.motorPower) obeyed.motorPower.reset();
    robot.obey(obeyed);
    lamps.add(orders);
    if (!shell.json) printLines(orders, static_cast<double>(frame) * frame_s);
    for (std::size_t i = 0; i < low.size(); ++i) {
      low[i] = std::min(low[i], robot.joints()[i]);
      high[i] = std::max(high[i], robot.joints()[i]);
    }
    if (orders.ended) break;
  }
  const openr::Ended& ended = *program.ended();
  if (ended.why != openr::Ended::Why::shutdown) shell.exitCode = badInput;
  nlohmann::json joints = nlohmann::json::object();
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (low[i] == high[i]) continue;
    joints[design.joints[i].name] = {low[i] * 1e-6, high[i] * 1e-6};
    if (!shell.json)
      std::printf("%s moved between %.6f and %.6f rad\n", design.joints[i].name.c_str(), low[i] * 1e-6, high[i] * 1e-6);
  }
  const nlohmann::json shone = lamps.named(design);
  if (shell.json) return printJson({{"ended", sentenceOf(ended)}, {"moved_rad", joints}, {"lamp_changes", shone}});
  printLamps(shone);
  std::fprintf(shell.exitCode == done ? stdout : stderr, "%s\n", printable(sentenceOf(ended)).c_str());
}

}  // namespace

void addOpenrBuildCommands(CLI::App& openr, Shell& shell) {
  auto options = std::make_shared<openr::StickBuildOptions>();
  CLI::App* make = openr.add_subcommand(
      "build", "compiles folders with OPEN-R sources onto a memory stick (needs g++, make and gzip)");
  make->add_option("folders", options->folders, "with the objects' folders and MS in them, or an object's own")
      ->required()
      ->check(CLI::ExistingDirectory);
  make->add_option("--out", options->out, "the stick: a folder, made or added to")->required();
  make->callback([options, &shell] {
    if (!shell.json && isatty(2) != 0)
      options->progress = [](const std::string& folder) { std::fprintf(stderr, "%s ...\n", folder.c_str()); };
    build(*options, shell);
  });

  auto arguments = std::make_shared<TryArguments>();
  CLI::App* attempt =
      openr.add_subcommand("try", "runs a stick without a world: joints go where they are told, sensors rest");
  attempt->add_option("--stick", arguments->process.stick, "the folder with OPEN-R/MW in it")
      ->required()
      ->check(CLI::ExistingDirectory);
  attempt->add_option("--design", arguments->process.design, "the robot: ERS-7, ERS-210 or ERS-220")
      ->capture_default_str();
  attempt->add_option("--seconds", arguments->seconds, "how long, simulated [s]")
      ->transform(decimalNumber(0, 1e6))
      ->capture_default_str();
  attempt->add_option("--type", arguments->typed, "typed on the console at the start; \\n ends a line");
  attempt->add_flag("--motor-power", arguments->motorPower,
                    "motors are on from the start, as if another object did it");
  attempt->add_flag("--camera", arguments->camera, "the camera sees a grey room with a pink ball that goes round");
  attempt->callback([arguments, &shell] {
    std::string typed;
    for (std::size_t i = 0; i < arguments->typed.size(); ++i) {
      const bool newline = arguments->typed.compare(i, 2, "\\n") == 0;
      typed += newline ? '\n' : arguments->typed[i];
      if (newline) ++i;
    }
    arguments->typed = typed;
    tryOut(*arguments, shell);
  });
}

}  // namespace btr::cli
