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
#include "core/sim/world_memory.h"
#include "core/spec/parameter.h"
#include "core/spec/pitch_spec.h"
#include "core/spec/scene_spec.h"
#include "core/spec/simulator_spec.h"

namespace btr {

class JsonReader;

/// Who moves a robot: a controller plugin with its settings and parameters; what is left out has its default.
struct GameController {
  std::string plugin;
  Values settings, parameters;
  bool repeats = true;  ///< the motion begins again when it is over; else its last commands are held
  bool operator==(const GameController&) const = default;
};

struct GameRobot {
  std::string team;                          ///< "red", "blue" or ""
  std::optional<GameController> controller;  ///< none: it holds its starting positions
  std::optional<SimulatorSpec> simulator;    ///< its own; else that of the game
  /// It begins in its controller's starting posture (without controller, a four-legged robot: in a stance), at its
  /// place in the scene; else exactly as the scene says.
  bool posture = true;
  std::vector<SenseSpec> senses{};
  bool operator==(const GameRobot&) const = default;
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

/// The same game for a file in another folder: paths of models that are relative stay relative, from there.
Game movedTo(Game game, const std::string& directory);

/// Opens a game, a scene, or a robot file (*.wrl, *.urdf), which then stands alone on a floor.
Game loadGame(const std::string& path);

GameRobot gameRobotFromReader(JsonReader& reader);
nlohmann::json toJson(const GameRobot& robot);
PullAct pullFromReader(JsonReader& reader);  ///< the caller calls finish()
nlohmann::json toJson(const PullAct& pull);
GameController gameControllerFromReader(JsonReader& reader);
nlohmann::json toJson(const GameController& controller);

}  // namespace btr
