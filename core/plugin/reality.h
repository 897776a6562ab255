#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// One trial of one individual on the real robot.
struct RealTask {
  long long run = 0, individual = 0;
  int trial = 0;   ///< of this individual: 0, 1, …
  int repeat = 0;  ///< of these parameters, which another individual may share: 0, 1, …
  std::vector<double> parameters;
  std::string recordTo = {};     ///< file of a recording, "" for none
  std::string pose = "hung_up";  ///< of the robot in the recording: "hung_up" or "on_floor"
};

/// What was measured.
struct RealAnswer {
  double fitness = 0;
  bool isVoid = false;  ///< the trial failed: the robot fell apart, so to speak
  std::string note = {};
};

/// What a robot is opened with.
struct RealityContext {
  std::string database;  ///< path
  long long run = 0;
  std::vector<Parameter> genotype;           ///< what a task's parameters mean, in their order
  std::string unit;                          ///< of the fitness
  Values settings;                           ///< of Reality::settings(), defaults filled in
  std::map<std::string, std::string> texts;  ///< of Reality::texts(), paths absolute
  std::string btr;                           ///< the program that plays a stand-in
  std::function<bool()> stopped;             ///< true once the user wants to stop; may be empty
};

/// A setting that is no number.
struct TextSetting {
  enum class Kind { program, folder, text };
  std::string name, meaning;
  Kind kind = Kind::text;  ///< program, folder: a path relative to the experiment's file, which must exist
  bool required = true;
};

/// The real robot while it is open.
class RealRobot {
 public:
  virtual ~RealRobot() = default;
  /// Nothing if there is no answer yet: the run waits, and this is asked again when it goes on. Throws InputError where
  /// an answer cannot be used; nothing is stored then. A recording is in `task.recordTo` when this returns.
  virtual std::optional<RealAnswer> measure(const RealTask& task) = 0;
};

/// Where real fitness comes from. Stateless and shared.
class Reality {
 public:
  virtual ~Reality() = default;
  virtual std::string meaning() const = 0;  ///< one sentence for people
  virtual std::vector<Parameter> settings() const { return {}; }
  virtual std::vector<TextSetting> texts() const { return {}; }
  /// True if it also writes the recordings that an experiment wants; else a person attaches them.
  virtual bool records(const Values& /*settings*/) const { return false; }
  /// Who measured, as it is stored beside each value.
  virtual std::string who() const = 0;
  /// nullptr where nobody answers but people, who enter the values. Throws InputError.
  virtual std::unique_ptr<RealRobot> open(const RealityContext& context) const = 0;
};

}  // namespace btr
