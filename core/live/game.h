#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/live/referee.h"
#include "core/sim/senses.h"
#include "core/sim/world/world_memory.h"
#include "core/spec/parameter.h"
#include "core/spec/pitch_spec.h"
#include "core/spec/scene_spec.h"
#include "core/spec/simulator_spec.h"

namespace btr {

class JsonReader;

/// OPEN-R objects that move a robot: what stands on its memory stick.
struct GameStick {
  std::string folder;       ///< relative to the scene's directory
  std::string design{};     ///< "ERS-7", "ERS-210", "ERS-220"; "" as the robot's model says
  bool motorPower = false;  ///< its motors are on when the program starts
  bool camera = false;      ///< its camera looks: drawing takes time
  bool operator==(const GameStick&) const = default;
};

/// Who moves a robot: a controller plugin with its settings and parameters (what is left out has its default), or an
/// OPEN-R program, which is not part of the game: what it does comes as OrdersAct.
struct GameController {
  std::string plugin;  ///< "" of an OPEN-R program
  Values settings, parameters;
  bool repeats = true;  ///< the motion begins again when it is over; else its last commands are held
  std::optional<GameStick> openr{};
  bool operator==(const GameController&) const = default;
};

struct GameRobot {
  std::string team;                          ///< "red", "blue" or ""
  std::optional<GameController> controller;  ///< none: it holds its starting positions
  std::optional<SimulatorSpec> simulator;    ///< its own; else that of the game
  /// It begins in its controller's starting posture (without controller, a four-legged robot: in a stance), at its
  /// place in the scene; else exactly as the scene says.
  bool posture = true;
  Values stance{};  ///< joints of the posture of a robot without controller: on its feet, other joints at rest
  std::vector<SenseSpec> senses{};
  bool operator==(const GameRobot&) const = default;
  bool hasPlugin() const { return controller && !controller->openr; }
  bool hasStick() const { return controller && controller->openr; }
};

struct Lamp {
  double brightness = 0;  ///< 0 … 1
  std::string mode{};     ///< "A" or "B" of lamps that have them, else ""
  bool operator==(const Lamp&) const = default;
};

/// What a robot's program has ordered beside the places of joints; what is not named is as it was.
struct Orders {
  std::map<std::string, std::array<double, 3>> gains{};  ///< by joint: p, i, d times those of the scene
  std::map<std::string, bool> enabled{};                 ///< by joint: false is limp, as at the start
  std::optional<bool> motorPower{};                      ///< off: all joints are limp
  std::map<std::string, Lamp> lamps{};                   ///< at the start all are dark
  bool operator==(const Orders&) const = default;
  /// Takes over what the later one names.
  void add(const Orders& later);
  bool empty() const { return *this == Orders{}; }
};

/// A hand's spring from a point of an object to a place, see Pull; one an object. A further act moves it on.
struct PullAct {
  std::string object, link;          ///< link: of a robot, "" its root
  std::array<double, 3> point_m{};   ///< in the frame of the link, ball or obstacle
  std::array<double, 3> target_m{};  ///< in the world
  double stiffness_n_m = 100, most_n = 20;
};

/// What a running game remembers beside its world.
struct GameState {
  WorldMemory world;
  long periods = 0;                                               ///< control periods since the game began
  std::map<std::string, double> clocks;                           ///< by robot: time since its motion began [s]
  std::map<std::string, std::map<std::string, double>> held;      ///< by robot and joint
  std::map<std::string, std::map<std::string, double>> commands;  ///< what joints are told, by robot and joint
  std::vector<PullAct> pulls;
  std::map<std::string, std::vector<std::vector<double>>> senses;  ///< by robot, see Senses::memory()
  std::optional<RefereeState> referee;
  std::map<std::string, Orders> orders{};                 ///< by robot
  std::map<std::string, std::vector<double>> memories{};  ///< by robot: of its motion, see Motion::memory()
};

/// A scene with who plays in it ("format": "uchilsim-game-1"). A value.
struct Game {
  SceneSpec scene;
  PitchSpec pitch;  ///< of the scene's file
  std::uint64_t seed = 1;
  SimulatorSpec simulator;                  ///< of everything that has none of its own
  std::map<std::string, GameRobot> robots;  ///< by the scene's names; those that are not here hold still
  std::optional<RefereeSpec> referee;
  std::optional<GameState> state;  ///< of a game that was saved while it ran
  std::string view;                ///< cameras, windows: JSON that the window writes and nobody else reads
};

/// `place` begins error messages, relative paths start at `directory`. Throws InputError.
Game gameFromJson(const std::string& text, const std::string& place, const std::string& directory);
std::string toJsonText(const Game& game);

/// The same game for a file in another folder: paths of models and sticks that are relative stay relative, from there.
Game movedTo(Game game, const std::string& directory);

/// Opens a game, a scene, or a robot file (*.wrl, *.urdf), which then stands alone on a floor.
Game loadGame(const std::string& path);

GameRobot gameRobotFromReader(JsonReader& reader);
nlohmann::json toJson(const GameRobot& robot);
PullAct pullFromReader(JsonReader& reader);  ///< the caller calls finish()
nlohmann::json toJson(const PullAct& pull);
/// Leaves finish() to the caller.
Orders ordersFromReader(JsonReader& reader);
nlohmann::json toJson(const Orders& orders);
GameController gameControllerFromReader(JsonReader& reader);
nlohmann::json toJson(const GameController& controller);

}  // namespace btr
