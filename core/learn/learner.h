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

/// How a population is made from one vector.
struct Permutations {
  double share = 1;    ///< of the population; the rest stays as start() made it
  double flip = 0.05;  ///< probability that a bit of a copy flips
};

/// A learner in ask/tell form: the host owns the loop, so candidates can be evaluated in parallel or by a person, and a
/// run can stop and go on. Always maximises. Deterministic: all chance comes from the Random handed in.
class Learner {
 public:
  virtual ~Learner() = default;
  /// What the user may set, e.g. population, crossover, mutation.
  virtual std::vector<Parameter> settings() const = 0;
  /// The same for a search over `genotype`: some learners also have settings for each of its parameters.
  virtual std::vector<Parameter> settingsFor(std::span<const Parameter> /*genotype*/) const { return settings(); }
  /// Begins a fresh search over `genotype`. Throws InputError if a setting is not allowed.
  virtual void start(std::vector<Parameter> genotype, const Values& settings, Random& random) = 0;
  /// Right after start(): the search begins around `at`, a vector of the genotype. A learner with a population makes
  /// the `share` [0, 1] of it permutations of that vector, the first one unaltered; a learner with a centre begins
  /// there and heeds neither share nor chance.
  virtual void beginAt(std::span<const double> at, const Permutations& permutations, Random& random) = 0;
  /// The candidates of the next generation, at least one. Asking twice without a tell gives the same.
  virtual std::vector<Candidate> ask(Random& random) = 0;
  /// Their fitness in the same order. Where a value is not finite nothing is known (all measurements void): it counts
  /// as the worst finite one, unless the learner can do without it.
  virtual void tell(std::span<const double> fitness) = 0;
  /// Where the search stands, within the bounds; empty if the learner has no such point.
  virtual std::vector<double> centre() const { return {}; }
  /// All that is needed to go on after loadState() on a started learner (JSON text).
  virtual std::string state() const = 0;
  virtual void setState(const std::string& state) = 0;
};

}  // namespace btr
