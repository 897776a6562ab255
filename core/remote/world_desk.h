#pragma once
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/camera_eye.h"
#include "core/live/session.h"
#include "core/live/session_log.h"
#include "core/remote/desk.h"
#include "core/remote/games_folder.h"
#include "core/remote/picture_ring.h"
#include "core/remote/stick_programs.h"

namespace uchilsim::v1 {
class OpenRequest;
class PictureMemoryRequest;
class PictureRequest;
class State;
class StepRequest;
class Targets;
class TypeRequest;
class Wanted;
class World;
}  // namespace uchilsim::v1

namespace btr::remote {

/// Joints of the model that move, in the order of a client's targets.
std::vector<std::size_t> movingJoints(const SceneRobot& robot);

/// One running world and everything that clients do to it. One a process. Every change is an act of its session, which
/// is logged where the folder can be written.
class WorldDesk final : public Desk {
 public:
  static constexpr int mostPeriods = 10000;         ///< of one step
  static constexpr std::size_t mostObjects = 1000;  ///< of a game that a client sends
  static constexpr double fastestPlay = 100;

  static constexpr std::size_t mostCameras = 8;

  static constexpr std::size_t mostTypedBytes = 64 << 10;  ///< of one call

  static constexpr std::size_t mostLines = 1000, mostLineBytes = 1 << 20;  ///< of programs, that are kept

  /// The first two must outlive it. Without `programs` a game with an OPEN-R stick is refused.
  WorldDesk(const PluginHost& host, const GamesFolder& folder, CameraMaker cameras = {},
            StickProgramsMaker programs = {})
      : host_(host), folder_(folder), makeCamera_(std::move(cameras)), makePrograms_(std::move(programs)) {}
  ~WorldDesk() override;

  std::string answer(Method method, std::string_view message) override;
  double patience_s() const override;
  void goOn() override;

 private:
  std::string open(const uchilsim::v1::OpenRequest& request);
  Game gameOf(const uchilsim::v1::OpenRequest& request) const;
  void begin();  ///< an episode
  std::unique_ptr<StickPrograms> programsOf(Session& session) const;
  void keepLines();
  void type(const uchilsim::v1::TypeRequest& request);
  void tellPrograms(const uchilsim::v1::Wanted& wanted, uchilsim::v1::State& state) const;
  std::string end();
  Session& session();
  void apply(const Act& act);
  void apply(const uchilsim::v1::Targets& targets, int row, int rows);
  void step(const uchilsim::v1::StepRequest& request);
  bool onePeriod();                     ///< whether a camera has a new picture
  bool look(const std::string& robot);  ///< the same
  std::string robot(const std::string& name);
  std::string picture(const uchilsim::v1::PictureRequest& request);
  std::string pictureMemory(const uchilsim::v1::PictureMemoryRequest& request);
  void describe(uchilsim::v1::World& world);
  std::string state(const uchilsim::v1::Wanted& wanted);
  void fillRow(const uchilsim::v1::Wanted& wanted, uchilsim::v1::State& state);
  void refreshChannels();

  const PluginHost& host_;
  const GamesFolder& folder_;
  std::string name_;          ///< of the world
  std::optional<Game> game_;  ///< as it begins
  bool logged_ = false;
  std::string gameFile_, logFile_;  ///< of this episode, full paths
  std::unique_ptr<Session> session_;
  std::unique_ptr<StickPrograms> programs_;  ///< none: no robot has a stick
  std::unique_ptr<SessionLogWriter> log_;
  struct Said {
    long period;
    StickPrograms::Line line;
  };
  std::deque<Said> said_;  ///< the last ones
  long lastLine_ = 0;      ///< number of the last one
  std::size_t saidBytes_ = 0;
  std::vector<std::string> channels_;
  long channelsVersion_ = 0, channelsTold_ = 0;  ///< which they are; which whoever does not say was told last
  std::vector<std::string> chosen_;              ///< the channels that were wanted last …
  std::vector<std::size_t> chosenAt_;            ///< … and where they are
  std::vector<double> row_;
  struct Camera {
    std::unique_ptr<CameraEye> eye;  ///< none: it begins to look with the next call
    CameraPicture picture{};         ///< the last one, of this episode
    long number = 0, period = 0;
    std::string why{};                    ///< it looks no longer
    std::unique_ptr<PictureRing> ring{};  ///< of this episode, from when it is asked for
  };
  /// The camera of a robot, which looks. Throws InputError, Refusal.
  Camera& camera(const std::string& robot);
  const CameraMaker makeCamera_;
  const StickProgramsMaker makePrograms_;
  std::map<std::string, Camera> cameras_;  ///< by robot
  long episode_ = 0;
  double speed_ = 0;  ///< 0: it waits for steps
  double anchor_s_ = 0;
  long anchorPeriods_ = 0;
};

}  // namespace btr::remote
