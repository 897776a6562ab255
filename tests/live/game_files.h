#pragma once
// Small games that tests make.
#include <filesystem>
#include <fstream>
#include <string>

#include "core/live/session.h"
#include "tests/plugin/built_plugins.h"

namespace btr::test {

/// Two dogs, of which one walks, a ball and a crate, on a floor.
inline std::string dogsText() {
  return R"({"format": "uchilsim-game-1", "seed": 3,
  "scene": {"format": "uchilsim-scene-1", "step_s": 0.008, "control_period_s": 0.008, "floor": {"friction": 1},
    "robots_collide": true,
    "robots": [{"name": "red1", "model": ")" SOURCE_DIR R"(/resources/robots/ers7.wrl", "position_m": [-0.5, 0, 0]},
               {"name": "blue1", "model": ")" SOURCE_DIR R"(/resources/robots/ers7.wrl", "position_m": [0.6, 0.1, 0],
                "orientation_wxyz": [0, 0, 0, 1]}],
    "balls": [{"name": "ball", "rolling_deceleration_m_s2": 0.4, "position_m": [0, 0.3, 0.0425]}],
    "obstacles": [{"name": "crate", "mass_kg": 0.2, "size_m": [0.1, 0.1, 0.1], "position_m": [0, -0.4, 0.05]}]},
  "robots": {"red1": {"team": "red", "controller": {"plugin": "walk"}}, "blue1": {"team": "blue"}}})";
}

inline Game dogs() { return gameFromJson(dogsText(), "dogs.json", "."); }

inline void run(Session& session, long periods) {
  for (long i = 0; i < periods; ++i) session.step();
}

}  // namespace btr::test
