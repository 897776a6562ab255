#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/store/records.h"

namespace btr {

/// Real fitness of one individual: the mean of its values that are not void.
struct RealFitness {
  Id individual = 0;
  std::vector<double> parameters;
  double mean = 0;
  double standardDeviation = 0;  ///< of the repeats (n − 1), 0 if measured once
  int count = 0;
  int stage = 0;
  bool heldOut = false;
  int iteration = 0;  ///< of L2, 0: measured by the stage itself
};

/// How real and simulated fitness are compared over several individuals: names as in adaptationParameters().
enum class GapNorm { meanAbsolute, rootMeanSquare, maximum };

/// Norm of real − simulated. Both spans have the same length; 0 for none.
double gapOf(std::span<const double> real, std::span<const double> simulated, GapNorm norm);

/// Standard error of a mean absolute gap that comes from repeats: √Σ(sᵢ²/nᵢ)/N; 0 if nothing was repeated.
double gapStandardError(const std::vector<RealFitness>& real);

/// By task order, individuals with at least one value that is not void, of stages 1 … `stage`; without their
/// parameters.
std::vector<RealFitness> realFitness(const std::vector<MeasurementTask>& tasks,
                                     const std::vector<MeasurementRecord>& measurements, int stage);

/// True of a task of L2 whose iteration is over: a person may have ended it before everything was measured, and then
/// the rest is not asked for any more.
bool isOver(const MeasurementTask& task, const std::vector<RealityIteration>& finished);

/// A task is settled once it has as many values (void or not) as were wanted.
bool isSettled(const MeasurementTask& task, const std::vector<MeasurementRecord>& measurements);

/// Why an individual is measured: "best, rank 3", "candidate simulators disagree: ± 0.21 m over 6", "policy of L2".
/// Without numbers while the simulated fitness is hidden: a rank would tell it.
std::string reasonOf(const MeasurementTask& task, const std::string& unit, bool withNumbers);

}  // namespace btr
