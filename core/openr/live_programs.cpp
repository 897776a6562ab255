#include "core/openr/live_programs.h"

#include <cmath>
#include <filesystem>

#include "core/spec/error.h"

namespace btr::openr {
namespace {

constexpr std::uint32_t lastFrame = 0x0ffffff0;
constexpr std::int64_t frame_us = 8000;

/// A column of a session's senses and what it is to a program, by its sign and its names in the designs.
struct SenseColumn {
  const char* column;
  double sign;
  std::vector<std::string> sensors;
};

// An acceleration sensor shows the opposite of the specific force; our y is to the left.
const std::vector<SenseColumn>& senseColumns() {
  static const std::vector<SenseColumn> all{
      {"accelerometer.x_m_s2", -1, {"acceleration_front"}},
      {"accelerometer.y_m_s2", 1, {"acceleration_right"}},
      {"accelerometer.z_m_s2", -1, {"acceleration_up"}},
      {"infrared.near_m", 1, {"distance_near"}},
      {"infrared.far_m", 1, {"distance_far"}},
      {"infrared.chest_m", 1, {"distance_chest"}},
      {"infrared.head_m", 1, {"distance"}},
      {"paw.lf", 1, {"paw_LF"}},
      {"paw.rf", 1, {"paw_RF"}},
      {"paw.lr", 1, {"paw_LR"}},
      {"paw.rr", 1, {"paw_RR"}},
      {"touch.head", 1, {"touch_head", "touch_head_back", "touch_head_front"}},
      {"touch.chin", 1, {"touch_chin", "touch_face"}},
      {"touch.back", 1, {"touch_back", "touch_back_rear", "touch_back_middle", "touch_back_front"}}};
  return all;
}

std::string folderOf(const Game& game, const GameStick& stick) {
  namespace fs = std::filesystem;
  const fs::path path = fs::absolute(fs::path(game.scene.directory) / stick.folder).lexically_normal();
  if (!fs::is_directory(path))
    throw InputError(path.string(), "no folder", "an OPEN-R memory stick: a folder with OPEN-R/MW in it");
  return path.string();
}

/// Those of its maker; none of a model that cannot have them.
std::optional<Senses> sensesOf(const RobotDesign& design, const SceneRobot& robot, std::uint64_t seed) {
  const std::string place = "robots " + robot.name + "/controller/openr";
  try {
    return Senses(sensesOfModel(design.name == "ERS-7" ? "ers7" : "ers210", place), robot, seed, place);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool changesColumns(const Act& act) {
  return !std::holds_alternative<OrdersAct>(act) && !std::holds_alternative<PullAct>(act) &&
         !std::holds_alternative<LetGoAct>(act) && !std::holds_alternative<HoldAct>(act);
}

}  // namespace

LivePrograms::LivePrograms(Session& session, Starter start, RobotCameras* cameras, Watchdog* dog)
    : session_(session), start_(std::move(start)), cameras_(cameras), dog_(dog) {
  for (const auto& [name, player] : session_.game().robots)
    if (player.hasStick()) this->start(name);
}

LivePrograms::~LivePrograms() = default;

void LivePrograms::start(const std::string& name) {
  robots_.erase(name);
  ended_[name].reset();
  ++changes_;
  const GameStick& stick = *session_.game().robots.at(name).controller->openr;
  Robot robot;
  try {
    look(name, robot);
    robot.program = start_(folderOf(session_.game(), stick), robot.units->design());
    robots_[name] = std::move(robot);
  } catch (const InputError& error) {
    ended_[name] = Ended{Ended::Why::refused, "", "", error.what()};
  }
}

void LivePrograms::stop(const std::string& name) {
  robots_.erase(name);
  ended_.erase(name);
  ++changes_;
}

/// Where the robot is in the session now.
void LivePrograms::look(const std::string& name, Robot& robot) const {
  const Scene& scene = session_.scene();
  robot.index = 0;
  while (robot.index < scene.robots.size() && scene.robots[robot.index].name != name) ++robot.index;
  const SceneRobot& body = scene.robots.at(robot.index);
  const GameStick& stick = *session_.game().robots.at(name).controller->openr;
  robot.units.emplace(designOf(body.model, stick.design, "robots " + name + "/controller/openr"), body);
  robot.senses.clear();
  std::vector<std::string> channels = session_.channels();
  const bool sees = !session_.game().robots.at(name).senses.empty();
  if (sees) {
    robot.own.reset();
  } else {
    if (!robot.own) robot.own = sensesOf(robot.units->design(), body, session_.game().seed);
    if (robot.own) channels = robot.own->channels();
  }
  const std::string mine = name + ".";
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].starts_with(mine)) robot.senses[channels[i].substr(mine.size())] = i;
}

/// The row of its own senses in place of the session's.
void LivePrograms::sense(Robot& robot, const std::string& name, std::vector<double>& row) const {
  const RobotModel& model = session_.scene().robots[robot.index].model;
  std::vector<Touch> touches;
  if (const auto pull = session_.pulls().find(name); pull != session_.pulls().end()) {
    const auto& p = pull->second.point_m;
    touches.push_back({pull->second.link.empty() ? 0 : model.findLink(pull->second.link), {p[0], p[1], p[2]}});
  }
  robot.own->sense(session_.world(), robot.index, touches, session_.periods(), session_.scene().controlPeriod_s);
  row.clear();
  robot.own->sample(row);
}

bool LivePrograms::looks(const std::string& name) const {
  return cameras_ && session_.game().robots.at(name).controller->openr->camera;
}

SensorFrame LivePrograms::frameOf(const std::string& name, Robot& robot, const std::vector<double>& sessions) const {
  std::vector<double> row = sessions;
  if (robot.own) sense(robot, name, row);
  SensorFrame frame;
  robot.frames = robot.frames == lastFrame ? 1 : robot.frames + 1;
  frame.number = robot.frames;
  frame.time_us = frame_us * (robot.frames - 1);
  RobotReadings now = session_.world().robot(robot.index);
  const auto& joints = session_.scene().robots[robot.index].model.joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (const auto sensed = robot.senses.find(joints[j].name + ".sensed_rad"); sensed != robot.senses.end())
      now.position[j] = row[sensed->second];
  frame.joints = robot.units->joints(now, session_.inputs()[robot.index]);
  std::map<std::string, double> si;
  for (const SenseColumn& each : senseColumns())
    if (const auto column = robot.senses.find(each.column); column != robot.senses.end())
      for (const std::string& sensor : each.sensors) si[sensor] = each.sign * row[column->second];
  frame.sensors = robot.units->sensors(si);
  frame.typed = std::move(robot.typed);
  robot.typed.clear();
  if (looks(name)) frame.image = cameras_->look(name);
  return frame;
}

void LivePrograms::take(const std::string& name, Robot& robot, const OrderFrame& orders) {
  for (const ConsoleLine& line : orders.lines) lines_.push_back({name, line.object, line.text});
  if (const Values numbers = cameraNumbers(robot.units->design(), orders.camera); cameras_ && !numbers.empty())
    cameras_->set(name, numbers);
  RobotUnits::Ordered ordered = robot.units->ordered(orders);
  // The process begins with everything off; a game may have switched the motors on before.
  if (robot.frames == 1 && session_.orders().at(name).motorPower.value_or(false) &&
      !ordered.orders.motorPower.value_or(true))
    ordered.orders.motorPower.reset();
  // Who shuts down lets go of everything; else joints stay where they were told to be.
  if (orders.ended && orders.ended->why == Ended::Why::shutdown) {
    ordered.orders.motorPower = false;
    for (const auto& [lamp, light] : session_.orders().at(name).lamps) ordered.orders.lamps[lamp] = {};
  }
  if (!ordered.empty()) session_.apply(OrdersAct{name, std::move(ordered.targets), std::move(ordered.orders)});
  if (!orders.ended) return;
  ended_[name] = orders.ended;
  ++changes_;
}

void LivePrograms::step() {
  if (robots_.empty() || !session_.fault().empty()) return;
  if (stale_)
    for (auto& [name, robot] : robots_) look(name, robot);
  stale_ = false;
  std::vector<double> row;
  session_.sample(row);
  for (const auto& [name, robot] : robots_)
    if (looks(name)) cameras_->ask(name);
  for (auto& [name, robot] : robots_) {
    const SensorFrame frame = frameOf(name, robot, row);
    std::optional<OrderFrame> orders;
    {
      const Asked asked(dog_, name + "'s OPEN-R program");
      orders = robot.program->exchange(frame);
    }
    take(name, robot, *orders);
  }
  std::erase_if(robots_, [&](const auto& each) { return ended_[each.first].has_value(); });
}

void LivePrograms::acted(const Act& act) {
  stale_ = stale_ || changesColumns(act);
  const auto renew = [&](const std::string& name) {
    const auto player = session_.game().robots.find(name);
    if (player != session_.game().robots.end() && player->second.hasStick())
      start(name);
    else if (ended_.contains(name))
      stop(name);
  };
  if (const auto* controller = std::get_if<ControllerAct>(&act)) renew(controller->robot);
  if (const auto* gone = std::get_if<RemoveAct>(&act)) renew(gone->object);
  if (const auto* add = std::get_if<AddAct>(&act)) renew(std::visit([](const auto& it) { return it.name; }, add->what));
}

void LivePrograms::type(const std::string& robot, const std::string& text) {
  const auto found = robots_.find(robot);
  if (found == robots_.end()) throw InputError("robot", "\"" + robot + "\"", "a robot whose OPEN-R program runs");
  constexpr std::size_t most = 1 << 20;  // as much as the robot keeps for a program that does not read
  std::string& typed = found->second.typed;
  if (typed.size() + text.size() > most)
    throw InputError("text", std::to_string(typed.size() + text.size()) + " bytes between two periods",
                     "at most " + std::to_string(most));
  typed += text;
}

void LivePrograms::end() {
  if (robots_.empty()) return;
  std::vector<double> row;
  if (stale_)
    for (auto& [name, robot] : robots_) look(name, robot);
  session_.sample(row);
  for (auto& [name, robot] : robots_) {
    SensorFrame frame = frameOf(name, robot, row);
    frame.shutdown = true;
    const OrderFrame orders = robot.program->exchange(frame);
    for (const ConsoleLine& line : orders.lines) lines_.push_back({name, line.object, line.text});
    // One that fails while it stops has failed.
    if (orders.ended && orders.ended->why != Ended::Why::shutdown) ended_[name] = orders.ended;
  }
  robots_.clear();
}

std::vector<LivePrograms::Line> LivePrograms::takeLines() { return std::exchange(lines_, {}); }

}  // namespace btr::openr
