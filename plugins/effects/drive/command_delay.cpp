/// The drive follows a command that is T seconds old: bus, firmware frames, double buffers (three to six 8 ms frames on
/// the AIBO; Stronger and Stone 2004).
///   c'(t ∓ h/4) = mean of c over the half step before and after t − T        h: the simulator's step [s]
/// Commands are held between changes, so the means are linear interpolations between them: the delay is continuous,
/// any number of seconds, not a count of steps. Before the first command the first command counts. Neutral: T = 0.
///
/// State: a ring of the last changes (time, value). Changes closer together than a 256th of the largest delay are
/// merged.
#include <algorithm>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

constexpr double longest_s = 0.08;
constexpr std::size_t capacity = 256;

/// The ring in the state's numbers: how many changes there are, where the newest is, then times and values.
class Changes {
 public:
  explicit Changes(std::span<double> state) : state_(state) {}

  std::size_t count() const { return static_cast<std::size_t>(state_[0]); }
  /// `age` 0 is the newest.
  double& time(std::size_t age) const { return state_[2 + place(age)]; }
  double& value(std::size_t age) const { return state_[2 + capacity + place(age)]; }

  void add(double now, double command) const {
    if (count() > 0 && value(0) == command) return;
    if (count() > 1 && now - time(0) < longest_s / capacity) {
      value(0) = command;
      return;
    }
    state_[1] = static_cast<double>((static_cast<std::size_t>(state_[1]) + 1) % capacity);
    state_[0] = static_cast<double>(std::min(count() + 1, capacity));
    time(0) = now;
    value(0) = command;
  }

  /// Each change counts for the part of the window in which it was the latest; the oldest one reaches back for ever.
  double mean(double begin, double end) const {
    double sum = 0, until = end;
    for (std::size_t age = 0; age < count() && until > begin; ++age) {
      const bool oldest = age + 1 == count();
      const double since = oldest ? begin : std::max(begin, time(age));
      if (since >= until) continue;
      if (since == begin && until == end) return value(age);
      sum += value(age) * (until - since);
      until = since;
    }
    return sum / (end - begin);
  }

 private:
  std::size_t place(std::size_t age) const { return (static_cast<std::size_t>(state_[1]) + capacity - age) % capacity; }
  std::span<double> state_;
};

class CommandDelay final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"delay_s", "s", "age of the command that the drive follows", 0, longest_s, 0.024, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::command, "the drive follows a command that is some time old", "c_drive(t) = c(t − T)",
            "T: delay_s", "Stronger and Stone 2004"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 2 + 2 * static_cast<int>(capacity); }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double> state, double dt) const override {
    if (values[0] == 0 || dt <= 0) return command;
    const Changes changes(state);
    if (changes.count() == 0) changes.add(joint.time - dt / 2, command.before);
    changes.add(joint.time, command.after);
    const double then = joint.time - values[0];
    return {changes.mean(then - dt / 2, then), changes.mean(then, then + dt / 2)};
  }
};

}  // namespace

BTR_EFFECT(CommandDelay, "command_delay")
