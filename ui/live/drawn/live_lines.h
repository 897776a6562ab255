#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/live/game.h"
#include "core/sim/scene.h"
#include "ui/live/drawn/live_scene.h"

namespace btr::ui {

/// What btr live --steered tells, line by line; see manual/formats/game.md. Both throw InputError or a nlohmann error
/// for what is no such line.
struct ToldGame {
  Game game;
  std::vector<std::string> channels;
};
ToldGame toldGameFrom(const nlohmann::json& line);
LiveRow liveRowFrom(const nlohmann::json& line);

}  // namespace btr::ui
