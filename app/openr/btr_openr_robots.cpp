#include "app/openr/btr_openr_robots.h"

#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "app/live/btr_live_lines.h"
#include "core/openr/ended_text.h"
#include "core/openr/robot_starter.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

const char* wordOf(openr::Ended::Why why) {
  switch (why) {
    case openr::Ended::Why::shutdown:
      return "shutdown";
    case openr::Ended::Why::crash:
      return "crash";
    case openr::Ended::Why::endlessLoop:
      return "endless_loop";
    case openr::Ended::Why::refused:
      break;
  }
  return "refused";
}

std::uint16_t lowEndian(const std::uint8_t* bytes) {
  constexpr int byte = 8;
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << byte);
}

}  // namespace

void EyeProcesses::send(Eye& eye, const std::string& robot) {
  if (!eye.process)
    eye.process = std::make_unique<CameraProcess>(std::vector<std::string>{"eye", "--robot", robot}, true);
  if (std::vector<std::string> channels = session_.channels(); channels != eye.channels) {
    eye.channels = std::move(channels);
    if (!eye.process->send(gameLine(session_).dump())) throw InputError("camera", "its process ended", "images");
  }
  if (!eye.process->send(rowLine(session_, true, 0).dump())) throw InputError("camera", "its process ended", "images");
  eye.asked = true;
}

std::optional<openr::CameraImage> EyeProcesses::answer(Eye& eye) {
  std::uint8_t head[8];
  eye.asked = false;
  if (!eye.process->read(head, sizeof head)) throw InputError("camera", "its process ended", "images");
  openr::CameraImage image{lowEndian(head), lowEndian(head + 4), {}};
  if (image.width == 0) return std::nullopt;
  image.rows.resize(std::size_t{3} * image.width * image.height);
  if (!eye.process->read(image.rows.data(), image.rows.size()))
    throw InputError("camera", "its process ended", "images");
  return image;
}

template <class Does>
auto EyeProcesses::unlessBlind(const std::string& robot, Does does) -> decltype(does(std::declval<Eye&>())) {
  const auto [found, fresh] = eyes_.try_emplace(robot);
  if (!fresh && !found->second.process) return {};
  try {
    return does(found->second);
  } catch (const InputError&) {
    // Why stands on standard error.
    found->second.process.reset();
    blind_.push_back(robot);
    return {};
  }
}

void EyeProcesses::ask(const std::string& robot) {
  unlessBlind(robot, [&](Eye& eye) {
    send(eye, robot);
    return true;
  });
}

std::optional<openr::CameraImage> EyeProcesses::look(const std::string& robot) {
  return unlessBlind(robot, [&](Eye& eye) {
    if (!eye.asked) send(eye, robot);
    return answer(eye);
  });
}

void EyeProcesses::set(const std::string& robot, const Values& numbers) {
  if (const auto eye = eyes_.find(robot); eye != eyes_.end() && eye->second.process)
    eye->second.process->send(nlohmann::json{{"camera", numbers}}.dump());
}

OpenrRobots::OpenrRobots(Session& session, Watchdog* dog, double patience_s)
    : eyes_(session), programs_(session, openr::robotStarter(patience_s), &eyes_, dog) {}

std::vector<openr::LivePrograms::Line> OpenrRobots::takeLines() {
  auto lines = programs_.takeLines();
  for (const std::string& robot : eyes_.takeBlind())
    lines.push_back({robot, "", "its camera gives no images: nothing can be drawn here (standard error says why)"});
  std::map<std::string, bool> now;
  for (const auto& [robot, ended] : programs_.ended()) {
    now[robot] = ended.has_value();
    if (ended && !ended_[robot]) lines.push_back({robot, "", "the program ended: " + openr::sentenceOf(*ended)});
  }
  ended_ = std::move(now);
  return lines;
}

nlohmann::json OpenrRobots::states() const {
  nlohmann::json all = nlohmann::json::object();
  for (const auto& [robot, ended] : programs_.ended()) {
    all[robot] = {{"running", !ended}};
    if (ended) all[robot].update({{"why", wordOf(ended->why)}, {"what", openr::sentenceOf(*ended)}});
  }
  return all;
}

std::vector<std::string> OpenrRobots::failures() const {
  std::vector<std::string> all;
  for (const auto& [robot, ended] : programs_.ended())
    if (ended && ended->why != openr::Ended::Why::shutdown)
      all.push_back(robot + "'s program ended: " + openr::sentenceOf(*ended));
  return all;
}

std::string printableLine(const std::string& line) {
  std::string shown;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = line.find('\t', begin);
    shown += printable(line.substr(begin, end - begin)) + (end == std::string::npos ? "" : "\t");
  }
  return shown;
}

std::string textOf(const openr::LivePrograms::Line& line) {
  const std::string who = line.object.empty() ? line.robot : line.robot + " " + line.object;
  return printable(who + ": ") + printableLine(line.text);
}

}  // namespace btr::cli
