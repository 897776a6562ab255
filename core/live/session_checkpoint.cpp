// Coming back to a moment of a session.
#include "core/live/session_checkpoint.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/live/session.h"

namespace btr {

std::optional<SessionCheckpoint> Session::checkpoint() const {
  const auto looks = [](const auto& player) { return player.second.controller->looks(); };
  if (!fault_.empty() || std::ranges::any_of(players_, looks)) return std::nullopt;
  SessionCheckpoint now;
  now.game = game_;
  now.models = models_;
  if (!keptScene_) keptScene_ = std::make_shared<const Scene>(scene_);
  now.scene = keptScene_;
  now.world = world_->memory(World::Detail::everything);
  now.lastGood = lastGood_;
  for (const auto& [name, player] : players_) {
    now.clocks[name] = player.clock;
    now.memories[name] = player.motion->memory();
  }
  now.inputs = inputs_;
  now.pulls = pulls_;
  now.held = held_;
  now.orders = orders_;
  now.lamps = lamps_;
  for (const Sensing& sensing : sensing_) now.senses[scene_.robots[sensing.robot].name] = sensing.senses.memory();
  now.referee = referee_;
  now.periods = periods_;
  now.hash = hash_;
  now.sinceMark = sinceMark_;
  return now;
}

void Session::returnTo(const SessionCheckpoint& then) {
  // One world a process: the old one goes first.
  world_.reset();
  std::string view = std::move(game_.view);
  game_ = then.game;
  game_.view = std::move(view);
  models_ = then.models;
  scene_ = *then.scene;
  keptScene_ = then.scene;
  world_ = worldOf(game_, scene_, &then.world);
  lastGood_ = then.lastGood;
  players_.clear();
  for (const auto& [name, clock] : then.clocks) {
    Player& player = players_[name] = playerOf(game_, scene_, name, clock);
    if (const std::vector<double>& memory = then.memories.at(name); !memory.empty()) player.motion->remember(memory);
  }
  inputs_ = then.inputs;
  pulls_ = then.pulls;
  held_ = then.held;
  orders_ = then.orders;
  lamps_ = then.lamps;
  eyes_.clear();
  sensing_ = sensingOf(game_, scene_);
  for (Sensing& sensing : sensing_)
    if (const auto& memory = then.senses.at(scene_.robots[sensing.robot].name); !memory.empty())
      sensing.senses.remember(memory, "senses");
  referee_ = then.referee;
  periods_ = then.periods;
  fault_.clear();
  hash_ = then.hash;
  sinceMark_ = then.sinceMark;
  setPulls();
}

}  // namespace btr
