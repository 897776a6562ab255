#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/live/game.h"
#include "core/spec/scene_spec.h"

namespace btr {

/// Where an object is put, at rest. Of a robot: its root link's frame, and those of its joints that are named [rad, m].
struct PlaceAct {
  std::string object;
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation_wxyz{1, 0, 0, 0};
  Values joints{};
  /// What its joints are told from now on; those of a robot without controller that are not named here are told to stay
  /// where `joints` puts them.
  Values commands{};
};

/// The velocity of an object from now on; of a robot: of its root frame's origin, joints at rest.
struct ThrowAct {
  std::string object;
  std::array<double, 3> velocity_m_s{}, spin_rad_s{};
};

/// A new object. Its name must be free.
struct AddAct {
  std::variant<RobotSpec, BallSpec, ObstacleSpec> what;
  GameRobot player{};                  ///< of a robot: team, controller, simulator
  std::optional<std::size_t> index{};  ///< its place in the scene's list of its kind; else the last
};

struct RemoveAct {
  std::string object;
};

struct LetGoAct {
  std::string object;
};

/// A joint's command from now on, whatever its controller says; without a position the controller has it again.
struct HoldAct {
  std::string robot, joint;
  std::optional<double> position{};  ///< rad or m
  std::optional<double>
      command{};  ///< of a robot without controller: what it is told when it is not held; else to stay
};

/// One of a controller's parameters, without a value its default; the motion goes on from the same time.
struct ParameterAct {
  std::string robot, name;
  std::optional<double> value{};
};

/// Another controller, which begins now; none: the robot holds where it is.
struct ControllerAct {
  std::string robot;
  std::optional<GameController> controller{};
  Values commands{};  ///< without controller: what joints are told then; those that are not named hold where they are
};

/// What a robot's OPEN-R program orders for the period that begins now and those after it: the robot's controller is a
/// stick (GameStick). One a period, if anything changes.
struct OrdersAct {
  std::string robot;
  Values targets{};  ///< by joint: where it shall be [rad or m]
  Orders orders{};
};

/// A number of the simulator (see SimulatorSpec::values); of one robot's own simulator, or of all that have none.
/// Without a value it is again what scene and models say.
struct NumberAct {
  std::string robot;  ///< "": of all
  std::string name;
  std::optional<double> value;
};

/// An effect of the simulator: added, or with other numbers; without numbers taken away.
struct EffectAct {
  std::string robot;  ///< as in NumberAct
  PlacedEffect effect;
  bool there = true;
};

/// A simulator of one robot's own, without one that of all; with "" that of all.
struct SimulatorAct {
  std::string robot;
  std::optional<SimulatorSpec> simulator{};
};

/// Everybody to his place, the ball to the middle: a game with a referee only.
struct KickOffAct {
  std::string team;  ///< who kicks off, "red" or "blue"; "": who began this half
};

/// The referee's score, set by hand.
struct ScoreAct {
  int red = 0, blue = 0;
};

/// The world is written down and begun anew from what was written: what is saved here goes on with the same bits.
struct CheckpointAct {};

/// Whatever reaches into a running world from outside: a hand, a slider, another program.
using Act = std::variant<PlaceAct, ThrowAct, AddAct, RemoveAct, PullAct, LetGoAct, HoldAct, ParameterAct, ControllerAct,
                         OrdersAct, NumberAct, EffectAct, SimulatorAct, KickOffAct, ScoreAct, CheckpointAct>;

/// {"act": "place", "object": "ball", "position_m": [0, 0, 0.5]} …; see manual/formats/game.md. `place` begins
/// messages.
Act actFromJson(const std::string& text, const std::string& place);
nlohmann::json toJson(const Act& act);

}  // namespace btr
