/// A simulator with concealed numbers plays the robot, for demonstrations and tests: `btr stand-in`, a process of its
/// own. What it conceals is drawn from the experiment's block "stand_in".
#include "core/plugin/plugin.h"

namespace {

class StandIn final : public btr::Reality {
  std::string meaning() const override {
    return "A simulated robot with concealed parameters, for demonstration; no real robot";
  }
  bool records(const btr::Values&) const override { return true; }
  std::string who() const override { return "stand-in reality"; }

  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext& context) const override {
    return std::make_unique<btr::RobotProgram>(
        std::vector<std::string>{context.btr, "stand-in", "--db", context.database, "--run",
                                 std::to_string(context.run)},
        btr::RobotProgram::Options{"the stand-in reality", 0, context.stopped});
  }
};

}  // namespace

BTR_REALITY(StandIn, "stand_in")
