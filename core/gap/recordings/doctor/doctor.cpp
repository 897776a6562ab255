// What a comparison of commands and measured positions says about the mapping.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/doctor/encoder_offset.h"
#include "core/gap/recordings/doctor/following.h"
#include "core/gap/recordings/doctor/joint_range.h"
#include "core/gap/recordings/doctor/joint_series.h"
#include "core/gap/recordings/doctor/leaps.h"
#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/doctor/time_doctor.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr double degree = M_PI / 180;
constexpr double leastAhead_s = 0.005;

class JointDoctor {
 public:
  JointDoctor(const Scene& scene, const Recording& recording, const Binding& binding)
      : scene_(scene), joints_(jointSeries(scene, recording, binding, period_s_)) {}

  /// `leaping` are channels of which more cannot be said.
  Diagnosis look(const std::set<std::string>& leaping) {
    std::vector<char> known;
    for (const JointSeries& series : joints_)
      known.push_back(leaping.contains(series.positionChannel) || leaping.contains(series.commandChannel));
    findSwaps(known);
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (!known[i]) lookAt(joints_[i]);
    return std::move(found_);
  }

 private:
  const Joint& model(const JointSeries& series) const { return scene_.robots[series.robot].model.joints[series.joint]; }
  bool slides(const JointSeries& series) const { return model(series).type == Joint::Type::slide; }
  bool excited(const JointSeries& series) const { return series.commandSpread > (slides(series) ? 0.002 : 0.02); }
  Following between(const JointSeries& command, const JointSeries& position) const {
    return follow(command.command, position.position, position.used, period_s_);
  }

  /// Follows another joint's command clearly better than its own, and that one is not alike.
  bool followsOther(const JointSeries& own, const JointSeries& other) const {
    if (slides(own) != slides(other) || !excited(other)) return false;
    const double mine = std::abs(between(own, own).correlation);
    const double strange = std::abs(between(other, own).correlation);
    if (strange < 0.9 || mine > 0.7 || strange < mine + 0.25) return false;
    return std::abs(follow(own.command, other.command, own.used, period_s_).correlation) < 0.9;
  }

  void findSwaps(std::vector<char>& known) {
    for (std::size_t i = 0; i < joints_.size(); ++i)
      for (std::size_t j = i + 1; j < joints_.size(); ++j) {
        const JointSeries &a = joints_[i], &b = joints_[j];
        if (known[i] || known[j] || !excited(a) || !excited(b) || !followsOther(a, b) || !followsOther(b, a)) continue;
        known[i] = known[j] = 1;
        const std::string text = a.positionChannel + " follows " + b.commandChannel + " (correlation " +
                                 digits(between(b, a).correlation) + ") and not its own command (" +
                                 digits(between(a, a).correlation) + "), and " + b.positionChannel + " follows " +
                                 a.commandChannel + " (" + digits(between(a, b).correlation) + ", own " +
                                 digits(between(b, b).correlation) +
                                 "): the two joints are mixed up; exchange the two columns in the mapping";
        found_.findings.push_back({a.positionChannel, text, true});
      }
  }

