#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/pitch_spec.h"
#include "core/spec/scene_spec.h"

namespace btr {

class JsonReader;

/// The referee of a game between red and blue. In the first half red defends the goal at −x.
struct RefereeSpec {
  /// What happens to a ball that is out: nothing; it is put on the border line where it crossed it; so far inside.
  enum class Out { nothing, line, inside };

  std::optional<FieldSpec> field;  ///< else that of the scene
  double half_s = 600;
  int halves = 2;
  std::string ball;  ///< "": the first of the scene
  /// x [m], y [m], heading [rad] by robot, with red at −x; who is not here has a place by his team, see
  /// kickOffPlaces().
  std::map<std::string, std::array<double, 3>> kickOff;
  bool kickOffAfterGoal = true;
  bool changeSides = true;  ///< at half time
  Out out = Out::line;
  double inside_m = 0.4;
  bool operator==(const RefereeSpec&) const = default;
};

/// Something that the referee saw or did.
struct RefereeEvent {
  double time_s = 0;  ///< since the game began
  int half = 1;
  double clock_s = 0;       ///< of this half
  std::string what;         ///< "goal", "out", "kick_off", "half_time", "end", "score" (set by hand)
  std::string team;         ///< who scored, who kicks off; else ""
  double x_m = 0, y_m = 0;  ///< of the ball, where it crossed the line; else 0
  bool operator==(const RefereeEvent&) const = default;
};

/// What the referee remembers. Goes on with a saved game.
struct RefereeState {
  static constexpr std::size_t mostEvents = 1000;  ///< older ones are forgotten

  int red = 0, blue = 0;
  int half = 1;
  long periods = 0;           ///< control periods of this half
  bool over = false;          ///< the game: nothing counts any more
  bool waits = false;         ///< the ball was judged where it is; it counts again once it is on the field
  std::string kicks = "red";  ///< who kicks off next at half time
  std::optional<std::array<double, 3>> ball{};  ///< where it was [m]
  long seen = 0;                                ///< events, also those that are forgotten
  std::vector<RefereeEvent> events{};
  bool operator==(const RefereeState&) const = default;
};

/// Where a ball is whose middle went straight from `before` to `now`: on the field while any part of it is over the
/// border line; in a goal once all of it has passed the goal line between the posts and under the bar; else out.
enum class BallIs { onField, out, inGoalAtMinusX, inGoalAtPlusX };
BallIs judge(const FieldSpec& field, double radius_m, const Eigen::Vector3d& before, const Eigen::Vector3d& now);

/// What the referee sees at the end of a control period.
struct RefereeView {
  double time_s = 0, period_s = 0;
  std::optional<Eigen::Vector3d> ball{};  ///< none: it was taken away
  double radius_m = 0;
  std::vector<Eigen::Vector3d> robots{};  ///< where they stand
};

/// What he does to the world.
struct RefereeOrder {
  std::optional<Eigen::Vector3d> ball{};  ///< it is put there, at rest
  std::string kickOff{};                  ///< this team kicks off: everybody to his place, the ball to the middle
};

/// One control period. A function of its arguments alone. `field` is the one that counts.
RefereeOrder officiate(const RefereeSpec& spec, const FieldSpec& field, RefereeState& state, const RefereeView& view);

/// Adds an event that happened now.
void note(RefereeState& state, RefereeEvent event, double time_s, double period_s);

/// Where robots stand at kick-off: x [m], y [m], heading [rad] by name. `teams` are name and team ("" stays where it
/// is) in the scene's order.
std::map<std::string, std::array<double, 3>> kickOffPlaces(
    const RefereeSpec& spec, const FieldSpec& field, const RefereeState& state, const std::string& kicks,
    const std::vector<std::pair<std::string, std::string>>& teams);

RefereeSpec refereeFromReader(JsonReader reader);
nlohmann::json toJson(const RefereeSpec& spec);
RefereeState refereeStateFromReader(JsonReader reader);
nlohmann::json toJson(const RefereeState& state);
nlohmann::json toJson(const RefereeEvent& event);

}  // namespace btr
