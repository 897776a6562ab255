#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/random.h"

namespace btr {

/// One vector that a learner wants evaluated. The chromosome is the learner's own text of it ("0101…" for a GA, else
/// ""). Equal vectors need not be evaluated twice.
struct Candidate {
  std::string chromosome;
  std::vector<double> parameters;  ///< in the order of the genotype, within its bounds
};

/// A learner in ask/tell form: the host owns the loop, so candidates can be evaluated in parallel or by a person, and a
/// run can stop and go on. Always maximises. Deterministic: all chance comes from the Random handed in.
class Learner {
 public:
  virtual ~Learner() = default;
  /// What the user may set, e.g. population, crossover, mutation.
  virtual std::vector<Parameter> settings() const = 0;
  /// Begins a fresh search over `genotype`. Throws InputError if a setting is not allowed.
  virtual void start(std::vector<Parameter> genotype, const Values& settings, Random& random) = 0;
  /// The candidates of the next generation, at least one. Asking twice without a tell gives the same.
  virtual std::vector<Candidate> ask(Random& random) = 0;
  /// Their fitness in the same order; not finite values count as the worst finite one.
  virtual void tell(std::span<const double> fitness) = 0;
  /// All that is needed to go on after loadState() on a started learner (JSON text).
  virtual std::string state() const = 0;
  virtual void setState(const std::string& state) = 0;
};

}  // namespace btr
