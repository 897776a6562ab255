#pragma once
#include <QObject>
#include <map>
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "ui/live/drawn/live_scene.h"
#include "ui/live/live_process.h"

namespace btr {
class PluginHost;
}
namespace btr::ui {

/// What the page's panels share: the game that runs as it is known here, its newest row, what is selected, and the one
/// way in which hands reach into it. Borrows host and process, which outlive it.
class LiveWorld : public QObject {
  Q_OBJECT
 public:
  LiveWorld(const PluginHost& host, LiveProcess& process, QObject* parent = nullptr);

  const PluginHost& host() const { return host_; }
  LiveProcess& process() const { return process_; }
  const Game& game() const { return game_; }
  const ModelSet& models() const { return models_; }
  const LiveScene& scene() const { return scene_; }
  const LiveRow& row() const { return row_; }
  const std::vector<std::string>& channels() const { return channels_; }
  /// Whether acts are obeyed and poses are known.
  bool isReady() const { return process_.isReady() && !row_.values.empty(); }
  /// Another game is opened: what is known is of the one before.
  void forget();

  /// Sends it, and changes the game that is known here accordingly. Where hands are off it is only said.
  void act(const Act& act);
  /// Off while a log is played again.
  void setHands(bool on) { hands_ = on; }
  bool handsAreOn() const { return hands_; }

  const std::vector<LiveObject>& objects() const { return scene_.objects(); }
  int indexOf(const std::string& object) const;  ///< −1: there is none
  /// Of an object's own frame, now.
  Eigen::Isometry3d poseOf(const std::string& object) const;
  /// A name that no object has: "ball", "ball2" …
  std::string freeName(const std::string& word) const;
  /// Who plays this robot; a default one for a robot that the game does not mention.
  GameRobot playerOf(const std::string& robot) const;

  /// What is selected, in the order in which it was; names that no object has are left out. The last one is shown.
  void select(std::vector<std::string> objects);
  /// As soon as they are there: they were just added.
  void selectLater(std::vector<std::string> objects);
  const std::vector<std::string>& selection() const { return selection_; }
  std::string selected() const { return selection_.empty() ? "" : selection_.back(); }
  const LiveObject* selectedObject() const;

  /// The joints of a robot that hands hold, and where [rad, m].
  Values held(const std::string& robot) const;
  /// What hands pull, by object.
  const std::map<std::string, PullAct>& pulls() const { return pulls_; }
  /// A hand pulls it by its middle to a place in the world.
  void pullTo(const std::string& object, const Eigen::Vector3d& target_m);

 signals:
  void forgotten();       ///< another game is opened
  void objectsChanged();  ///< a game was opened, or objects came or went
  void gameChanged();     ///< its numbers, by someone else than act()
  void firstRow();        ///< of the objects
  void rowChanged();
  void selectionChanged();
  void acted(const btr::Act& act);
  void handsChanged();
  void handsRefused();  ///< an act while they are off

 private:
  void takeGame(const Game& game, const ModelSet& models, const std::vector<std::string>& channels);
  void takeRow(const LiveRow& row);
  void takeHands(const Act& act);

  const PluginHost& host_;
  LiveProcess& process_;
  Game game_;
  ModelSet models_;
  LiveScene scene_;
  LiveRow row_;
  std::vector<std::string> channels_, selection_;
  std::vector<std::string> later_;
  bool hands_ = true;
  std::map<std::string, Values> held_;    ///< by robot and joint
  std::map<std::string, PullAct> pulls_;  ///< by object
};

/// What an act changes of who plays with which numbers, in a copy of the game that is not run. Objects that come, go or
/// move are not its matter.
void changePlayers(Game& game, const Act& act);

}  // namespace btr::ui
