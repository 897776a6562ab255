#pragma once
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/sim/trial_result.h"

namespace btr {

/// What a trial is worth. Higher is better. Stateless and shared.
class Fitness {
 public:
  virtual ~Fitness() = default;
  virtual std::string unit() const = 0;  ///< "m", "m/s"
  virtual std::string meaning()
      const = 0;  ///< what the number measures, and from where; one sentence for the measurement sheet
  virtual std::vector<Parameter> settings() const = 0;
  /// Throws InputError where no trial can be measured because the scene lacks something, e.g. a ball.
  virtual void check(const Scene& /*scene*/) const {}
  /// `controllerSettings` say what the task was: all of the controller's settings, defaults filled in.
  virtual double evaluate(const TrialResult& result, const Values& settings,
                          const Values& controllerSettings) const = 0;
  /// What else is worth recording of a finished trial beside its fitness, e.g. how straight it was. Names end in units.
  virtual Values figures(const TrialResult&, const Values& /*settings*/, const Values& /*controllerSettings*/) const {
    return {};
  }
  /// What a failed trial is worth.
  virtual double ofFailure() const { return 0; }
  /// False where no trial can be worth less than 0, such as a distance: a measured −0.5 is then a slip.
  virtual bool canBeNegative() const { return true; }
};

}  // namespace btr
