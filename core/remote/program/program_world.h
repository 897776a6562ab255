#pragma once
#include <functional>
#include <optional>
#include <string>

#include "core/remote/program/robot_player.h"
#include "core/remote/program/server_link.h"

namespace btr::remote {

/// Which world a program plays in, and for how long.
struct ProgramPlan {
  std::string game;   ///< below the server's folder: a world of its own, opened and closed by the program
  std::string world;  ///< or the name of one that runs
  std::string robot;
  std::optional<std::uint64_t> seed;  ///< of a world of its own; none: the game's
  bool logged = true;                 ///< of a world of its own
  double seconds = 20;                ///< simulated; 0: until the behaviour is over or somebody stops it
  std::function<bool()> stopped;
};

/// How it went.
struct ProgramOutcome {
  long periods = 0;  ///< control periods in which the robot was moved
  long late = 0;     ///< of a world that goes on by itself: periods that were over before their orders came
  double period_s = 0;
  std::string traceSha256;  ///< of a world of its own
  std::string log;          ///< of a world of its own, on the server; "" none
  std::string fault;        ///< why the world stopped
};

/// Plays a behaviour on a robot of a server's world. A world that waits for steps is stepped, and waits for the
/// behaviour; one that plays by its clock is followed. Throws InputError.
ProgramOutcome playOnServer(ServerLink& server, const ::uchilsim::BehaviourController& controller,
                            const PlayedMotion& played, const ProgramPlan& plan);

}  // namespace btr::remote
