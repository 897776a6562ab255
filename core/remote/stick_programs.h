#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/live/session.h"

namespace btr::remote {

/// The programs of a world's robots that have an OPEN-R stick. What they order are acts of its session, which outlives
/// them.
class StickPrograms {
 public:
  struct Line {
    std::string robot, object, text;
  };

  virtual ~StickPrograms() = default;
  /// Before each period, after all other acts.
  virtual void step() = 0;
  /// Told of each act that the session took.
  virtual void acted(const Act& act) = 0;
  /// On a robot's console; its program reads it in the next period. Throws InputError if none runs there.
  virtual void type(const std::string& robot, const std::string& text) = 0;
  /// Switches the robots off.
  virtual void end() = 0;
  /// What was said since the last call, as UTF-8.
  virtual std::vector<Line> takeLines() = 0;
  /// By robot: "" while its program runs, else why no longer.
  virtual std::map<std::string, std::string> whyEnded() const = 0;
};

/// Throws InputError if a program cannot be started.
using StickProgramsMaker = std::function<std::unique_ptr<StickPrograms>(Session&)>;

}  // namespace btr::remote
