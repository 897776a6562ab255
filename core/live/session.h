#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/live/act.h"
#include "core/live/game.h"
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
  Session(Game game, const PluginHost& host);
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

  const Game& game() const { return game_; }
  const Scene& scene() const { return scene_; }
  const World& world() const { return *world_; }
  long periods() const { return periods_; }
  double time_s() const { return static_cast<double>(periods_) * game_.scene.controlPeriod_s; }
  /// Why it no longer goes on; "" while it does. The world is as it was at most a tenth of a second before.
  const std::string& fault() const { return fault_; }
  /// SHA-256 over the traces' rows since the session began (or was loaded); call it once, at the end.
  std::string traceSha256() { return hash_.finish(); }
  /// The force of the hand at an object [N], world axes; zero if none is there.
  Eigen::Vector3d handForce_n(const std::string& object) const;

 private:
  struct Player {
    std::shared_ptr<const Controller> controller;
    std::unique_ptr<Motion> motion;
    double clock = 0;  ///< time since the motion began [s]
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
  void change(const NumberAct& act);
  void change(const EffectAct& act);
  void change(const CheckpointAct& act);

  /// Builds the world of `game` with what is remembered, and only then takes it over.
  void rebuild(Game game, const WorldMemory& memory);
  Player playerOf(const Game& game, const Scene& scene, const std::string& robot, double clock) const;
  void holdCommands(const WorldMemory& memory);
  void setPulls();
  void hashChannels();
  SimulatorSpec& simulatorOf(Game& game, const std::string& robot) const;
  std::size_t robotOf(const std::string& name) const;
  std::size_t jointOf(std::size_t robot, const std::string& joint) const;

  const PluginHost& host_;
  Game game_;
  ModelSet models_;
  Scene scene_;
  std::unique_ptr<World> world_;
  std::map<std::string, Player> players_;
  std::map<std::string, PullAct> pulls_;  ///< by object
  std::map<std::string, std::map<std::string, double>> held_;
  std::vector<std::vector<JointInput>> inputs_;
  std::vector<double> row_;
  WorldMemory lastGood_;
  long periods_ = 0;
  std::string fault_;
  Sha256 hash_;
  std::function<void(long, const Act&)> logged_;
};

/// The scene of a game: each robot with its simulator, in its starting posture.
Scene sceneOf(const Game& game, const ModelSet& models, const PluginHost& host);

}  // namespace btr
