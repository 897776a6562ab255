#include "core/gap/recordings/doctor/hands.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/trials.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

struct Sample {
  double time_s = 0, value = 0;
};

/// Position, rate and acceleration at one time, of a parabola through the samples around it.
struct Motion {
  double time_s = 0, position = 0, rate = 0, acceleration = 0;
};

/// With what a free joint's acceleration is explained; the columns of a regression.
using Row = Eigen::Matrix<double, 5, 1>;

std::vector<Sample> samplesOf(const Recording& trial, std::size_t column) {
  std::vector<Sample> samples;
  for (std::size_t row = 0; row < trial.rows(); ++row)
    if (std::isfinite(trial.columns[column][row]))
      samples.push_back({trial.columns[0][row], trial.columns[column][row]});
  return samples;
}

/// Of the swings about the middle of the last samples; nothing where there are less than three passes.
std::optional<double> periodOf(const std::vector<Sample>& samples, std::size_t first) {
  constexpr double clear = 0.1;  // of the whole swing, on either side of its middle
  constexpr std::size_t least = 3;
  double low = samples[first].value, high = low;
  for (std::size_t i = first; i < samples.size(); ++i) {
    low = std::min(low, samples[i].value);
    high = std::max(high, samples[i].value);
  }
  const double middle = (low + high) / 2, margin = clear * (high - low);
  int side = 0;
  std::vector<double> passes;
  for (std::size_t i = first; i < samples.size(); ++i) {
    const double away = samples[i].value - middle;
    if (std::abs(away) < margin) continue;
    const int now = away > 0 ? 1 : -1;
    if (side != 0 && now != side) passes.push_back(samples[i].time_s);
    side = now;
  }
  if (passes.size() < least) return std::nullopt;
  return 2 * (passes.back() - passes.front()) / static_cast<double>(passes.size() - 1);
}

/// Where at least five samples lie within `half_s` to either side.
std::vector<Motion> motionOf(const std::vector<Sample>& samples, double half_s) {
  constexpr std::size_t least = 5;
  std::vector<Motion> motion;
  std::size_t begin = 0, end = 0;
  for (const Sample& at : samples) {
    while (samples[begin].time_s < at.time_s - half_s) ++begin;
    while (end < samples.size() && samples[end].time_s <= at.time_s + half_s) ++end;
    const bool whole = at.time_s - half_s >= samples.front().time_s && at.time_s + half_s <= samples.back().time_s;
    if (!whole || end - begin < least) continue;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      const double t = (samples[i].time_s - at.time_s) / half_s;
      const Eigen::Vector3d powers(1, t, t * t);
      normal += powers * powers.transpose();
      right += powers * samples[i].value;
    }
    const Eigen::Vector3d parabola = normal.ldlt().solve(right);
    motion.push_back({at.time_s, parabola[0], parabola[1] / half_s, 2 * parabola[2] / (half_s * half_s)});
  }
  return motion;
}

Row rowOf(const Motion& m, bool slides, double slow) {
  Row row;
  row << (slides ? 1 : std::cos(m.position)), slides ? m.position : std::sin(m.position), m.rate,
      m.rate * std::abs(m.rate), std::tanh(m.rate / slow);
  return row;
}

