#include "core/live/referee.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace btr {
namespace {

using Eigen::Vector3d;
using Spot = std::array<double, 3>;

std::string otherThan(const std::string& team) { return team == "red" ? "blue" : "red"; }

/// Red defends −x in the first half, and where sides are kept.
bool areSidesChanged(const RefereeSpec& spec, const RefereeState& state) {
  return spec.changeSides && state.half % 2 == 0;
}

/// Where the middle of a ball that went from `before` to `now` left the field by so much; `now` if it began outside.
Vector3d crossing(const FieldSpec& field, double radius_m, const Vector3d& before, const Vector3d& now) {
  double share = 1;
  for (const auto& [axis, half] : {std::pair{0, field.length_m / 2 + radius_m}, {1, field.width_m / 2 + radius_m}}) {
    const double from = std::abs(before[axis]), to = std::abs(now[axis]);
    if (to > half && from <= half && before[axis] * now[axis] >= 0)
      share = std::min(share, (half - from) / (to - from));
  }
  return before + share * (now - before);
}

/// Where a ball that left the field is put down, at the border that it crossed; aside of robots that stand there.
Vector3d putBack(const RefereeSpec& spec, const FieldSpec& field, const Vector3d& where, const RefereeView& view) {
  constexpr double room_m = 0.2, aside_m = 0.1;  // a dog is 0.28 m long
  const double halfLength = field.length_m / 2, halfWidth = field.width_m / 2;
  const double in = spec.out == RefereeSpec::Out::inside ? spec.inside_m : 0;
  const bool end = std::abs(where.x()) - halfLength > std::abs(where.y()) - halfWidth;
  Vector3d place(std::clamp(where.x(), -halfLength, halfLength), std::clamp(where.y(), -halfWidth, halfWidth),
                 view.radius_m);
  int along = 0, across = 1;  // of the border
  if (end) {
    std::swap(along, across);
    // Not before the goal that it missed.
    const double aside = std::min(field.goals.width_m / 2 + 2 * view.radius_m, halfWidth);
    if (std::abs(place.y()) < aside) place.y() = std::copysign(aside, where.y());
  }
  place[across] -= std::copysign(in, place[across]);
  const double from = place[along], towards = end ? std::copysign(1.0, from) : -std::copysign(1.0, from);
  const auto isFree = [&] {
    return std::ranges::none_of(view.robots, [&](const Vector3d& r) { return (r - place).head<2>().norm() < room_m; });
  };
  const double most = end ? halfWidth : halfLength;
  for (int i = 1; !isFree() && std::abs(from + towards * aside_m * i) <= most; ++i)
    place[along] = from + towards * aside_m * i;
  return place;
}

/// The places of a team that defends −x: who kicks off, the two behind him, the one in the goal, the others.
Spot kickOffPlaceOf(const FieldSpec& field, int number, bool kicks) {
  const double length = field.length_m, width = field.width_m;
  // A dog's nose is 0.2 m before its middle; the circle's radius was 0.15 m in 2004.
  if (number == 0) return {-std::min(kicks ? 0.30 : 0.50, 0.2 * length), 0, 0};
  if (number <= 2) return {-0.25 * length, (number == 1 ? 0.25 : -0.25) * width, 0};
  if (number == 3) return {-0.45 * length, 0, 0};
  const int row = (number - 4) / 2;
  return {-0.35 * length, (number % 2 ? -1 : 1) * std::max(0.1, 0.4 - 0.1 * row) * width, 0};
}

}  // namespace

BallIs judge(const FieldSpec& field, double radius_m, const Vector3d& before, const Vector3d& now) {
  const double line = field.length_m / 2 + radius_m;
  if (std::abs(now.x()) <= line)
    return std::abs(now.y()) > field.width_m / 2 + radius_m ? BallIs::out : BallIs::onField;
  const Vector3d at = crossing(field, radius_m, before, now);
  const FieldSpec::Goals& goals = field.goals;
  const bool crossed = std::abs(before.x()) <= line;
  const bool behind = !crossed && goals.depth_m > 0 && std::abs(now.x()) > line + goals.depth_m;
  if (std::abs(at.y()) >= goals.width_m / 2 || at.z() >= goals.height_m || behind) return BallIs::out;
  return now.x() < 0 ? BallIs::inGoalAtMinusX : BallIs::inGoalAtPlusX;
}

void note(RefereeState& state, RefereeEvent event, double time_s, double period_s) {
  event.time_s = time_s;
  event.half = state.half;
  event.clock_s = static_cast<double>(state.periods) * period_s;
  if (state.events.size() == RefereeState::mostEvents) state.events.erase(state.events.begin());
  state.events.push_back(std::move(event));
  ++state.seen;
}

RefereeOrder officiate(const RefereeSpec& spec, const FieldSpec& field, RefereeState& state, const RefereeView& view) {
  RefereeOrder order;
  if (state.over) return order;
  const auto say = [&](const std::string& what, const std::string& team, const Vector3d& at = Vector3d::Zero()) {
    note(state, {0, 0, 0, what, team, at.x(), at.y()}, view.time_s, view.period_s);
  };
  ++state.periods;
  if (view.ball) {
    const Vector3d now = *view.ball;
    const Vector3d before = state.ball ? Vector3d(state.ball->data()) : now;
    const BallIs is = judge(field, view.radius_m, before, now);
    state.ball = {now.x(), now.y(), now.z()};
    if (is == BallIs::onField) {
      state.waits = false;
    } else if (!state.waits) {
      const Vector3d where = crossing(field, view.radius_m, before, now);
      state.waits = true;
      if (is == BallIs::out) {
        say("out", "", where);
        if (spec.out != RefereeSpec::Out::nothing) order.ball = putBack(spec, field, where, view);
      } else {
        const bool atRed = (is == BallIs::inGoalAtMinusX) != areSidesChanged(spec, state);
        ++(atRed ? state.blue : state.red);
        say("goal", atRed ? "blue" : "red", where);
        if (spec.kickOffAfterGoal) order.kickOff = atRed ? "red" : "blue";
      }
    }
  }
  if (state.periods < std::lround(spec.half_s / view.period_s)) return order;
  if (state.half == spec.halves) {
    say("end", "");
    state.over = true;
    return {};
  }
  say("half_time", "");
  ++state.half;
  state.periods = 0;
  state.kicks = otherThan(state.kicks);
  return {std::nullopt, state.kicks};
}

std::map<std::string, Spot> kickOffPlaces(const RefereeSpec& spec, const FieldSpec& field, const RefereeState& state,
                                          const std::string& kicks,
                                          const std::vector<std::pair<std::string, std::string>>& teams) {
  std::map<std::string, Spot> places;
  std::map<std::string, int> count;
  const bool changed = areSidesChanged(spec, state);
  const auto turned = [](const Spot& p) -> Spot {
    return {-p[0], -p[1], std::remainder(p[2] + std::numbers::pi, 2 * std::numbers::pi)};
  };
  for (const auto& [name, team] : teams) {
    Spot place;
    if (const auto given = spec.kickOff.find(name); given != spec.kickOff.end()) {
      place = given->second;
    } else if (!team.empty()) {
      place = kickOffPlaceOf(field, count[team]++, team == kicks);
      if (team == "blue") place = turned(place);
    } else {
      continue;
    }
    places[name] = changed ? turned(place) : place;
  }
  return places;
}

}  // namespace btr
