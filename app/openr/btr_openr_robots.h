#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/live/btr_camera_process.h"
#include "core/live/session.h"
#include "core/openr/live_programs.h"
#include "core/openr/robot_process.h"

namespace btr::cli {

/// The cameras of robots with a stick, each in a process of its own that draws. One that ended gives no more images.
class EyeProcesses final : public openr::RobotCameras {
 public:
  explicit EyeProcesses(const Session& session) : session_(session) {}
  void ask(const std::string& robot) override;
  std::optional<openr::CameraImage> look(const std::string& robot) override;
  void set(const std::string& robot, const Values& numbers) override;
  /// Robots whose camera gave up since the last call.
  std::vector<std::string> takeBlind() { return std::exchange(blind_, {}); }

 private:
  struct Eye {
    std::unique_ptr<CameraProcess> process;  ///< none: it gave up
    std::vector<std::string> channels;
    bool asked = false;  ///< its answer has not been read
  };
  void send(Eye& eye, const std::string& robot);
  static std::optional<openr::CameraImage> answer(Eye& eye);
  /// What `does` gives; a camera that has ended is blind from now on.
  template <class Does>
  auto unlessBlind(const std::string& robot, Does does) -> decltype(does(std::declval<Eye&>()));

  const Session& session_;
  std::map<std::string, Eye> eyes_;
  std::vector<std::string> blind_;
};

/// The OPEN-R programs of a running world's robots, each in a process of its own, with their cameras.
class OpenrRobots {
 public:
  /// `dog`, which outlives it, sees whether programs answer; one that has not after `patience_s` is ended.
  explicit OpenrRobots(Session& session, Watchdog* dog = nullptr, double patience_s = openr::RobotProcess::patience_s);

  /// Before each period.
  void step() { programs_.step(); }
  void acted(const Act& act) { programs_.acted(act); }
  void type(const std::string& robot, const std::string& text) { programs_.type(robot, text); }
  void end() { programs_.end(); }
  /// What was said since the last call. Of starts and ends of programs, and of cameras: without an object.
  std::vector<openr::LivePrograms::Line> takeLines();
  /// {"red1": {"running": true}, "blue1": {"running": false, "why": "crash", "what": "…"}}
  nlohmann::json states() const;
  /// One sentence for each program that ended otherwise than by its own shutdown.
  std::vector<std::string> failures() const;
  long changes() const { return programs_.changes(); }
  /// See LivePrograms.
  const std::map<std::string, std::optional<openr::Ended>>& ended() const { return programs_.ended(); }

 private:
  EyeProcesses eyes_;
  openr::LivePrograms programs_;
  std::map<std::string, bool> ended_;  ///< as was said
};

/// "red1 MovingHead7: what it said", without characters that steer a terminal.
std::string textOf(const openr::LivePrograms::Line& line);
/// What a program said: printable(), but with its tabulators.
std::string printableLine(const std::string& line);

}  // namespace btr::cli
