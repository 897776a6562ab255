#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/gap/search/screening/candidates.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/store/database.h"

namespace btr {

/// One effect at one place, and how much of the differences between real and simulated fitness it would take away.
struct FitnessClue {
  PlacedEffect effect;  ///< at the size that takes most away
  double share = 0;   ///< of the sum of squared differences (each over its variance, where all were repeated), 0 … 1
  double pValue = 1;  ///< that the best of all effects takes as much from the same differences dealt out at random
  std::vector<double> simulated;  ///< fitness with it, by individual
};

/// What measured fitness alone says of physics that the simulator lacks, and what would settle it.
struct FitnessClues {
  Id run = 0;
  int stage = 0, version = 0;  ///< measurement stage; simulator version that is compared
  std::string unit;            ///< of fitness
  std::vector<Id> individuals;
  std::vector<double> real, simulated, standardError;  ///< by individual; 0: measured once
  double gap = 0;                                      ///< mean absolute difference
  std::size_t tried = 0;                               ///< effects times places
  std::vector<FitnessClue> clues;                      ///< all that take anything away, best first
  std::size_t alike = 0;  ///< first clues among which the differences do not choose (at least 0.8 of the best share)
  /// Where the best explanations differ most: what to record.
  Id recordIndividual = 0;
  std::string recordChannel, recordUnit;
  double recordSpread = 0;  ///< root mean square over time of their standard deviation, in recordUnit
  std::string sentence;
};

struct FitnessCluesOptions {
  int workers = 0;                                                       ///< 0: as many as processors
  std::vector<std::string> names;                                        ///< effects to consider; empty: all
  std::uint64_t seed = 1;                                                ///< of the dealing out
  std::function<bool(const std::string& stage, double share)> progress;  ///< false cancels
};

/// Simulates the individuals measured last in the newest simulator version with each effect at each place, at a typical
/// size, and regresses the differences on the change of fitness. Reads only. Throws InputError if fewer than three
/// individuals have been measured; throws Cancelled.
FitnessClues fitnessClues(const Database& database, const PluginHost& host, Id run, const FitnessCluesOptions& options);

/// Share of Σ wᵢ·dᵢ² that a·δ with the best a in [0, most] takes away, and that a.
struct BestShare {
  double share = 0, a = 0;
};
BestShare bestShare(const std::vector<double>& differences, const std::vector<double>& change,
                    const std::vector<double>& weights, double most);

/// "format": "uchilsim-fitness-clues-1".
std::string toJsonText(const FitnessClues& clues);
FitnessClues fitnessCluesFromJson(const std::string& text);

}  // namespace btr
