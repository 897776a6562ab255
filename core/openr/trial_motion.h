#pragma once
#include <functional>
#include <memory>
#include <string>

#include "core/openr/live_programs.h"
#include "core/openr/stick_parameters.h"
#include "core/sim/controller.h"

namespace btr::openr {

/// An OPEN-R program moves the first robot of a trial's scene. Starts with the first command(). Its sensors are exact:
/// joints, acceleration and paws; what a trial does not have, distances among it, has its neutral value, and there are
/// no images. A program that ends otherwise than by its own shutdown makes the trial a failure.
class TrialMotion final : public Motion {
 public:
  struct Task {
    std::string stick;           ///< folder that is copied
    std::string parametersText;  ///< of its PARAMS.TXT
    double duration_s = 10;
    bool motorPower = true;                     ///< on at the start
    std::shared_ptr<const StickShelf> shelf{};  ///< where its copy of the stick is; none: one of its own
  };
  /// Throws InputError for a scene of another control period or a robot that is none of Sony's.
  TrialMotion(const Scene& scene, Task task, LivePrograms::Starter start);

  void command(double time, const RobotReadings& readings, std::span<JointInput> inputs) override;
  double duration() const override { return task_.duration_s; }

 private:
  SensorFrame frameOf(const RobotReadings& readings);
  void obey(const OrderFrame& orders);

  Task task_;
  LivePrograms::Starter start_;
  const RobotModel model_;
  RobotUnits units_;
  std::unique_ptr<PrivateStick> stick_;
  std::unique_ptr<RunningProgram> program_;  ///< before the stick goes
  std::uint32_t frames_ = 0;
  bool over_ = false;  ///< it shut down
  Orders orders_;
  std::vector<JointInput> inputs_;  ///< what joints are told, by joint of the model
};

}  // namespace btr::openr
