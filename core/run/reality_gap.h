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

/// A task is settled once it has as many values (void or not) as were wanted.
bool isSettled(const MeasurementTask& task, const std::vector<MeasurementRecord>& measurements);

}  // namespace btr
