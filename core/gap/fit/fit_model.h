#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// A number that a fit may change.
struct FitParameter {
  std::string name, unit;
  int effect = -1;   ///< index of the model's effect, −1: a number of the scene
  double given = 0;  ///< as the scene has it; an effect's neutral value (or default, where it has none)
  double minimum = 0, maximum = 1;
  double scale = 1;         ///< a typical change
  bool hasNeutral = false;  ///< an effect's size
  bool goesRound = false;   ///< an angle whose range is a whole turn: behind one end it goes on at the other

  /// Within the bounds: an angle that goes round by whole turns, any other number cut off.
  double inRange(double value) const;
};

/// A simulator whose numbers are fitted: the scene's `calibrate` list, and effects.
struct FitModel {
  std::vector<PlacedEffect> effects;  ///< parameters that are not fitted (whole numbers) stand in here
  std::vector<FitParameter> parameters;
  std::vector<double> values;  ///< by parameter

  SimulatorSpec simulator(const FitProblem& problem, std::span<const double> numbers) const;
  SimulatorSpec simulator(const FitProblem& problem) const { return simulator(problem, values); }
  /// One of its effects with its numbers as they were fitted.
  PlacedEffect fittedEffect(const FitProblem& problem, std::size_t effect) const;
  /// "backlash at leg.knee + …", "" for none.
  std::string text() const;
  /// The same model with one effect more, its parameters at `numbers` (all that it declares).
  FitModel with(const FitProblem& problem, const PlacedEffect& effect) const;
  /// The same, but its numbers stay: no fit changes them.
  FitModel withFixed(const FitProblem& problem, const PlacedEffect& effect) const;
  FitModel without(std::size_t effect) const;
  /// The same, but the details of an effect's law (Parameter::refines) are fitted, too.
  FitModel refined(const FitProblem& problem, std::size_t effect) const;
};

/// Only the calibrated numbers, as given.
FitModel givenModel(const FitProblem& problem);

/// What an effect's parameters are for a fit: those that are neither whole numbers nor details, with their bounds and
/// typical sizes.
std::vector<FitParameter> fitParameters(const std::vector<Parameter>& declared, int index);

/// Scenes of one model by their numbers: making one costs more than simulating a short segment.
class SceneCache {
 public:
  SceneCache(const FitProblem& problem, const FitModel& model) : problem_(problem), model_(model) {}
  const Scene& scene(std::span<const double> numbers, std::size_t trial);

 private:
  const FitProblem& problem_;
  const FitModel& model_;
  std::map<std::vector<double>, Scene> scenes_;
};

}  // namespace btr
