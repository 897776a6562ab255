#include "core/remote/act_messages.h"

#include <algorithm>

#include "core/remote/games_folder.h"
#include "core/spec/error.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

namespace v1 = uchilsim::v1;

template <std::size_t N>
std::array<double, N> arrayOf(const google::protobuf::RepeatedField<double>& numbers, const char* place,
                              const std::array<double, N>* byDefault = nullptr) {
  if (numbers.empty() && byDefault) return *byDefault;
  if (numbers.size() != static_cast<int>(N))
    throw InputError(place, std::to_string(numbers.size()) + " numbers", std::to_string(N));
  std::array<double, N> array{};
  std::copy(numbers.begin(), numbers.end(), array.begin());
  return array;
}

constexpr std::array<double, 3> zero{};
constexpr std::array<double, 4> upright{1, 0, 0, 0};

Values valuesOf(const google::protobuf::Map<std::string, double>& map) { return {map.begin(), map.end()}; }

Act pullOf(const v1::Pull& m) {
  PullAct act;
  act.object = m.object();
  act.link = m.link();
  act.point_m = arrayOf<3>(m.point_m(), "pull point_m", &zero);
  act.target_m = arrayOf<3>(m.target_m(), "pull target_m");
  if (m.stiffness_n_m() != 0) act.stiffness_n_m = m.stiffness_n_m();
  if (m.most_n() != 0) act.most_n = m.most_n();
  return act;
}

Act ordersOf(const v1::Orders& m) {
  OrdersAct act;
  act.robot = m.robot();
  act.targets = valuesOf(m.targets());
  for (const auto& [joint, gains] : m.gains()) act.orders.gains[joint] = {gains.p(), gains.i(), gains.d()};
  for (const auto& [joint, on] : m.enabled()) act.orders.enabled[joint] = on;
  for (const auto& [lamp, brightness] : m.lamps()) act.orders.lamps[lamp] = {brightness};
  return act;
}

template <class Optional>
std::optional<double> valueOf(const Optional& m) {
  return m.has_value() ? std::optional(m.value()) : std::nullopt;
}

}  // namespace

Act actOf(const v1::Act& message) {
  switch (message.act_case()) {
    case v1::Act::kHold: {
      const v1::Hold& m = message.hold();
      return HoldAct{m.robot(), m.joint(), m.has_position() ? std::optional(m.position()) : std::nullopt};
    }
    case v1::Act::kPlace: {
      const v1::Place& m = message.place();
      return PlaceAct{m.object(), arrayOf<3>(m.position_m(), "place position_m"),
                      arrayOf<4>(m.orientation_wxyz(), "place orientation_wxyz", &upright), valuesOf(m.joints())};
    }
    case v1::Act::kThrow: {
      const v1::Throw& m = message.throw_();
      return ThrowAct{m.object(), arrayOf<3>(m.velocity_m_s(), "throw velocity_m_s"),
                      arrayOf<3>(m.spin_rad_s(), "throw spin_rad_s", &zero)};
    }
    case v1::Act::kPull:
      return pullOf(message.pull());
    case v1::Act::kLetGo:
      return LetGoAct{message.let_go()};
    case v1::Act::kParameter:
      return ParameterAct{message.parameter().robot(), message.parameter().name(), valueOf(message.parameter())};
    case v1::Act::kNumber:
      return NumberAct{message.number().robot(), message.number().name(), valueOf(message.number())};
    case v1::Act::kRemove:
      return RemoveAct{message.remove()};
    case v1::Act::kOrders:
      return ordersOf(message.orders());
    case v1::Act::kJson:
      requireShallow(message.json(), "act");
      return actFromJson(message.json(), "act");
    case v1::Act::ACT_NOT_SET:
      break;
  }
  throw InputError("act", "an act that says nothing", "one of hold, place, throw, pull, …");
}

std::vector<Act> actsOf(const v1::PoseRequest& m) {
  std::vector<Act> acts;
  acts.push_back(PlaceAct{m.object(), arrayOf<3>(m.position_m(), "pose position_m"),
                          arrayOf<4>(m.orientation_wxyz(), "pose orientation_wxyz", &upright), valuesOf(m.joints())});
  if (!m.velocity_m_s().empty() || !m.spin_rad_s().empty())
    acts.push_back(ThrowAct{m.object(), arrayOf<3>(m.velocity_m_s(), "pose velocity_m_s", &zero),
                            arrayOf<3>(m.spin_rad_s(), "pose spin_rad_s", &zero)});
  return acts;
}

void describe(const Parameter& parameter, v1::NumberParts& out) {
  out.set_name(parameter.name);
  out.set_unit(parameter.unit);
  out.set_meaning(parameter.meaning);
  out.set_minimum(parameter.minimum);
  out.set_maximum(parameter.maximum);
  out.set_by_default(parameter.byDefault);
  out.set_integer(parameter.integer);
  for (const std::string& choice : parameter.choices) out.add_choices(choice);
}

}  // namespace btr::remote