  void lookAt(const JointSeries& series) {
    const bool rotary = !slides(series);
    const std::string unit = rotary ? " rad" : " m";
    // A column that stands still.
    if (series.highest == series.lowest) {
      if (series.commandSpread > (rotary ? 0.1 : 0.01))
        add(series, series.positionChannel + " is always " + digits(series.highest, 6) + unit + " while " +
                        series.commandChannel + " moves with a spread of " + digits(series.commandSpread) + unit +
                        ": the sensor was not read, or the mapping names a wrong column");
      return;
    }
    if (!excited(series)) return;
    const Following following = between(series, series);
    if (std::abs(following.correlation) < 0.8) {
      checkClock(series);
      return;
    }
    const std::string evidence = series.positionChannel + " moves " + digits(following.ratio) + " times as far as " +
                                 series.commandChannel + " (correlation " + digits(following.correlation) +
                                 " at a lag of " + digits(following.lag_s) + " s)";
    const bool unitsFine = checkUnits(series, following, evidence);
    const bool turned = following.correlation < 0 && following.highest < -0.5;
    if (turned)
      add(series,
          series.positionChannel + " moves against " + series.commandChannel + " (correlation " +
              digits(following.correlation) + " at a lag of " + digits(following.lag_s) + " s, nowhere above " +
              digits(following.highest) +
              "): a sign is turned; give one of them, the one that is not right-handed about the model's " +
              "axis, a negative \"scale\" in the mapping",
          following.correlation < -0.9 && following.highest < -0.7, true);
    else if (following.correlation > 0)
      found_.following.push_back(series.positionChannel);
    if (!unitsFine || turned) return;
    checkClock(series);
    if (following.correlation < 0.9) return;
    if (const auto found = encoderOffset(scene_, joints_, series, following.lag_s, period_s_))
      add(series, series.positionChannel + " lies " + digits(std::abs(found->offset)) + " ± " +
                      digits(found->uncertainty, 2) + unit + (found->offset > 0 ? " above " : " below ") +
                      series.commandChannel + " throughout, more than its load explains: an offset of the " +
                      "encoder; add " + digits(-found->offset) + " to its \"offset\" in the mapping");
  }

  void add(const JointSeries& series, const std::string& text, bool certain = false, bool refutable = false) {
    found_.findings.push_back({series.positionChannel, text, certain, refutable});
  }

  /// A measurement may lag behind its command for many reasons; it cannot be ahead of it.
  void checkClock(const JointSeries& series) {
    std::vector<double> time;
    for (std::size_t i = 0; i < series.command.size(); ++i) time.push_back(static_cast<double>(i) * period_s_);
    const auto clock = clockOffset(time, series.command, series.position);
    if (!clock || clock->correlation < 0.9 || clock->offset_s + clock->uncertainty_s > -leastAhead_s) return;
    add(series, series.positionChannel + " moves " + digits(-clock->offset_s) + " ± " +
                    digits(clock->uncertainty_s, 2) + " s before " + series.commandChannel + " does (correlation " +
                    digits(clock->correlation) + "): the two were written by different clocks, or the columns are " +
                    "shifted against each other; record both by one clock");
  }

  /// True if nothing is wrong with them.
  bool checkUnits(const JointSeries& series, const Following& following, const std::string& evidence) {
    const bool rotary = !slides(series);
    struct Unit {
      const char* name;
      double size;  ///< in rad or m
    };
    const std::vector<Unit> units = rotary ? std::vector<Unit>{{"degrees", degree}}
                                           : std::vector<Unit>{{"millimetres", 0.001}, {"centimetres", 0.01}};
    // The nearest unit. A soft servo lags far behind its command, so the ratio itself is only known roughly.
    const Unit* named = nullptr;
    const bool up = following.ratio > 5;
    double nearest = std::log(6);
    for (const Unit& unit : units) {
      const double away = std::abs(std::log(following.ratio * (up ? unit.size : 1 / unit.size)));
      if ((up || following.ratio < 0.1) && away < nearest) named = &unit, nearest = away;
    }
    const std::string right = rotary ? "radians" : "metres";
    if (named) {
      // The larger of the two is in the smaller unit, unless only the larger one can be where the joint can be.
      const bool positionWrong = up == !inReach(series, up);
      const std::string& wrong = positionWrong ? series.positionChannel : series.commandChannel;
      const bool shrink = positionWrong == up;
      // Even a resonance does not come that near to the ratio of two units; a joint that is held may move too little.
      const bool certain =
          std::abs(following.correlation) > 0.95 && nearest < std::log(2) && (up || !inReach(series, up));
      found_.findings.push_back(
          {wrong,
           evidence + ": " + wrong + " is " +
               (shrink ? "in " + std::string(named->name) + ", not " + right : right + " taken for " + named->name) +
               "; multiply its \"scale\" in the mapping by " + digits(shrink ? named->size : 1 / named->size, 6),
           certain});
      return false;
    }
    if (std::abs(following.correlation) > 0.9 && (following.ratio > 5 || following.ratio < 0.1)) {
      add(series, evidence + ": no servo does that; check the \"scale\" of both in the mapping");
      return false;
    }
    // Both alike but nowhere near where the joint can be.
    const Joint& joint = model(series);
    const double reach = std::max(std::abs(joint.lower), std::abs(joint.upper));
    const double farthest = std::max(std::abs(series.lowest), std::abs(series.highest));
    if (reach < 1e6 && farthest > 4 * reach + (rotary ? 1 : 0.1)) {
      add(series, series.positionChannel + " and " + series.commandChannel + " reach " + digits(farthest) +
                      ", the model's joint " + digits(reach) + (rotary ? " rad" : " m") + " at most: both are in " +
                      units.front().name + ", it seems; multiply both \"scale\"s in the mapping by " +
                      digits(units.front().size, 6));
      return false;
    }
    return true;
  }

