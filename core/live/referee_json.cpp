// The referee's part of a game file.
#include <nlohmann/json.hpp>

#include "core/live/referee.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using nlohmann::json;

constexpr double farAway_m = 100;
const std::vector<std::string> outs{"nothing", "line", "inside"};

RefereeEvent eventFrom(JsonReader reader) {
  RefereeEvent event;
  event.time_s = reader.number("time_s", 0, 1e9);
  event.half = static_cast<int>(reader.integer("half", 1, 100));
  event.clock_s = reader.number("clock_s", 0, 1e9);
  event.what = reader.text("what");
  event.team = reader.word("team", {"red", "blue", ""}, "");
  event.x_m = reader.number("x_m", -farAway_m, farAway_m, 0);
  event.y_m = reader.number("y_m", -farAway_m, farAway_m, 0);
  reader.finish();
  return event;
}

}  // namespace

RefereeSpec refereeFromReader(JsonReader reader) {
  RefereeSpec spec;
  if (auto field = reader.objectIfAny("field")) spec.field = fieldFromReader(*field);
  spec.half_s = reader.number("half_s", 1, 1e6, spec.half_s);
  spec.halves = static_cast<int>(reader.integer("halves", 1, 100, spec.halves));
  spec.ball = reader.text("ball", "");
  if (reader.any("kick_off")) {
    JsonReader places = reader.object("kick_off");
    for (const auto& member : places.node().items()) {
      const auto p = places.numbers(member.key(), 3);
      for (const double each : p)
        if (std::abs(each) > farAway_m) places.refuse(member.key(), "x [m], y [m] and heading [rad] up to 100");
      spec.kickOff[member.key()] = {p[0], p[1], p[2]};
    }
    places.finish();
  }
  spec.kickOffAfterGoal = reader.flag("kick_off_after_goal", true);
  spec.changeSides = reader.flag("change_sides", true);
  const std::string out = reader.word("out", outs, "line");
  spec.out = static_cast<RefereeSpec::Out>(std::ranges::find(outs, out) - outs.begin());
  spec.inside_m = reader.number("inside_m", 0, 5, spec.inside_m);
  reader.finish();
  return spec;
}

json toJson(const RefereeSpec& spec) {
  json object{{"half_s", spec.half_s},
              {"halves", spec.halves},
              {"kick_off_after_goal", spec.kickOffAfterGoal},
              {"change_sides", spec.changeSides},
              {"out", outs[static_cast<std::size_t>(spec.out)]},
              {"inside_m", spec.inside_m}};
  if (spec.field) object["field"] = toJson(*spec.field);
  if (!spec.ball.empty()) object["ball"] = spec.ball;
  if (!spec.kickOff.empty()) object["kick_off"] = spec.kickOff;
  return object;
}

RefereeState refereeStateFromReader(JsonReader reader) {
  RefereeState state;
  constexpr long most = 1'000'000'000'000;
  state.red = static_cast<int>(reader.integer("red", 0, 1'000'000));
  state.blue = static_cast<int>(reader.integer("blue", 0, 1'000'000));
  state.half = static_cast<int>(reader.integer("half", 1, 100));
  state.periods = static_cast<long>(reader.integer("periods", 0, most));
  state.over = reader.flag("over", false);
  state.waits = reader.flag("waits", false);
  state.kicks = reader.word("kicks", {"red", "blue"});
  if (reader.any("ball")) {
    const auto p = reader.numbers("ball", 3);
    state.ball = {p[0], p[1], p[2]};
  }
  state.seen = static_cast<long>(reader.integer("seen", 0, most));
  reader.array("events", [&](JsonReader event) { state.events.push_back(eventFrom(event)); });
  reader.finish();
  return state;
}

json toJson(const RefereeEvent& event) {
  return {{"time_s", event.time_s}, {"half", event.half}, {"clock_s", event.clock_s}, {"what", event.what},
          {"team", event.team},     {"x_m", event.x_m},   {"y_m", event.y_m}};
}

json toJson(const RefereeState& state) {
  json object{{"red", state.red},         {"blue", state.blue}, {"half", state.half},
              {"periods", state.periods}, {"over", state.over}, {"waits", state.waits},
              {"kicks", state.kicks},     {"seen", state.seen}, {"events", json::array()}};
  if (state.ball) object["ball"] = *state.ball;
  for (const RefereeEvent& event : state.events) object["events"].push_back(toJson(event));
  return object;
}

}  // namespace btr
