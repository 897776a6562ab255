#include "core/openr/trial_motion.h"

#include <algorithm>

#include "core/live/orders.h"
#include "core/openr/ended_text.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

constexpr double frame_s = 0.008;
constexpr std::int64_t frame_us = 8000;

const SceneRobot& firstRobot(const Scene& scene) {
  if (scene.controlPeriod_s != frame_s)
    throw InputError("controller openr", "a control period of " + toText(scene.controlPeriod_s) + " s",
                     "a scene whose control_period_s is 0.008, a frame of OPEN-R");
  return scene.robots.at(0);
}

/// The link beyond the knee, and all that it carries.
bool touches(const RobotModel& model, const RobotReadings& now, const std::string& leg) {
  const int knee = model.findJoint(leg + "_J3");
  if (knee < 0) return false;
  std::vector<std::size_t> links{static_cast<std::size_t>(knee) + 1};
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (std::ranges::find(links, static_cast<std::size_t>(model.joints[j].parentLink)) != links.end())
      links.push_back(j + 1);
  return std::ranges::any_of(links, [&](std::size_t link) { return now.contact[link] != 0; });
}

}  // namespace

TrialMotion::TrialMotion(const Scene& scene, Task task, LivePrograms::Starter start)
    : task_(std::move(task)),
      start_(std::move(start)),
      model_(firstRobot(scene).model),
      units_(designOf(model_, "", "controller openr"), scene.robots.at(0)) {
  orders_.motorPower = task_.motorPower;
}

SensorFrame TrialMotion::frameOf(const RobotReadings& readings) {
  SensorFrame frame;
  frame.number = ++frames_;
  frame.time_us = frame_us * (frames_ - 1);
  frame.joints = units_.joints(readings, inputs_);
  const Eigen::Vector3d& force = readings.accelerometer_m_s2;
  std::map<std::string, double> si;
  if (!force.isZero(0))
    si = {{"acceleration_front", -force.x()}, {"acceleration_right", force.y()}, {"acceleration_up", -force.z()}};
  for (const char* leg : {"LF", "LR", "RF", "RR"}) si[std::string("paw_") + leg] = touches(model_, readings, leg);
  frame.sensors = units_.sensors(si);
  return frame;
}

void TrialMotion::obey(const OrderFrame& orders) {
  RobotUnits::Ordered ordered = units_.ordered(orders);
  // The process begins with everything off.
  if (frames_ == 1 && task_.motorPower && !ordered.orders.motorPower.value_or(true)) ordered.orders.motorPower.reset();
  for (const auto& [joint, target] : ordered.targets)
    inputs_[static_cast<std::size_t>(model_.findJoint(joint))].command = target;
  orders_.add(ordered.orders);
  if (!orders.ended) return;
  if (orders.ended->why != Ended::Why::shutdown) throw InputError(sentenceOf(*orders.ended));
  over_ = true;
  orders_.motorPower = false;
}

void TrialMotion::command(double, const RobotReadings& readings, std::span<JointInput> inputs) {
  if (!program_) {
    inputs_.assign(inputs.begin(), inputs.end());
    if (!task_.shelf) task_.shelf = std::make_shared<StickShelf>();
    stick_ = std::make_unique<PrivateStick>(*task_.shelf, task_.stick, task_.parametersText);
    program_ = start_(stick_->folder(), units_.design());
  }
  if (!over_) obey(program_->exchange(frameOf(readings)));
  applyOrders(orders_, model_, inputs_);
  std::ranges::copy(inputs_, inputs.begin());
}

}  // namespace btr::openr
