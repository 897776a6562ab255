#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/live/act.h"
#include "core/live/camera_eye.h"
#include "core/live/game.h"
#include "core/live/session_checkpoint.h"
#include "core/live/watchdog.h"
#include "core/plugin/plugin_host.h"
#include "core/sim/scene.h"
#include "core/sim/world.h"
#include "core/spec/sha256.h"

namespace btr {

/// A game that runs: its world goes on by one control period at a time, and acts reach into it between two of them.
/// The same game and the same acts at the same periods give the same bits. Belongs to one thread, and there is one
/// World in a process. The plugin host must outlive it.
class Session {
 public:
  /// Throws InputError for a game whose files, plugins or numbers are not there or not allowed.
  /// `dog`, which outlives it, sees whether controllers answer. `cameras` are for controllers that look.
  Session(Game game, const PluginHost& host, Watchdog* dog = nullptr, CameraMaker cameras = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// One control period on. Nothing happens once there is a fault.
  void step();
  /// Takes effect now, before the next period. Throws InputError, and changes nothing, for what is not allowed.
  void apply(const Act& act);
  /// Called after each act that was applied, with the period before which it was.
  void onAct(std::function<void(long period, const Act&)> logged) { logged_ = std::move(logged); }

  /// The game as it is now, with its state: a checkpoint is made (and logged), so that a session of what is returned
  /// goes on with the same bits as this one.
  Game save();
  /// The same without a checkpoint: this session's own bits stay as they are, what is saved goes on from what the
  /// world remembers now.
  Game saved() const;

  /// All that decides how it goes on, to come back to with returnTo(): with the same bits, as far as motions remember
  /// nothing that Motion::memory() does not tell. Nothing where it stopped, or where a controller looks through a
  /// camera.
  std::optional<SessionCheckpoint> checkpoint() const;
  /// A checkpoint of this session.
  void returnTo(const SessionCheckpoint& then);

  const Game& game() const { return game_; }
  const Scene& scene() const { return scene_; }
  const World& world() const { return *world_; }
  /// The trace's columns and a row of them: the world's, then what robots sense.
  std::vector<std::string> channels() const;
  void sample(std::vector<double>& row) const;
  /// What the referee knows; null where there is none.
  const RefereeState* referee() const { return game_.referee ? &referee_ : nullptr; }
  /// What each joint is told now, by robot and joint of the model.
  const std::vector<std::vector<JointInput>>& inputs() const { return inputs_; }
  const std::map<std::string, PullAct>& pulls() const { return pulls_; }  ///< by object
  const std::map<std::string, std::map<std::string, double>>& held() const { return held_; }
  /// What their programs have ordered, by robot: of those that no controller plugin moves.
  const std::map<std::string, Orders>& orders() const { return orders_; }
  /// By robot the lamps that its controller plugin has lit, by name, brightness 0 … 1.
  const std::map<std::string, Values>& lamps() const { return lamps_; }
  long periods() const { return periods_; }
  double time_s() const { return static_cast<double>(periods_) * game_.scene.controlPeriod_s; }
  /// Why it no longer goes on; "" while it does. The world is as it was at most a tenth of a second before.
  const std::string& fault() const { return fault_; }
  /// SHA-256 over the traces' rows since the session began (or was loaded); call it once, at the end.
  std::string traceSha256() { return hash_.finish(); }
  /// The same at any time.
  std::string traceSha256SoFar() const { return Sha256(hash_).finish(); }
  /// SHA-256 over the rows since the mark before, with that mark, so that two sessions can be compared as they go:
  /// the same up to here if they are the same at marks of the same periods.
  std::string mark();
  /// From now on the contacts of each step are kept, or no longer; no bit of the motion changes.
  void measureContacts(bool on);
  bool measuresContacts() const { return contacts_; }
  /// Cameras and windows of whoever shows it, for the game that is saved; nothing else changes.
  void setView(std::string view) { game_.view = std::move(view); }
  /// The force of the hand at an object [N], world axes; zero if none is there.
  Eigen::Vector3d handForce_n(const std::string& object) const;

 private:
  struct Player {
    std::shared_ptr<const Controller> controller;
    std::unique_ptr<Motion> motion;
    double clock = 0;  ///< time since the motion began [s]
    bool isOver(double period_s) const { return clock >= motion->duration() - period_s / 2; }
    /// In this period: its motion goes on, or is just beginning, or begins again.
    bool isAsked(double period_s, bool repeats) const { return !isOver(period_s) || repeats || clock < period_s / 2; }
  };

  void change(const PlaceAct& act);
  void change(const ThrowAct& act);
  void change(const AddAct& act);
  void change(const RemoveAct& act);
  void change(const PullAct& act);
  void change(const LetGoAct& act);
  void change(const HoldAct& act);
  void change(const ParameterAct& act);
  void change(const ControllerAct& act);
  void change(const OrdersAct& act);
  void change(const NumberAct& act);
  void change(const EffectAct& act);
  void change(const SimulatorAct& act);
  void change(const KickOffAct& act);
  void change(const ScoreAct& act);
  void change(const CheckpointAct& act);

  /// Builds the world of `game` with what is remembered, and only then takes it over.
  void rebuild(Game game, const WorldMemory& memory);
  /// What the motion that moves the robot until now remembers, it knows if the controller is the same.
  Player playerOf(const Game& game, const Scene& scene, const std::string& robot, double clock) const;
  /// The cameras of those controllers that are asked in this period and look begin to draw, all at the same time.
  void askEyes();
  void askController(std::size_t robot, Player& player);
  using Commands = std::map<std::string, std::map<std::string, double>>;  ///< by robot and joint
  Commands commands() const;
  void holdCommands(const WorldMemory& memory, const Commands& commands);
  void setPulls();
  // session_orders.cpp
  std::map<std::string, Orders> ordersOf(const Game& game, const std::map<std::string, Orders>& before) const;
  void obey(std::size_t robot);
  void checkLamps(const OrdersAct& act) const;
  /// A world of this scene with what is remembered of another one.
  std::unique_ptr<World> worldOf(const Game& game, const Scene& scene, const WorldMemory* memory) const;
  // session_referee.cpp
  void officiate();
  void kickOff(const std::string& team);
  std::optional<std::size_t> refereeBall() const;
  // session_senses.cpp
  struct Sensing {
    std::size_t robot;
    Senses senses;
  };
  std::vector<SenseSpec> sensesOf(const Game& game, const std::string& robot) const;
  std::vector<Sensing> sensingOf(const Game& game, const Scene& scene) const;
  /// The session's senses become these; what both have is remembered.
  void takeSenses(std::vector<Sensing> sensing);
  void sense(bool onlyNew);
  void hash(std::string_view bytes);
  void hashChannels();
  Game savedWith(WorldMemory world) const;
  SimulatorSpec& simulatorOf(Game& game, const std::string& robot) const;
  std::size_t robotOf(const std::string& name) const;
  std::size_t jointOf(std::size_t robot, const std::string& joint) const;

  const PluginHost& host_;
  const CameraMaker makeCamera_;
  Game game_;
  ModelSet models_;
  Scene scene_;
  mutable std::shared_ptr<const Scene> keptScene_;  ///< the same for checkpoints, once there was one
  std::unique_ptr<World> world_;
  std::map<std::string, Player> players_;
  std::map<std::string, PullAct> pulls_;  ///< by object
  std::map<std::string, std::map<std::string, double>> held_;
  std::map<std::string, Orders> orders_;  ///< by robot: of a stick always, else once its program has ordered something
  std::map<std::string, Values> lamps_;
  std::map<std::string, std::unique_ptr<CameraEye>> eyes_;  ///< of robots whose controllers look
  RobotReadings readings_;
  std::vector<std::vector<JointInput>> inputs_;
  std::vector<double> row_;
  std::vector<Sensing> sensing_;
  FieldSpec field_;  ///< where there is a referee
  RefereeState referee_;
  Watchdog* dog_;
  bool contacts_ = false;
  WorldMemory lastGood_;
  long periods_ = 0;
  std::string fault_;
  Sha256 hash_, sinceMark_;
  std::function<void(long, const Act&)> logged_;
};

/// The field that the game's referee sees. Throws InputError where nobody says how large it is.
FieldSpec fieldOf(const Game& game);

/// The scene of a game: each robot with its simulator, in its starting posture.
Scene sceneOf(const Game& game, const ModelSet& models, const PluginHost& host);

}  // namespace btr