  /// Whether the larger of position and command lies where the joint can be.
  bool inReach(const JointSeries& series, bool positionIsLarger) const {
    const std::vector<double>& larger = positionIsLarger ? series.position : series.command;
    const Joint& joint = model(series);
    const bool rotary = !slides(series);
    const double slack = rotary ? 0.3 : 0.05;
    const double low = joint.lower > -1e6 ? joint.lower - slack : rotary ? -4 * M_PI : -10;
    const double high = joint.upper < 1e6 ? joint.upper + slack : rotary ? 4 * M_PI : 10;
    const auto [lowest, highest] = std::minmax_element(larger.begin(), larger.end());
    return *lowest >= low && *highest <= high;
  }

  const Scene& scene_;
  double period_s_ = 0;
  std::vector<JointSeries> joints_;
  Diagnosis found_;
};

/// Places in millimetres.
void lookAtPlaces(const Recording& recording, const Binding& binding, std::vector<Finding>& findings) {
  constexpr double farthest_m = 50;
  for (const Binding::Measured& measured : binding.measured) {
    if (measured.what != Binding::Measured::What::basePosition &&
        measured.what != Binding::Measured::What::ballPosition)
      continue;
    double farthest = 0;
    for (const double value : recording.columns[measured.column])
      if (std::isfinite(value)) farthest = std::max(farthest, std::abs(value));
    if (farthest > farthest_m)
      findings.push_back({recording.channels[measured.column],
                          recording.channels[measured.column] + " reaches " + digits(farthest) +
                              " m: millimetres, it seems; multiply its \"scale\" in the mapping by 0.001"});
  }
}

}  // namespace

Diagnosis doctor(const Scene& scene, const Recording& recording, const Binding& binding) {
  Diagnosis found;
  if (recording.rows() < 2) return found;
  lookAtTime(recording, binding, found.findings);
  // What follows compares over lags of a tenth of a second.
  if (!found.findings.empty() && found.findings.front().certain) return found;
  lookAtPlaces(recording, binding, found.findings);
  const std::set<std::string> leaping = lookForLeaps(recording, binding, found.findings);
  Diagnosis joints = JointDoctor(scene, recording, binding).look(leaping);
  found.following = std::move(joints.following);
  std::move(joints.findings.begin(), joints.findings.end(), std::back_inserter(found.findings));
  // A wrong column, unit or sign of which is said already takes positions out of their range, too.
  std::vector<Finding> ranges;
  if (std::ranges::none_of(found.findings, &Finding::certain)) lookAtRanges(scene, recording, binding, ranges);
  for (const Finding& range : ranges)
    if (std::ranges::find(found.findings, range.channel, &Finding::channel) == found.findings.end())
      found.findings.push_back(range);
  // A position that is turned about is another sign than its velocity's, too: the position's fault is told first.
  std::stable_partition(found.findings.begin(), found.findings.end(),
                        [](const Finding& finding) { return finding.channel.find(".velocity_") == std::string::npos; });
  return found;
}

}  // namespace btr
