/// An OPEN-R program moves the robot: what stands on a memory stick, a folder with OPEN-R/MW in it (the setting
/// "stick", relative to the experiment's file). What evolves is named in the stick's parameters.json and reaches the
/// program as /MS/PARAMS.TXT, a line NAME VALUE for each; every trial has a copy of the stick of its own. Robots begin
/// as the scene has them, a free four-legged one on a floor in a stance. See TrialMotion for what its sensors say.
#include <cmath>
#include <memory>

#include "core/openr/robot_starter.h"
#include "core/openr/trial_motion.h"
#include "core/plugin/plugin.h"

namespace {

class OpenrController final : public btr::Controller {
 public:
  OpenrController() = default;
  explicit OpenrController(const std::string& stick)
      : stick_(stick),
        genotype_(btr::openr::stickParameters(stick)),
        shelf_(std::make_shared<btr::openr::StickShelf>()) {}

  std::vector<btr::Parameter> genotype() const override { return genotype_; }

  std::vector<btr::Parameter> settings() const override {
    return {{"duration_s", "s", "how long the program moves the robot", 0.1, 600, 10},
            {"motors", "", "whether motors are on at the start", 0, 1, 0, {}, false, {"on", "off"}}};
  }

  std::vector<std::string> paths() const override { return {"stick"}; }

  std::shared_ptr<const btr::Controller> with(const std::map<std::string, std::string>& paths) const override {
    return std::make_shared<OpenrController>(paths.at("stick"));
  }

  void arrange(btr::Scene& scene, const btr::Values&) const override {
    const btr::SceneRobot& robot = scene.robots.at(0);
    if (robot.freeBase && scene.floor) btr::arrangeStance(scene, "controller openr");
  }

  std::unique_ptr<btr::Motion> begin(const btr::Scene& scene, const btr::Values& settings,
                                     std::span<const double> parameters) const override {
    if (stick_.empty()) throw btr::InputError("controller openr", "no stick", "one: the folder with OPEN-R/MW in it");
    const auto value = btr::resolve(this->settings(), settings, "openr");
    return std::make_unique<btr::openr::TrialMotion>(
        scene,
        btr::openr::TrialMotion::Task{stick_, btr::openr::parametersText(genotype_, parameters), value[0],
                                      value[1] == 0, shelf_},
        btr::openr::startRobot);
  }

 private:
  std::string stick_;
  std::vector<btr::Parameter> genotype_;
  std::shared_ptr<const btr::openr::StickShelf> shelf_;  ///< of the process that prepares, above its workers
};

}  // namespace

BTR_CONTROLLER(OpenrController, "openr")