/// Until when the first samples do not move as the others do; nothing where they do, or where that cannot be told.
std::optional<double> heldUntil(const std::vector<Sample>& samples, bool slides) {
  constexpr double later = 0.4;  // part of the time after which what moves freely is learned
  constexpr double samplesPerPeriod = 25, widthPerPeriod = 1.0 / 20, blocksPerPeriod = 10;
  constexpr double learned = 0.35;   // of the accelerations, at most left where it is learned
  constexpr double clear = 0.3;      // of them: what no free joint does
  constexpr double scatters = 4;     // of the blocks that are free
  constexpr double slowRate = 0.02;  // of the usual rate: where dry friction turns
  constexpr std::size_t gap = 2;     // blocks that look free while it is held
  constexpr double odd = 0.05;       // part of the later blocks that may stand out
  if (samples.size() < 60) return std::nullopt;
  const double begin = samples.front().time_s, whole = samples.back().time_s - begin;
  const auto first = std::ranges::find_if(samples, [&](const Sample& s) { return s.time_s >= begin + later * whole; });
  const auto period = periodOf(samples, static_cast<std::size_t>(first - samples.begin()));
  const double sample_s = whole / static_cast<double>(samples.size() - 1);
  if (!period || *period < samplesPerPeriod * sample_s) return std::nullopt;

  const std::vector<Motion> motion = motionOf(samples, std::max(widthPerPeriod * *period, 2.5 * sample_s));
  double rates = 0, accelerations = 0, fastest = 0;
  std::size_t free = 0;
  for (const Motion& m : motion)
    if (m.time_s >= first->time_s) {
      rates += m.rate * m.rate;
      fastest = std::max(fastest, std::abs(m.rate));
      accelerations += m.acceleration * m.acceleration;
      ++free;
    }
  if (free < 30) return std::nullopt;
  const double slow = slowRate * std::sqrt(rates / static_cast<double>(free));
  const double usual = std::sqrt(accelerations / static_cast<double>(free));
  if (slow == 0 || usual == 0) return std::nullopt;
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Row right = Row::Zero();
  for (const Motion& m : motion)
    if (m.time_s >= first->time_s) {
      const Row row = rowOf(m, slides, slow);
      normal += row * row.transpose();
      right += row * m.acceleration;
    }
  const Row law = normal.completeOrthogonalDecomposition().solve(right);
  double left = 0;
  struct Block {
    double sum = 0;
    std::size_t count = 0;
    double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  };
  std::vector<Block> blocks;
  const double block_s = *period / blocksPerPeriod;
  for (const Motion& m : motion) {
    const double rest = m.acceleration - law.dot(rowOf(m, slides, slow));
    if (m.time_s >= first->time_s) left += rest * rest;
    // Nothing was learned of how it brakes when it is faster.
    if (std::abs(m.rate) > fastest) continue;
    const auto block = static_cast<std::size_t>((m.time_s - begin) / block_s);
    blocks.resize(std::max(blocks.size(), block + 1));
    blocks[block].sum += rest;
    ++blocks[block].count;
  }
  if (std::sqrt(left / static_cast<double>(free)) > learned * usual) return std::nullopt;
  const auto firstFree = static_cast<std::size_t>((first->time_s - begin) / block_s) + 1;
  double scatter = 0;
  for (std::size_t i = firstFree; i < blocks.size(); ++i) scatter += blocks[i].mean() * blocks[i].mean();
  if (firstFree + 3 > blocks.size()) return std::nullopt;
  const double most =
      std::max(clear * usual, scatters * std::sqrt(scatter / static_cast<double>(blocks.size() - firstFree)));
  const auto standsOut = [&](std::size_t i) { return std::abs(blocks[i].mean()) > most; };

  std::size_t held = 0;  // blocks from the beginning on
  for (std::size_t i = 0; i < blocks.size() && i <= held + gap; ++i)
    if (standsOut(i)) held = i + 1;
  if (held < 2 || held >= firstFree) return std::nullopt;
  std::size_t others = 0;
  for (std::size_t i = held; i < blocks.size(); ++i) others += standsOut(i) ? 1 : 0;
  if (static_cast<double>(others) > odd * static_cast<double>(blocks.size() - held)) return std::nullopt;
  return begin + block_s * static_cast<double>(held);
}

/// The robot's only moving joint, which nothing drives, and its column.
struct FreeJoint {
  std::size_t column = 0;
  bool slides = false;
};
std::optional<FreeJoint> freeJointOf(const Scene& scene, const Binding& binding) {
  if (scene.robots.size() != 1 || !scene.balls.empty() || scene.robots[0].freeBase || !binding.inputs.empty())
    return std::nullopt;
  const SceneRobot& robot = scene.robots[0];
  std::optional<std::size_t> moving;
  for (std::size_t joint = 0; joint < robot.model.joints.size(); ++joint) {
    if (robot.model.joints[joint].type == Joint::Type::fixed) continue;
    if (moving || robot.drives[joint].kind != Drive::Kind::none) return std::nullopt;
    moving = joint;
  }
  for (const Measured& measured : binding.measured)
    if (moving && measured.what == Measured::What::position && measured.part == *moving)
      return FreeJoint{measured.column, robot.model.joints[*moving].type == Joint::Type::slide};
  return std::nullopt;
}

