/// A program measures: it drives a robot, or plays one. Started as PROGRAM stand-in --db DATABASE --run RUN, it gets a
/// request a line and answers a line, as `btr stand-in` does (robot_program.h).
#include "core/plugin/plugin.h"

namespace {

class Program final : public btr::Reality {
  std::string meaning() const override { return "A program drives the robot and answers with what it measured"; }

  std::vector<btr::Parameter> settings() const override {
    return {{"timeout_s", "s", "longest time for one answer", 1, 86400, 600},
            {"records", "", "whether it also writes the recordings", 0, 1, 0, {}, false, {"no", "yes"}}};
  }
  std::vector<btr::TextSetting> texts() const override {
    return {{"program", "the program that measures", btr::TextSetting::Kind::program}};
  }
  bool records(const btr::Values& settings) const override {
    return btr::valueOf(this->settings(), settings, "records") == 1;
  }
  std::string who() const override { return "program"; }

  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext& context) const override {
    const std::string& program = context.texts.at("program");
    return std::make_unique<btr::RobotProgram>(
        std::vector<std::string>{program, "stand-in", "--db", context.database, "--run", std::to_string(context.run)},
        btr::RobotProgram::Options{program, btr::valueOf(settings(), context.settings, "timeout_s"), context.stopped});
  }
};

}  // namespace

BTR_REALITY(Program, "program")
