#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/live/act.h"

namespace btr {

class Session;

/// The acts that undo `act`, which is about to be applied to the session, in their order; none for what changes nothing
/// that can be seen (a checkpoint) and for what the session will refuse. Pure: the session stays as it is.
///
/// Exact: which objects there are and their order, numbers, effects, parameters, holds, pulls, positions of
/// balls and what joints are told; poses and joints to the last bits. Not exact: a controller that comes back begins
/// its motion anew; joints of a robot that was placed or thrown are at rest, and its servos and effects remember
/// nothing; a ball is not turned back.
std::vector<Act> undoOf(const Session& session, const Act& act);

/// What an act does, in two or three words: "move red1".
std::string nameOf(const Act& act);

/// What hands did to one session, so that it can be undone and done again. All that it does to the session are acts.
class UndoStack {
 public:
  static constexpr std::size_t most = 200;  ///< steps; older ones are forgotten

  /// Applies the act. Acts of the same gesture that follow each other are one step. Throws as Session::apply() does.
  void apply(Session& session, const Act& act, std::optional<long> gesture = std::nullopt);
  /// Takes back the last step. Throws InputError if there is none, or if it cannot be taken back: it is forgotten then.
  void undo(Session& session);
  /// Takes back the last undo().
  void redo(Session& session);

  std::string undoName() const { return done_.empty() ? "" : done_.back().name; }
  std::string redoName() const { return undone_.empty() ? "" : undone_.back().name; }

 private:
  struct Step {
    std::string name;
    std::vector<Act> acts;  ///< that take it back
    std::optional<long> gesture{};
    std::vector<std::string> restored{};  ///< objects whose place and pull `acts` give back already
  };

  static Step takeBack(Session& session, const Step& step);

  std::deque<Step> done_, undone_;
};

}  // namespace btr