/// True if it left out how the joint was held at first.
bool leaveOutSwinger(Recording& trial, const FreeJoint& joint) {
  const std::string why = ": until then " + trial.channels[joint.column] +
                          " does not move as it does afterwards, though nothing drives it; a hand, it seems";
  const std::vector<Sample> samples = samplesOf(trial, joint.column);
  if (samples.empty()) return false;
  const double begin = trial.columns[0].front(), end = trial.columns[0].back();
  const auto held = heldUntil(samples, joint.slides);
  std::vector<Sample> backwards(samples.rbegin(), samples.rend());
  for (Sample& sample : backwards) sample.time_s = -sample.time_s;
  const auto caught = heldUntil(backwards, joint.slides);
  if (held && caught && -*caught <= *held) return false;
  if (held)
    trial.notes.push_back("the first " + digits(*held - begin) + " s are left out" + why +
                          " (\"from_s\": 0 in its mapping keeps them)");
  if (caught)
    trial.notes.push_back("the last " + digits(end + *caught) + " s are left out: from then on " +
                          trial.channels[joint.column] +
                          " does not move as it did before, though nothing drives it; a hand, it seems (\"until_s\" in "
                          "its mapping keeps them)");
  if (held || caught) trial = rowsBetween(trial, held.value_or(begin), caught ? -*caught : end);
  return held.has_value();
}

/// Robots that stand fast and whose joints nothing drives; nothing else is in the scene.
bool isPassive(const Scene& scene, const Binding& binding) {
  if (scene.robots.empty() || !scene.balls.empty() || !binding.inputs.empty()) return false;
  return std::ranges::all_of(scene.robots, [](const SceneRobot& robot) {
    return !robot.freeBase &&
           std::ranges::all_of(robot.drives, [](const Drive& drive) { return drive.kind == Drive::Kind::none; });
  });
}

/// The first samples' middle one by value: where something rests at first.
constexpr std::size_t restingSamples = 5;
double restOf(const std::vector<Sample>& samples) {
  std::vector<double> first;
  for (std::size_t i = 0; i < restingSamples; ++i) first.push_back(samples[i].value);
  std::ranges::nth_element(first, first.begin() + restingSamples / 2);
  return first[restingSamples / 2];
}

/// How something that rests at first sets out: when it has gone a little way, a quarter of it, and four times as far.
struct SetOut {
  double quarter_s = 0, little_s = 0, fourTimes_s = 0;
  /// When it was let go: what falls from rest is four times as far after twice the time.
  double letGo_s() const { return 2 * little_s - fourTimes_s; }
  double fall_s() const { return little_s - letGo_s(); }
  /// What leaves an unstable equilibrium goes four times as far in the same time again and again.
  bool falls() const {
    constexpr double agree = 0.5;
    return std::abs(2 * quarter_s - little_s - letGo_s()) < agree * fall_s();
  }
};
std::optional<SetOut> setOutOf(const std::vector<Sample>& samples, double noise) {
  constexpr double little = 0.04;  // of the whole motion; hands are not quite still
  if (samples.size() < 4 * restingSamples) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(samples, {}, &Sample::value);
  const double way = std::max(4 * noise, little * (high.value - low.value));
  const double rest = restOf(samples);
  const auto beyond = [&](double distance) {
    return std::ranges::find_if(samples, [&](const Sample& s) { return std::abs(s.value - rest) > distance; });
  };
  const auto quarter = beyond(way / 4), near = beyond(way), far = beyond(4 * way);
  if (far == samples.end()) return std::nullopt;
  return SetOut{quarter->time_s, near->time_s, far->time_s};
}

/// Joints that rest although nothing holds them, and then move although nothing drives them.
void leaveOutHeldRobot(Recording& trial, const Binding& binding) {
  constexpr double floors = 6;      // noise floors
  constexpr double least_s = 0.04;  // how long it rests at least, as long as it then takes to go a little way
  constexpr double leastRows = 4;   // the same in rows
  std::optional<SetOut> first;
  for (const Measured& measured : binding.measured) {
    if (measured.what != Measured::What::position) continue;
    const auto out = setOutOf(samplesOf(trial, measured.column), floors * channelFloor(trial, measured.column).level);
    if (out && (!first || out->little_s < first->little_s)) first = out;
  }
  if (!first || !first->falls()) return;
  const double begin = trial.columns[0].front(), end = trial.columns[0].back();
  const double row_s = (end - begin) / static_cast<double>(trial.rows() - 1);
  if (first->letGo_s() - begin < std::max({least_s, leastRows * row_s, first->fall_s()})) return;
  trial.notes.push_back(
      "the first " + digits(first->little_s - begin) +
      " s are left out: until then all joints rest, then they move though nothing drives them; a hand, "
      "it seems (\"from_s\": 0 in its mapping keeps them)");
  trial = rowsBetween(trial, first->little_s, end);
}

/// A ball that rests in the air and then falls.
void leaveOutHeldBall(Recording& trial, const Scene& scene, const Binding& binding) {
  constexpr double least_s = 0.04, looked_s = 0.08;  // how long it rests, and is looked at then
  constexpr double fallLeast = 0.5, fallMost = 2.5;  // of a free fall
  constexpr double inTheAir_m = 0.1, floors = 6;     // above the floor; noise floors
  if (scene.balls.size() != 1 || !scene.robots.empty()) return;
  const double gravity = -scene.gravity_m_s2.z();
  if (gravity < 1) return;
  std::vector<std::size_t> places;
  std::optional<std::size_t> height;
  for (const Measured& measured : binding.measured)
    if (measured.what == Measured::What::ballPosition) {
      places.push_back(measured.column);
      if (measured.part == 2) height = measured.column;
    }
  if (!height) return;
  const std::vector<Sample> z = samplesOf(trial, *height);
  if (z.size() < 10 || z.front().value < scene.balls[0].radius_m + inTheAir_m) return;
  double until = trial.columns[0].back(), hidden_s = 0;  // how long noise hides a fall
  for (const std::size_t column : places) {
    const std::vector<Sample> samples = samplesOf(trial, column);
    const double noise = std::max(floors * channelFloor(trial, column).level, 1e-4);
    if (samples.size() < restingSamples) return;
    hidden_s = std::max(hidden_s, std::sqrt(2 * noise / gravity));
    const double rest = restOf(samples);
    for (const Sample& sample : samples)
      if (std::abs(sample.value - rest) > noise) {
        until = std::min(until, sample.time_s);
        break;
      }
  }
  const auto leaves = std::ranges::find_if(z, [&](const Sample& s) { return s.time_s >= until; });
  if (leaves == z.end() || leaves - z.begin() < 5 || until - z.front().time_s < std::max(least_s, 2 * hidden_s)) return;
  const Sample& last = *(leaves - 1);
  const auto later = std::ranges::find_if(z, [&](const Sample& s) { return s.time_s >= last.time_s + looked_s; });
  if (later == z.end()) return;
  const double fall_s = later->time_s - last.time_s;
  const double share = (last.value - later->value) / (gravity / 2 * fall_s * fall_s);
  if (share < fallLeast || share > fallMost) return;
  trial.notes.push_back("the first " + digits(last.time_s - trial.columns[0].front()) +
                        " s are left out: until then the ball rests in the air; a hand, it seems (\"from_s\": 0 in its "
                        "mapping keeps them)");
  trial = rowsBetween(trial, last.time_s, trial.columns[0].back());
}

}  // namespace

void leaveOutHands(Recording& trial, const Scene& scene, const Binding& binding) {
  if (trial.bounded || trial.rows() < 2) return;
  if (!isPassive(scene, binding)) return leaveOutHeldBall(trial, scene, binding);
  const auto joint = freeJointOf(scene, binding);
  if (!joint || !leaveOutSwinger(trial, *joint)) leaveOutHeldRobot(trial, binding);
}

}  // namespace btr
